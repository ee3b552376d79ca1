// peeling/algorithms/fixed_passes/weighted_blended.cpp - one pass: the colour of a pixel is the average of its
// fragments, weighted by alpha and depth. McGuire and Bavoil 2013, sections 3 and 4; peeling/reference/algorithms.md
// 18.
//
// Needs      fp16 additive blending, two render targets; weighted_blended needs different blends in them,
//            weighted_blended_shared one blend with separate factors for alpha.
// Passes     1. An approximation: exact where all fragments of a pixel have the same colour, whatever their alphas.
// Invariant  sums = sum of (c a, a) w(z, a), revealage = product of (1 - a), in submission order and in the targets'
//            precision.
#include <limits>

#include "peeling/algorithms/entry.h"
#include "peeling/programs/depth_range.h"
#include "peeling/programs/fixed_passes/weighted.h"
#include "peeling/programs/sums.h"

namespace strata::peeling::listing::weighted_blended {

using namespace pipeline;

namespace {

// Which target stores the sum of weights, and which the revealage. apart: the alpha of the first target is the sum of
// weights, and the second target is the revealage. shared: the alpha of the first target is the revealage, and the
// second target is the sum of weights.
enum class Form : std::uint8_t { apart, shared };

// apart: the first target adds, the second multiplies by 1 - alpha. shared: both add colours and multiply their alpha
// by 1 - alpha.
std::array<Blend, max_color_targets> blends_of(Form form) noexcept {
    constexpr BlendTerm sum{BlendEquation::add, BlendFactor::one, BlendFactor::one};
    constexpr BlendTerm by_color{BlendEquation::add, BlendFactor::zero, BlendFactor::one_minus_src_color};
    constexpr BlendTerm by_alpha{BlendEquation::add, BlendFactor::zero, BlendFactor::one_minus_src_alpha};
    constexpr Blend shared{.enabled = true, .color = sum, .alpha = by_alpha};
    if (form == Form::shared) return {shared, shared};
    return {blend_mode::sum, Blend{.enabled = true, .color = by_color, .alpha = by_color}};
}

void accumulate(Region& region, const ListingInputs& inputs, Form form, Target sums, Target other) {
    const bool apart = form == Form::apart;
    region.clear(sums, {.color = {0, 0, 0, apart ? 0.0f : 1.0f}});
    region.clear(other, {.color = Rgba(apart ? 1.0f : 0.0f)});
    PassState state;
    state.depth = {.enabled = true, .func = CompareFunc::less, .write = false};
    state.depth_target = region.opaque_depth();
    state.color = {sums, other};
    state.blend = blends_of(form);
    state.needs.code = false;
    region.begin_iteration();
    static_cast<void>(region.draw(state, [&](const FragmentBatch& in, const Loads&, Outputs& out) {
        Lanes<float> weights;
        weigh(inputs, region.frame(), in, weights);
        for (std::size_t i = 0; i < lanes(in); ++i) {
            const float a = in.color[3][i], w = weights[i];
            for (std::size_t c = 0; c < 3; ++c) out.color[0][c][i] = in.color[c][i] * a * w;
            out.color[0][3][i] = apart ? a * w : a;
            for (std::size_t c = 0; c < 3; ++c) out.color[1][c][i] = apart ? a : a * w;
            out.color[1][3][i] = a;
        }
    }));
}

// The full-screen pass: resolves the two targets over the background, and reports the pixels whose sums have become
// infinite; the region reports those that stopped at the greatest half.
void resolve(Region& region, Form form, const PassState& state) {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    PixelSet saturated{region};
    static_cast<void>(region.full_screen(state, [&](const FragmentBatch& in, const Loads& loads, Outputs& out) {
        const ColorLanes &sum = loads.color(0), &background = loads.color(2);
        const Lanes<float>&weights = form == Form::apart ? sum[3] : loads.color(1)[0],
              &revealage = form == Form::apart ? loads.color(1)[0] : sum[3];
        resolve_weighted(sum, weights, revealage, background, out.color[0], lanes(in));
        for (std::size_t i = 0; i < lanes(in); ++i)
            if (!(weights[i] < infinity && sum[0][i] < infinity && sum[1][i] < infinity && sum[2][i] < infinity))
                saturated.add(in.pixel[i]);
    }));
    saturated.report(region, Fault::half_saturated, "a sum of weighted colours has overflowed");
}

template <Form form>
void run(Region& region, const ListingInputs& inputs) {
    const Target sums = make_sums(region);
    const Target other = make_sum(region);
    const Target result = region.make(region.frame().picture_format());
    region.set_name(sums, "sums");
    region.set_name(other, form == Form::apart ? "revealage" : "weights");
    region.set_name(result, "result");
    accumulate(region, inputs, form, sums, other);
    PassState state;
    state.color[0] = result;
    state.reads = {sums, other, region.opaque_color()};
    resolve(region, form, state);
    region.publish(result);
}

}  // namespace

std::vector<Algorithm> entries() {
    return {
        Algorithm{.name = "weighted_blended",
                  .listed = 180,
                  .paper = "McGuire and Bavoil 2013",
                  .section = "equations 7 to 10",
                  .summary = "every colour replaced by the average weighted by alpha and depth; an approximation",
                  .pass_formula = "1",
                  .ties = TiePolicy::none,
                  .key = DepthKey::shader_z,
                  .geometry_passes = one_pass,
                  .run_with = run<Form::apart>,
                  .features = {float_targets, fragment_programs, independent_blend},
                  .render_targets = 2},
        Algorithm{.name = "weighted_blended_shared",
                  .listed = 181,
                  .paper = "McGuire and Bavoil 2013",
                  .section = "Weighted Blended Order-Independent Transparency",
                  .summary = "weighted_blended with one blend for both targets: the revealage is the alpha of the sums",
                  .pass_formula = "1",
                  .ties = TiePolicy::none,
                  .key = DepthKey::shader_z,
                  .geometry_passes = one_pass,
                  .run_with = run<Form::shared>,
                  .features = {float_targets, fragment_programs, separate_alpha_blend},
                  .render_targets = 2}};
}

}  // namespace strata::peeling::listing::weighted_blended
