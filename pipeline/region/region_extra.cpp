// pipeline/region/region_extra.cpp - disabled stages simulated with a state that changes nothing, as Effects::all
// requires.
//
// Rule     An extra stage does the stage's work on the pass's own fragments and counts nothing. Its result is passed to
//          the next stage wherever the stage's rule guarantees that it is unchanged: alpha and depth tests that pass
//          everything, a stencil that keeps, and blending ONE and ZERO of UNORM8 (write_colors). In float formats s + 0
//          d differs from s for -0, infinity and NaN: there the sum is computed and discarded.
// Tests    tests/peeling/execution/execution_test.cpp compares with Effects::needed.
#include "pipeline/region/region_scratch.h"
#include "pipeline/region/region_shared.h"
#include "pipeline/region/region_stages.h"
#include "pipeline/region/region_targets.h"
#include "pipeline/stages/alpha_test.h"
#include "pipeline/stages/blend.h"
#include "pipeline/stages/stencil.h"

namespace strata::pipeline {

// The 8-bit code of any alpha is at least 0.
void Stages::extra_alpha_test(const PassState& state, const FragmentBatch& batch, Outputs& out) {
    if (!state.color[0].exists()) return;  // no alpha of colour 0
    constexpr AlphaTest passes_all{.enabled = true, .func = CompareFunc::gequal, .ref = 0.0f};
    alpha_test(passes_all, true, out.color[0][3].data(), out.alive.data(), batch.count);
}

void Stages::extra_tests(const PassState& state, const FragmentBatch& batch, Lanes<std::uint32_t>& alive) {
    const PixelLanes at_pixels{batch.pixel.data(), static_cast<std::size_t>(batch.count)};
    if (shared_.runs_extra(Effect::depth_test, state.depth.enabled)) {
        constexpr DepthTest passes_all{.enabled = true, .func = CompareFunc::always, .write = false};
        TargetStorage& depth = targets_.at(targets_.opaque_depth());
        static_cast<void>(test_depth(passes_all, depth_format(depth.format()), depth.depth_plane(0), at_pixels,
                                     batch.code.data(), alive.data()));
    }
    if (!shared_.runs_extra(Effect::stencil_test, state.stencil.enabled)) return;
    if (!extra_stencil_) extra_stencil_.emplace(Format::s8, 1, shared_.elements());
    RegionScratch& s = shared_.scratch;
    const Texels stencil{extra_stencil_->stencil_plane(0), 1, 32};
    gather_codes(stencil, at_pixels, &s.stencil_stored);
    std::fill_n(s.depth_pass.begin(), batch.count, ~0u);
    constexpr StencilTest keeps{.enabled = true, .two_sided = false, .front = {}, .back = {}};
    static_cast<void>(stencil_test(keeps, {batch.front_facing.data(), s.depth_pass.data(), alive.data(),
                                           s.stencil_stored.data(), s.saturated.data(), batch.count}));
    scatter_codes(stencil, at_pixels, alive.data(), 1, &s.stencil_stored);
}

void Stages::extra_blend(const Blend& blending, const FragmentBatch& batch, const ColorLanes& color,
                         const TargetStorage& target, int sample) {
    Blend again = blending;
    again.enabled = true;
    const FormatInfo format = info(target.format());
    target.gather(batch.pixel, batch.count, sample, shared_.scratch.extra_codes);
    blend(again, format.type, shared_.profile(), format.channels, color, shared_.scratch.extra_codes, batch.count);
}

}  // namespace strata::pipeline
