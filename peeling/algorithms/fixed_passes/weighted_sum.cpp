// peeling/algorithms/fixed_passes/weighted_sum.cpp - one pass; the order-dependent terms of OVER are ignored. Bavoil
// and Myers 2008, "Weighted Sum" (after Meshkin 2007); peeling/reference/algorithms.md 8.
//
// Needs      fp16 additive blending.
// Passes     1. An approximation: the background's weight 1 - sum a goes negative where alphas add up to more than 1,
//            and the image darkens; only the final store clamps it.
// Invariant  sums.rgb = sum of c a, sums.a = sum of a, in submission order and in the target's precision.
#include "peeling/algorithms/entry.h"
#include "peeling/programs/depth_range.h"
#include "peeling/programs/programs.h"
#include "peeling/programs/sums.h"
#include "peeling/programs/under.h"

namespace strata::peeling::listing::weighted_sum {

using namespace pipeline;

void run(Region& region) {
    const Target sums = region.make(region.frame().color_format == Format::rgba32f ? Format::rgba32f : Format::rgba16f);
    const Target result = region.make(region.frame().picture_format());
    region.set_name(sums, "sums");
    region.set_name(result, "result");
    region.clear(sums, {});
    PassState add;
    add.depth = {.enabled = true, .func = CompareFunc::less, .write = false};
    add.depth_target = region.opaque_depth();
    add.color[0] = sums;
    add.blend[0] = blend_mode::sum;
    add.needs.shader_z = add.needs.code = false;
    region.begin_iteration();
    static_cast<void>(region.draw_sums(add));
    PassState resolve;
    resolve.color[0] = result;
    resolve.reads = {sums, region.opaque_color()};
    const float least = least_overflow(region, sums);
    PixelSet overflown{region};
    static_cast<void>(region.full_screen(resolve, [&](const FragmentBatch& in, const Loads& loads, Outputs& out) {
        const ColorLanes& sum = loads.color(0);
        for (std::size_t i = 0; i < lanes(in); ++i)
            if (!(sum[0][i] < least && sum[1][i] < least && sum[2][i] < least && sum[3][i] < least))
                overflown.add(in.pixel[i]);
        for (std::size_t c = 0; c < 3; ++c)
            for (std::size_t i = 0; i < lanes(in); ++i)
                out.color[0][c][i] = loads.color(0)[c][i] + loads.color(1)[c][i] * (1.0f - loads.color(0)[3][i]);
        for (std::size_t i = 0; i < lanes(in); ++i)
            out.color[0][3][i] = scalar::alpha_over(1.0f - loads.color(0)[3][i], loads.color(1)[3][i]);
    }));
    overflown.report(region, Fault::half_saturated, "a sum of colours has overflowed");
    region.publish(result);
}

std::vector<Algorithm> entries() {
    return {Algorithm{.name = "weighted_sum",
                      .listed = 80,
                      .paper = "Bavoil and Myers 2008",
                      .section = "Weighted Sum",
                      .summary = "order-dependent terms ignored; darkens where alphas add up to more than 1",
                      .pass_formula = "1",
                      .ties = TiePolicy::none,
                      .key = DepthKey::shader_z,
                      .geometry_passes = one_pass,
                      .run = run,
                      .features = {float_targets, fragment_programs}}};
}

}  // namespace strata::peeling::listing::weighted_sum
