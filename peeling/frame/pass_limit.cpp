// peeling/frame/pass_limit.cpp - which peels may never end, and their limits (pass_limit.h).
#include "peeling/frame/pass_limit.h"

#include <algorithm>

#include "pipeline/vertices/prepare.h"

namespace strata::peeling {

using namespace pipeline;

namespace {

// A peel that compares codes of its own takes at most six passes per iteration, and one iteration per fragment of the
// deepest pixel; bucket_peel always takes six.
constexpr PassLimit own_codes_limit{7, 6};
// A correct peel needs one pass per fragment of the deepest pixel, and one more. If the compared depth is not the
// stored one, or other vertices are drawn, it may never end; twice as many passes show that.
constexpr PassLimit double_limit{2, 2};

// A replaced depth is the quotient that is compared: that peel ends, and the number of triangles bounds its passes.
bool compares_replaced_depth(const Frame& frame) {
    return frame.second == nullptr && frame.depth_compare().compares_codes() &&
           frame.depth.path == rasterizer::DepthPath::depth_replace &&
           frame.depth.reference == rasterizer::DepthPath::perspective_rq;
}

}  // namespace

bool limits_passes(const RenderOptions& options) noexcept {
    return options.max_passes > 0 || options.termination.rule == TerminationRule::fixed;
}

bool leaves_samples(const RenderOptions& options) noexcept {
    return options.raster.sample_coverage != rasterizer::SampleCoverage{};
}

bool flushes_depths(const DeviceProfile& profile, const rasterizer::RasterState& raster) noexcept {
    return profile.denormals == DenormalRule::flush && std::max(raster.depth_near, raster.depth_far) < 0x1p-126f;
}

bool may_stall(const Algorithm& algorithm, const DeviceProfile& profile, const RenderOptions& options) {
    return needs(algorithm, Feature::float_targets) &&
           (flushes_depths(profile, options.raster) || options.raster.polygon_offset.enabled ||
            leaves_samples(options));
}

PassLimit pass_limit(const Algorithm& algorithm, const RenderOptions& options, const Frame& frame) {
    if (limits_passes(options)) return {options.max_passes, 0};
    if (algorithm.compares_own_codes)
        return may_stall(algorithm, *frame.profile, options) ? own_codes_limit : PassLimit{};
    if (frame.is_invariant()) return {};
    if (!compares_replaced_depth(frame)) return double_limit;
    constexpr std::size_t most = 1u << 30;
    return {static_cast<int>(2 * std::min(frame.transparent->geometry.triangles.size(), most - 1) + 2), 0};
}

PassLimit loads_limit(const Algorithm& algorithm) noexcept {
    return algorithm.compares_own_codes ? own_codes_limit : double_limit;
}

}  // namespace strata::peeling
