// tools/oracle/judge/sample_habits.h - what ports with several samples per pixel do once a pixel: lists without masks
// and peels of resolved targets.
//
// Rule     The fragments of all samples are composited as such a port does; a habit is named if the picture is that of
//          one, to 2 codes, at all pixels but a 25th of the wrong ones, with the samples' own colours or the pixel's.
// Tests    tests/tools/oracle/judge/sample_habits_test.cpp: pictures by plain code on two samples
#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "peeling/frame_request.h"
#include "tools/oracle/verdict/resolved.h"

namespace strata::oracle {

using SampleColor = std::array<double, 3>;

struct SampleFragment {
    SampleColor color{};  // multiplied by alpha
    double alpha = 0;
    double depth = 0;   // of its program, which may run once a pixel
    double stored = 0;  // of its sample
    std::uint32_t primitive = 0;
};

// A pixel's visible fragments at every sample, near to far, and what is behind them.
struct SamplePixelLists {
    std::vector<std::vector<SampleFragment>> lists{};
    std::vector<SampleColor> behind{};
};

// One list for the pixel, of every fragment that covers a sample.
[[nodiscard]] SampleColor without_mask(const SamplePixelLists& pixel);
// The same, where the alpha of each is multiplied by its share of covered samples.
[[nodiscard]] SampleColor by_shares(const SamplePixelLists& pixel);
// How a peel resolves the depths that the next pass compares with.
enum class DepthResolve : std::uint8_t { mean, first_sample, nearest, farthest };
// Layers and their depths are resolved after every pass.
[[nodiscard]] SampleColor peeled_resolved(const SamplePixelLists& pixel, DepthResolve resolve);
// Layers are peeled by samples, and each is resolved before they are composited.
[[nodiscard]] SampleColor composited_resolved(const SamplePixelLists& pixel);

struct NamedHabit {
    std::string words{};
    std::size_t unexplained = 0;  // pixels that are wrong by it
    // "  explains all 12 pixels that are not the mean of right samples\n"
    [[nodiscard]] std::string line(std::size_t wrong) const;
};
// Empty if no habit gives the picture. `wrong`: the number of pixels that are wrong for right samples.
[[nodiscard]] std::optional<NamedHabit> sample_habit(const peeling::FrameRequest& input, const verdict::Colors& picture,
                                                     std::size_t wrong);

}  // namespace strata::oracle
