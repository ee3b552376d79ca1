#include "peeling/pass_limit.h"

#include <algorithm>

#include "peeling/render_diagnostics.h"
#include "pipeline/frame/effects.h"

namespace strata::peeling {

using namespace pipeline;

namespace {

int fragments_of_deepest(const Frame& frame, std::optional<int>& deepest) {
    if (!deepest) deepest = static_cast<int>(deepest_pixel(*frame.transparent));
    return *deepest;
}

int double_limit(const Frame& frame, std::optional<int>& deepest) {
    return 2 * fragments_of_deepest(frame, deepest) + 2;
}

int own_codes_limit(const Frame& frame, std::optional<int>& deepest) {
    return 6 * fragments_of_deepest(frame, deepest) + 7;
}

}  // namespace

bool limits_passes(const RenderOptions& options) noexcept {
    return options.max_passes > 0 || options.termination.rule == TerminationRule::fixed;
}

bool leaves_samples(const RenderOptions& options) noexcept {
    return options.raster.sample_coverage != rasterizer::SampleCoverage{};
}

bool may_stall(const Algorithm& algorithm, const DeviceProfile& profile, const RenderOptions& options) {
    return needs(algorithm, Feature::float_targets) &&
           (flushes_depths(profile, options.raster) || options.raster.polygon_offset.enabled ||
            leaves_samples(options));
}

// A correct peel needs one pass per fragment of the deepest pixel, and one more. If the compared depth is not the
// stored one, or other vertices are drawn, it may never end; twice as many passes show that. A replaced depth is the
// quotient that is compared: that peel ends, and the number of triangles bounds its passes. A peel that compares codes
// of its own takes at most six passes per iteration, and one iteration per fragment of the deepest pixel; bucket_peel
// always takes six.
int pass_limit(const Algorithm& algorithm, const RenderOptions& options, const Frame& frame,
               std::optional<int>& deepest) {
    if (limits_passes(options)) return options.max_passes;
    if (algorithm.compares_own_codes)
        return may_stall(algorithm, *frame.profile, options) ? own_codes_limit(frame, deepest) : 0;
    if (frame.is_invariant()) return 0;
    constexpr std::size_t most = 1u << 30;
    if (frame.second == nullptr && frame.depth_compare().compares_codes() &&
        frame.depth.path == rasterizer::DepthPath::depth_replace &&
        frame.depth.reference == rasterizer::DepthPath::perspective_rq)
        return static_cast<int>(2 * std::min(frame.transparent->geometry.triangles.size(), most - 1) + 2);
    return double_limit(frame, deepest);
}

int loads_limit(const Algorithm& algorithm, const Frame& frame, std::optional<int>& deepest) {
    return algorithm.compares_own_codes ? own_codes_limit(frame, deepest) : double_limit(frame, deepest);
}

}  // namespace strata::peeling
