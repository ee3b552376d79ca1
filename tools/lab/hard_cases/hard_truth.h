// tools/lab/hard_cases/hard_truth.h - the correct image of a hard case for the device's own fragments and colours.
//
// Rule     A pixel's visible fragments are composited in binary64 over the opaque image, sorted by the exact plane's
//          depth rounded once to binary32, whatever the device's depth format. So a format in which two layers have
//          equal codes does not change the truth. On 8-bit targets the sum is clamped to 0 and 1.
// Numbers  Depths that round to the same binary32 have no order here: such a pixel is counted as one with ties. Depths
//          more than 2^-24 apart never do, because binary32 has no larger steps below 1.
// Tests    tests/tools/lab/hard_cases/hard_run_test.cpp
#pragma once
#include <array>
#include <compare>
#include <utility>
#include <vector>

#include "pipeline/formats/image.h"
#include "scenes/procedural/hard_cases/hard_case.h"
#include "tools/lab/hard_cases/composed_pixels.h"

namespace strata::pipeline {
struct DeviceProfile;
}
namespace strata::peeling {
struct RenderOptions;
}

namespace strata::tools {

class HardTruth {
  public:
    HardTruth(const scenes::Scene& scene, const pipeline::DeviceProfile& profile,
              const peeling::RenderOptions& options);

    // The largest difference of a colour channel of `picture`, in 1/255: at pixels where all keys and true depths
    // differ, and at pixels where two are equal.
    struct Difference {
        double elsewhere = 0, at_ties = 0;
    };
    [[nodiscard]] Difference difference(const ComposedFrame& frame, const pipeline::Image& picture) const;

  private:
    // Fragments of a pixel from near to far, each with its depth and its index in `visible`.
    using Order = std::vector<std::pair<std::uint32_t, std::size_t>>;
    [[nodiscard]] Order order(std::size_t pixel, const std::vector<VisibleFragment>& visible, bool keeps_numbers) const;
    [[nodiscard]] bool is_background(std::size_t pixel, const pipeline::Image& picture) const;
    [[nodiscard]] std::array<double, 3> color(std::size_t pixel, const std::vector<VisibleFragment>& visible,
                                              const Order& near_to_far) const;

    pipeline::Image background_;
    struct KnownDepth {
        std::size_t pixel = 0;
        std::uint32_t primitive = 0, code = 0;
        friend auto operator<=>(const KnownDepth&, const KnownDepth&) = default;
    };
    std::vector<KnownDepth> depths_;  // the exact depths, sorted
};

}  // namespace strata::tools
