// peeling/frame/pass_limit.h - the number of geometry passes after which a peel that may never end is stopped.
//
// Rule     --max-passes and fixed:N replace it. 0: no limit.
// Source   peeling/reference/keys-and-counts.md 3.4
// Tests    tests/peeling/frame/sample_coverage_test.cpp, tests/fuzz
#pragma once
#include "peeling/algorithms/algorithm.h"
#include "peeling/render_options.h"
#include "pipeline/frame/frame.h"

namespace strata::peeling {

// True if the user's options limit the number of passes.
[[nodiscard]] bool limits_passes(const RenderOptions& options) noexcept;

// True if sample coverage, alpha to coverage or a mask may leave samples out.
[[nodiscard]] bool leaves_samples(const RenderOptions& options) noexcept;

// True if the whole depth range is denormal, and blending into float targets flushes it to zero.
[[nodiscard]] bool flushes_depths(const pipeline::DeviceProfile& profile,
                                  const rasterizer::RasterState& raster) noexcept;

// A peel that keeps depths in float targets may not terminate if blending flushes them, or if polygon offset makes
// depths beyond 1, which MAX with a cleared -1 loses; nor one that counts in such targets if samples are left out after
// its program.
[[nodiscard]] bool may_stall(const Algorithm& algorithm, const pipeline::DeviceProfile& profile,
                             const RenderOptions& options);

// constant + per_fragment D, where D is the number of fragments of the frame's deepest pixel; 0: no limit.
struct PassLimit {
    int constant = 0, per_fragment = 0;
};

[[nodiscard]] PassLimit pass_limit(const Algorithm& algorithm, const RenderOptions& options,
                                   const pipeline::Frame& frame);
// The limit of a frame whose programs load other samples, which may never end with any algorithm.
[[nodiscard]] PassLimit loads_limit(const Algorithm& algorithm) noexcept;

}  // namespace strata::peeling
