// peeling/frame/setup.h - what a Renderer prepares once for the frames of all algorithms, and what follows from it.
//
// Tests    tests/peeling/comparison_test.cpp
#pragma once
#include <cstdint>
#include <memory>
#include <optional>

#include "peeling/algorithms/algorithm.h"
#include "peeling/as_shown.h"
#include "peeling/frame/prepared_lists.h"
#include "peeling/frame/shadow_light.h"
#include "peeling/render_options.h"

namespace strata::peeling {

struct FrameSetup {
    pipeline::DeviceProfile profile;
    RenderOptions options;
    rasterizer::DepthRequest depth;  // by the options; depth_of is that of an algorithm
    pipeline::Format color_format;
    bool is_perspective;  // of the view: w is not constant
    std::unique_ptr<const LightMap> light;
    PreparedLists lists;
    std::optional<PreparedLists> quotient_lists{};  // with r and q of every vertex, for algorithms that take them

    // The depth paths that the algorithm stores and compares.
    [[nodiscard]] rasterizer::DepthRequest depth_of(const Algorithm& algorithm) const;
    [[nodiscard]] PreparedLists& lists_for(const Algorithm& algorithm);
    [[nodiscard]] std::uint64_t audit_memory() const noexcept;
    // True if a compared depth is rounded like a stored one.
    [[nodiscard]] bool quantizes() const noexcept;
    // True if programs run once a pixel.
    [[nodiscard]] bool shades_pixels() const noexcept;
    // True if the options imply that every pass of a peel sees the same fragments and compares the depth that it
    // stores.
    [[nodiscard]] bool is_invariant() const noexcept;
    [[nodiscard]] AsShown shown() const noexcept { return {options, profile}; }
    [[nodiscard]] double seconds_of(const Algorithm& algorithm);  // that its lists took
};

// Throws InputError as the constructor of Renderer does. `list` must outlive the setup.
[[nodiscard]] FrameSetup set_up_frames(const pipeline::DrawList& list, const pipeline::View& view,
                                       const pipeline::DeviceProfile& profile, const RenderOptions& options);

}  // namespace strata::peeling
