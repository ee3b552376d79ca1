// peeling/algorithms/fixed_passes/stochastic.cpp - pass 1 stores the nearest depth of every sample, where a fragment
// covers samples chosen at random; pass 2 weights each fragment by the share of samples in which nothing is in front of
// it. Enderton et al. 2010, "Stochastic Transparency", sections 3 and 4 (alpha correction);
// peeling/reference/algorithms.md 23.
//
// Needs      float MAX blending, and targets with different blends in one pass.
// Passes     2. An approximation: its expected value is exact before the alpha correction. Exact if no pixel has more
//            than one visible fragment.
// Invariant  after pass 1, sample s = the nearest depth of the fragments whose mask includes s; `through` = the product
//            of (1 - a), which is exact. Assumed: the samples are channels of float targets under MAX, with the values
//            that a multisampled depth buffer with LESS and a sample mask would have.
#include <array>

#include "peeling/algorithms/entry.h"
#include "peeling/programs/depth_float.h"
#include "peeling/programs/depth_range.h"
#include "peeling/programs/fixed_passes/sample_mask.h"
#include "peeling/programs/fixed_passes/weighted.h"
#include "peeling/programs/sums.h"

namespace strata::peeling::listing::stochastic {

using namespace pipeline;

namespace {

constexpr float no_depth = -2.0f;  // a sample that no fragment covers: less than every -depth

struct Samples {
    int count = 0;
    std::array<Target, 2> depths{};  // -depth, one sample per channel
    [[nodiscard]] std::size_t targets() const noexcept { return static_cast<std::size_t>(count + 3) / 4; }
};

PassState visible_state(const Region& region) {
    PassState state;
    state.depth = {.enabled = true, .func = CompareFunc::less, .write = false};
    state.depth_target = region.opaque_depth();
    state.needs = code_with_color;
    return state;
}

Samples cover(Region& region, const AlgorithmOptions& options) {
    Samples samples{options.stochastic_samples, {}};
    PassState state = visible_state(region);
    for (std::size_t t = 0; t < samples.targets(); ++t) {
        samples.depths[t] = region.make(Format::rgba32f);
        region.set_name(samples.depths[t], "samples");
        region.clear(samples.depths[t], {.color = Rgba(no_depth)});
        state.color[t] = samples.depths[t];
        state.blend[t] = blend_mode::max;
    }
    const DepthFormat format = region.frame().key_request().format;
    static_cast<void>(region.draw(state, [&](const FragmentBatch& in, const Loads&, Outputs& out) {
        for (std::size_t i = 0; i < lanes(in); ++i) {
            const std::uint32_t hash = sample_hash(in.x[i], in.y[i], in.primitive[i], options.stochastic_seed);
            const std::uint32_t mask_of_samples = sample_mask(in.color[3][i], samples.count, hash);
            const float depth = depth_as_float(in.code[i], format);
            for (std::size_t s = 0; s < 4 * samples.targets(); ++s)
                out.color[s / 4][s % 4][i] = (mask_of_samples >> s & 1u) != 0 ? 0.0f - depth : no_depth;
        }
    }));
    return samples;
}

// Pass 2: sums (c a, a) times the share of samples that have no nearer depth; `through` is the product of (1 - a).
void accumulate(Region& region, const Samples& samples, Target sums, Target through) {
    region.clear(sums, {});
    region.clear(through, {.color = {1, 1, 1, 1}});
    constexpr BlendTerm product{BlendEquation::add, BlendFactor::zero, BlendFactor::one_minus_src_color};
    PassState state = visible_state(region);
    state.color = {sums, through};
    state.blend = {blend_mode::sum, Blend{.enabled = true, .color = product, .alpha = product}};
    for (std::size_t t = 0; t < samples.targets(); ++t) state.reads[t] = samples.depths[t];
    const DepthFormat format = region.frame().key_request().format;
    const float share = 1.0f / static_cast<float>(samples.count);
    static_cast<void>(region.draw(state, [&](const FragmentBatch& in, const Loads& loads, Outputs& out) {
        for (std::size_t i = 0; i < lanes(in); ++i) {
            const float depth = 0.0f - depth_as_float(in.code[i], format);
            int seen = 0;
            for (int s = 0; s < samples.count; ++s)
                seen += loads.color(s / 4)[static_cast<std::size_t>(s) % 4][i] <= depth ? 1 : 0;
            const float a = in.color[3][i], weight = a * (static_cast<float>(seen) * share);
            for (std::size_t c = 0; c < 3; ++c) out.color[0][c][i] = in.color[c][i] * weight;
            out.color[0][3][i] = weight;
            for (std::size_t c = 0; c < 4; ++c) out.color[1][c][i] = a;
        }
    }));
}

// The alpha correction: the colour is the weighted average of the fragments, and its coverage is 1 - through.
void composite(Region& region, Target sums, Target through, Target result) {
    PassState state;
    state.color[0] = result;
    state.reads = {sums, through, region.opaque_color()};
    static_cast<void>(region.full_screen(state, [&](const FragmentBatch& in, const Loads& loads, Outputs& out) {
        resolve_weighted(loads.color(0), loads.color(0)[3], loads.color(1)[0], loads.color(2), out.color[0], lanes(in));
    }));
}

void run(Region& region, const ListingInputs& inputs) {
    const Target sums = make_sums(region);
    const Target through = make_sum(region);
    const Target result = region.make(region.frame().picture_format());
    region.set_name(sums, "sums");
    region.set_name(through, "through");
    region.set_name(result, "result");
    region.begin_iteration();
    const Samples samples = cover(region, inputs.options);
    accumulate(region, samples, sums, through);
    composite(region, sums, through, result);
    region.publish(result);
}

}  // namespace

std::vector<Algorithm> entries() {
    return {
        Algorithm{.name = "stochastic",
                  .listed = 230,
                  .paper = "Enderton et al. 2010",
                  .section = "Stochastic Transparency",
                  .summary = "every fragment covers some of a pixel's samples by chance; colours by how many see them",
                  .pass_formula = "2",
                  .ties = TiePolicy::none,
                  .compares_own_codes = true,
                  .geometry_passes = two_passes,
                  .run_with = run,
                  .features = {float_targets, fragment_programs, independent_blend},
                  .render_targets = 2}};
}

}  // namespace strata::peeling::listing::stochastic
