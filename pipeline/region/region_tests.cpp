// pipeline/region/region_tests.cpp - the tests of a batch's fragments at one sample: depth units, stencil, depth
// (pipeline/reference/fragment-stages.md 4 to 6); the tests and writes of all samples in a pass once a pixel (13.9);
// and stages that are off, as Effects::all simulates them.
#include <algorithm>
#include <bit>

#include "pipeline/fragments/pixel_fragments.h"
#include "pipeline/frame/pass_counters.h"
#include "pipeline/region/region_scratch.h"
#include "pipeline/region/region_shared.h"
#include "pipeline/region/region_stages.h"
#include "pipeline/region/region_targets.h"
#include "pipeline/stages/alpha_test.h"
#include "pipeline/stages/blend.h"
#include "pipeline/stages/depth_test.h"
#include "pipeline/stages/stage_lanes.h"
#include "pipeline/stages/stencil.h"

namespace strata::pipeline {

namespace {

// Runs `work` while the batch has the elements and codes of sample s; `alive` are the lanes whose bit s is set.
template <class Work>
void at_sample(PixelBatch& pixels, std::size_t s, std::size_t area, const Lanes<std::uint8_t>& lanes,
               Lanes<std::uint32_t>& alive, Work&& work) {
    FragmentBatch& batch = pixels.batch;
    const Lanes<std::uint32_t> pixel = batch.pixel, code = batch.code;
    for (std::size_t i = 0; i < static_cast<std::size_t>(batch.count); ++i) {
        alive[i] = (lanes[i] >> s & 1u) != 0 ? ~0u : 0u;
        batch.pixel[i] += static_cast<std::uint32_t>(s * area);
        if (alive[i] != 0) batch.code[i] = pixels.sample_code[s][i];
    }
    work();
    batch.pixel = pixel;
    batch.code = code;
}

}  // namespace

// The emulator's own passes cover all samples. A frame of one sample of several has the number that its state says.
void Stages::cover_samples(const PassState& state, const FragmentBatch& batch, Outputs& out) {
    const rasterizer::RasterState& raster = shared_.frame.transparent->geometry.state;
    const rasterizer::SampleCoverage& coverage = raster.sample_coverage;
    if (kind_ != PassKind::geometry || !shared_.statistics.counts || coverage == rasterizer::SampleCoverage{}) return;
    // The samples of the least numbers; NaN has none. The product is exact, for the number is a power of two.
    const auto is_covered = [&](float share, ShareRounding rounding, std::uint32_t sample) {
        const float samples = (share > 0.0f ? std::min(share, 1.0f) : 0.0f) * static_cast<float>(raster.sample_count);
        const auto least = static_cast<float>(sample);
        switch (rounding) {
            case ShareRounding::nearest: return samples >= least + 0.5f;
            case ShareRounding::up: return samples > least;
            case ShareRounding::down: break;
        }
        return samples >= least + 1;
    };
    const DeviceProfile& profile = shared_.profile();
    const bool has_alpha = state.color[0].exists() && info(targets_.at(state.color[0]).format()).channels == 4;
    for (std::size_t i = 0; i < static_cast<std::size_t>(batch.count); ++i) {
        const std::uint32_t sample = static_cast<std::uint32_t>(raster.sample_number) +
                                     batch.pixel[i] / static_cast<std::uint32_t>(shared_.pixels());
        const bool is_masked = (coverage.mask >> sample & 1u) == 0;
        const bool is_outside =
            coverage.value && is_covered(*coverage.value, profile.sample_coverage, sample) == coverage.is_inverted;
        const bool is_in =
            !is_masked && !is_outside &&
            (!coverage.by_alpha || !has_alpha || is_covered(out.color[0][3][i], profile.alpha_to_coverage, sample));
        out.alive[i] &= is_in ? ~0u : 0u;
    }
}

// The units test one after the other, without a write; a fragment is killed by the first that fails (fragment-stages.md
// 4).
void Stages::test_depth_units(const PassState& state, const FragmentBatch& batch, int sample,
                              Lanes<std::uint32_t>& alive) {
    for (std::size_t unit = 0; unit < static_cast<std::size_t>(state.depth_unit_count); ++unit) {
        TargetStorage& target = targets_.at(state.depth_units[unit].depth);
        const DepthTest test{.enabled = true, .func = state.depth_units[unit].func, .write = false};
        const DepthResult result = test_depth(test, depth_format(target.format()), target.depth_plane(sample),
                                              lanes_of(batch), batch.code.data(), alive.data());
        shared_.count(of_depth_test(pixel_bytes(target), result.arriving, result.passed, false));
    }
}

// Three ways to the same result: the test is known to pass and is only counted (depth_outcome), depth alone in one
// kernel, or stencil and depth together, because the stencil operation depends on both (fragment-stages.md 5).
std::uint64_t Stages::test_depth_and_stencil(const PassState& state, const FragmentBatch& batch, int sample,
                                             Lanes<std::uint32_t>& alive) {
    RegionScratch& s = shared_.scratch;
    TargetStorage* const depth = state.depth.enabled ? &targets_.at(state.depth_target) : nullptr;
    DepthResult tested;
    std::uint64_t stencil_killed = 0;
    if (depth_ == DepthOutcome::passes) {
        tested.arriving = tested.passed = count_lanes(alive, batch.count);
    } else if (!state.stencil.enabled) {
        tested = test_depth(state.depth, depth_format(depth->format()), depth->depth_plane(sample), lanes_of(batch),
                            batch.code.data(), alive.data());
    } else {
        // First the depth result of every fragment; depth is written after the stencil test.
        tested.arriving = count_lanes(alive, batch.count);
        std::fill_n(s.depth_pass.begin(), batch.count, ~0u);
        if (depth != nullptr)
            static_cast<void>(test_depth({.enabled = true, .func = state.depth.func, .write = false},
                                         depth_format(depth->format()), depth->depth_plane(sample), lanes_of(batch),
                                         batch.code.data(), s.depth_pass.data()));
        stencil_killed = test_stencil(state, batch, sample, alive);
        tested.passed = count_lanes(alive, batch.count);
        if (depth != nullptr && state.depth.write)
            scatter_codes(codes_in(depth->depth_plane(sample)), lanes_of(batch), alive.data(), 1, &batch.code);
    }
    // The compared code may be wider than the stored one (rasterizer/reference/depth.md 2.9).
    if (shared_.wraps_depths() && depth != nullptr && state.depth.write && depth->format() != Format::d32f)
        for (std::size_t i = 0; i < static_cast<std::size_t>(batch.count); ++i)
            depth->depth_plane(sample).words[batch.pixel[i]] &= rasterizer::max_code(depth_format(depth->format()));
    shared_.count({.stencil_killed = stencil_killed});
    if (depth != nullptr)
        shared_.count(
            of_depth_test(pixel_bytes(*depth), tested.arriving - stencil_killed, tested.passed, state.depth.write));
    return tested.passed;
}

// Dead lanes are written back unchanged, because no pixel occurs twice in a batch. Each fragment that arrives reads and
// writes one byte of stencil traffic.
std::uint64_t Stages::test_stencil(const PassState& state, const FragmentBatch& batch, int sample,
                                   Lanes<std::uint32_t>& alive) {
    RegionScratch& s = shared_.scratch;
    const Texels stencil = codes_in(targets_.at(state.stencil_target).stencil_plane(sample));
    const std::uint64_t arriving = count_lanes(alive, batch.count);
    gather_codes(stencil, lanes_of(batch), &s.stencil_stored);
    const int killed = stencil_test(state.stencil, {batch.front_facing.data(), s.depth_pass.data(), alive.data(),
                                                    s.stencil_stored.data(), s.saturated.data(), batch.count});
    scatter_codes(stencil, lanes_of(batch), every_lane.data(), 1, &s.stencil_stored);
    shared_.count({.bytes_read = arriving, .bytes_written = arriving});
    if (state.selection.keeps != KeptFragments::submitted)
        report_saturation(batch);  // whose counts are meant to stop at 0
    return static_cast<std::uint64_t>(killed);
}

// A pixel is reported once, however often it saturates, so that the report does not depend on batches.
void Stages::report_saturation(const FragmentBatch& batch) {
    const Lanes<std::uint32_t>& saturated = shared_.scratch.saturated;
    if (count_lanes(saturated, batch.count) == 0) return;
    has_saturated_.resize(shared_.elements());
    std::uint64_t pixels = 0;  // pixels that had not saturated before
    std::uint32_t first = ~0u;
    for (std::size_t i = 0; i < static_cast<std::size_t>(batch.count); ++i) {
        if (saturated[i] == 0 || has_saturated_[batch.pixel[i]]) continue;
        has_saturated_[batch.pixel[i]] = true;
        first = std::min(first, shared_.pixel_of(batch.pixel[i]));
        ++pixels;
    }
    shared_.report(Fault::stencil_saturated, pixels, first, "INCR or DECR at the end of the 8-bit range");
}

// The fragments that no sample passes are dead. A program reads neither depth nor code of a sample.
Outputs& Stages::test_pixels(const PassState& state, PixelBatch& pixels, DrawCounts& drawn) {
    const FragmentBatch& batch = pixels.batch;
    Outputs& out = start_batch(batch);
    depth_ = DepthOutcome::open;
    std::fill_n(out.samples.begin(), batch.count, std::uint8_t{0});
    Lanes<std::uint32_t>& alive = shared_.scratch.alive;
    for (std::size_t s = 0; s < shared_.samples; ++s)
        at_sample(pixels, s, shared_.pixels(), pixels.covered, alive, [&] {
            drawn.passed.own_ +=
                state.depth.enabled ? test_depth_and_stencil(state, batch, 0, alive) : count_lanes(alive, batch.count);
            show(Stage::tests, state, batch, out, alive);
            for (std::size_t i = 0; i < static_cast<std::size_t>(batch.count); ++i)
                out.samples[i] |= static_cast<std::uint8_t>((alive[i] & 1u) << s);
        });
    for (std::size_t i = 0; i < static_cast<std::size_t>(batch.count); ++i) out.alive[i] = mask(out.samples[i] != 0);
    return out;
}

bool Stages::moves_centroids(const PassState& state, const PreparedDraw& list) const {
    return shared_.profile().centroid == CentroidSamples::passing && shared_.samples > 1 &&
           list.geometry.state.interpolation == rasterizer::Interpolation::centroid && state.depth.enabled &&
           !state.stencil.enabled && !state.replaces_depth && state.primitives.empty() && !state.needs.texcoord &&
           !state.needs.facing && !state.needs.exact_code && !state.needs.has_extras();
}

// The depth test of every sample comes first, without a write; nothing is counted, for each sample's own stages test
// again. Where a sample of the pixel fails, colours are those at the first sample that passes.
void Stages::for_each_sample(const PassState& state, PixelBatch& pixels,
                             const std::function<void(FragmentBatch&, Outputs&)>& work) {
    PassState early;
    early.depth = {.enabled = true, .func = state.depth.func, .write = false};
    early.depth_target = state.depth_target;
    {
        const UncountedWork look{shared_.statistics};
        DrawCounts none;
        const Outputs& passing = test_pixels(early, pixels, none);
        const unsigned all = (1u << shared_.samples) - 1;
        for (std::size_t i = 0; i < static_cast<std::size_t>(pixels.batch.count); ++i) {
            bool is_kept = pixels.kept[0][i] != 0;
            if (passing.samples[i] != 0 && passing.samples[i] != all) {
                const auto first = static_cast<std::size_t>(std::countr_zero(passing.samples[i]));
                for (std::size_t c = 0; c < 4; ++c) pixels.batch.color[c][i] = pixels.sample_color[first][c][i];
                is_kept = (pixels.kept[1][i] >> first & 1u) != 0;
            }
            if (!is_kept) pixels.covered[i] = 0;
        }
    }
    Lanes<std::uint32_t> alive;
    for (std::size_t s = 0; s < shared_.samples; ++s)
        at_sample(pixels, s, shared_.pixels(), pixels.covered, alive, [&] {
            Outputs& out = start_batch(pixels.batch);
            std::copy_n(alive.begin(), pixels.batch.count, out.alive.begin());
            work(pixels.batch, out);
        });
}

// First the targets of pixels, then sample after sample those of samples.
void Stages::write_pixels(const PassState& state, PixelBatch& pixels, Outputs& out, DrawCounts& drawn) {
    drawn.tallied = Count{tallied_};
    const FragmentBatch& batch = pixels.batch;
    const std::uint64_t fragments = alive_count(out, batch.count);
    if (fragments == 0) return;
    write_colors(state, batch, out, 0, out.alive, fragments, shared_.pixels());
    shared_.count({.blended = fragments});
    Lanes<std::uint8_t> lanes{};
    for (std::size_t i = 0; i < static_cast<std::size_t>(batch.count); ++i)
        if (out.alive[i] != 0) lanes[i] = out.samples[i];
    Lanes<std::uint32_t>& alive = shared_.scratch.alive;
    for (std::size_t s = 0; s < shared_.samples; ++s)
        at_sample(pixels, s, shared_.pixels(), lanes, alive, [&] {
            const std::uint64_t passed = count_lanes(alive, batch.count);
            if (passed > 0) write_colors(state, batch, out, 0, alive, passed, shared_.elements());
            show(Stage::written, state, batch, out, alive);
        });
}

// Effects::all also does the work of the stages that are off, with a state that changes nothing, on the pass's own
// fragments, and counts nothing. Its result is passed to the next stage wherever the stage's rule guarantees that it is
// unchanged: alpha and depth tests that pass everything, a stencil that keeps, and blending ONE and ZERO of UNORM8
// (write_colors). In float formats s + 0 d differs from s for -0, infinity and NaN: there the sum is computed and
// discarded. tests/peeling/execution/execution_test.cpp compares with Effects::needed.

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
    target.gather(batch.pixel, batch.count, sample, shared_.scratch.extra_codes);
    blend_into(target.format(), again, shared_.profile(), color, shared_.scratch.extra_codes, batch.count);
}

}  // namespace strata::pipeline
