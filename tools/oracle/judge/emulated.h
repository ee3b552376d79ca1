// tools/oracle/judge/emulated.h - what emulations say of a picture: it is that of a right run, of a right run with
// other options, or of a run with mistakes.
//
// Rule     A single emulation that gives the picture is found without a diagnosis of the whole picture: most emulations
//          are refuted by one square of it. Pictures of more than `most_pixels_of_emulations`, or whose
//          algorithm takes more than `most_passes_of_emulations`, are left to a diagnosis.
// Tests    tests/tools/library/judge_test.cpp
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "peeling/frame_request.h"
#include "tools/oracle/diagnosis/diagnosis.h"
#include "tools/oracle/judge/asked_picture.h"

namespace strata::oracle {

struct Emulated {
    enum class Kind : std::uint8_t { none, right, other_options, mistakes };

    Kind kind = Kind::none;
    bool is_exact = true;              // to the last code; false: within one code
    bool is_single = false;            // one mistake
    std::string words{};               // "front faces culled instead of back faces (culls_front)"
    std::vector<std::string> alike{};  // other single mistakes with this picture of the scene, in words
};

inline constexpr std::size_t most_pixels_of_emulations = std::size_t{1} << 18;
inline constexpr int most_passes_of_emulations = 100;

[[nodiscard]] Emulated emulated_of(const Diagnosis& diagnosis);

// `part`: the square that is compared first. Throws Refused if the right run is refused.
[[nodiscard]] Emulated emulated_alone(const peeling::FrameRequest& input, const peeling::Algorithm& algorithm,
                                      const AskedPicture& asked, const rasterizer::Rect& part);

// "right: equal to the picture of dual at all 6912 pixels"
[[nodiscard]] std::string sentence_of(const Emulated& emulated, const peeling::Algorithm& algorithm,
                                      std::size_t pixels);

// Of a picture that has the algorithm's own values but for ties of two codes, or the last bits of floats. Empty if it
// is another.
[[nodiscard]] std::optional<std::string> right_but_for_rounding(const TargetImage& own, const TargetImage& candidate,
                                                                pipeline::ColorSpace space,
                                                                const peeling::Algorithm& algorithm);

// The colours of the right run; empty if it is refused.
[[nodiscard]] std::optional<Picture> own_picture(const peeling::FrameRequest& input,
                                                 const peeling::Algorithm& algorithm);

// True if the right run has the picture; false, too, if it is refused.
[[nodiscard]] bool is_picture_of(const peeling::FrameRequest& input, const peeling::Algorithm& algorithm,
                                 const AskedPicture& asked, const rasterizer::Rect& part);

}  // namespace strata::oracle
