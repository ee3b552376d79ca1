// tools/oracle/judge/forgotten.h - which option of the view looks forgotten if a picture is wrong: --alpha,
// --background, --samples, --polygon-mode, --line-width, --point-size, --depth-path or --camera.
//
// Rule     The colour of the pixels where nothing is drawn is the picture's background. With that background, and with
//          the one given, the scene is judged with the --alpha that the picture shows (seen_alpha.h), or without the
//          one given, with 1, 2, 4 and 8 samples per pixel, with either origin, with triangles drawn as lines or
//          points, lines and points of 1 to 10 pixels, other depth paths, and moved by half a pixel. What makes the
//          picture right, by its layers or as that of the algorithm to the bit, is reported as such. Otherwise hints
//          are reported: another background; wrong pixels at edges between their neighbours' colours; a picture that
//          agrees almost nowhere.
// Tests    tests/tools/strata/compare/forgotten_test.cpp
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "peeling/frame_request.h"
#include "tools/oracle/show_progress.h"

namespace strata::oracle::verdict {
class Colors;
}

namespace strata::oracle {

// True if a request draws the picture by the stated algorithm, to the bit.
using IsDrawnBy = std::function<bool(const peeling::FrameRequest&)>;

struct Forgotten {
    std::vector<std::string> sentences{};  // without an end of line
    bool makes_right = false;              // with the options, or moved, the picture is right
};

// Of a picture that is wrong at `wrong_pixels` (ascending numbers).
[[nodiscard]] Forgotten forgotten_options(const peeling::FrameRequest& input, const verdict::Colors& picture,
                                          const std::vector<std::uint32_t>& wrong_pixels, const IsDrawnBy& is_drawn,
                                          const std::string& camera, const ShowProgress& progress = {});

// Of a picture that a mistake explains: only --alpha is tried, since the mistake may be its effect.
[[nodiscard]] Forgotten forgotten_alpha(const peeling::FrameRequest& input, const verdict::Colors& picture,
                                        const std::vector<std::uint32_t>& wrong_pixels, const IsDrawnBy& is_drawn);

}  // namespace strata::oracle
