// peeling/algorithms/fixed_passes/weighted_average.cpp - one pass; every colour of a pixel is replaced by the average
// weighted by alpha. Bavoil and Myers 2008, "Weighted Average"; peeling/reference/algorithms.md 7, erratum E8.
//
// Needs      fp16 additive blending, two render targets.
// Passes     1. An approximation: exact where all fragments of a pixel have the same colour and alpha.
// Invariant  sums.rgb = sum of c a, sums.a = sum of a, count = fragments, in submission order and in the targets'
//            precision.
// Outside literal execution and without textures, the rasterizer's rows are added directly into fp16 and binary32
// targets (pipeline/stages/sum_rows.h; Region::draw_sums chooses). This needs AVX2 and half conversion;
// tests/peeling/execution/execution_test.cpp shows that the bits equal the pass's.
#include "peeling/algorithms/entry.h"
#include "peeling/programs/average.h"
#include "peeling/programs/sums.h"

namespace strata::peeling::listing::weighted_average {

using namespace pipeline;

namespace {

Target accumulate(Region& region, Target sums, Target count) {
    region.clear(sums, {});
    region.clear(count, {});
    PassState state;
    state.depth = {.enabled = true, .func = CompareFunc::less, .write = false};
    state.depth_target = region.opaque_depth();
    state.color = {sums, count};
    state.blend = {blend_mode::sum, blend_mode::sum};
    state.needs.shader_z = state.needs.code = false;
    region.begin_iteration();
    static_cast<void>(region.draw_sums(state));
    return sums;
}

struct StuckPixels {
    std::uint64_t pixels = 0;
    std::uint32_t first = ~0u;
};

// Reads sums, count and background.
StuckPixels resolve(Region& region, const PassState& state) {
    const bool half_count = region.storage(state.reads[1]).format() == Format::r16f;
    const float least = least_overflow(region, state.reads[0]);
    StuckPixels stuck;
    const auto area = static_cast<std::uint32_t>(region.rect().area());
    static_cast<void>(region.full_screen(state, [&](const FragmentBatch& in, const Loads& loads, Outputs& out) {
        const ColorLanes& sum = loads.color(0);
        const Lanes<float>& n = loads.color(1)[0];
        resolve_average(sum, n, loads.color(2), out.color[0], lanes(in));
        for (std::size_t i = 0; i < lanes(in); ++i) {
            const bool is_sum_whole = sum[0][i] < least && sum[1][i] < least && sum[2][i] < least && sum[3][i] < least;
            if (!(half_count && n[i] >= 2048.0f) && is_sum_whole) continue;
            ++stuck.pixels;
            stuck.first = std::min(stuck.first, in.pixel[i] % area);
        }
    }));
    return stuck;
}

}  // namespace

void run(Region& region) {
    const Target sums = make_sums(region);
    const Format count_format = has_wide_sums(region) ? Format::r32f : region.frame().average_count;
    const Target count = region.make(count_format), result = region.make(region.frame().picture_format());
    region.set_name(sums, "sums");
    region.set_name(count, "count");
    region.set_name(result, "result");
    accumulate(region, sums, count);
    PassState state;
    state.color[0] = result;
    state.reads = {sums, count, region.opaque_color()};
    const StuckPixels stuck = resolve(region, state);
    region.report(Fault::half_saturated, stuck.pixels, stuck.first, "an fp16 sum or count has stopped growing");
    region.publish(result);
}

std::vector<Algorithm> entries() {
    return {Algorithm{.name = "weighted_average",
                      .listed = 70,
                      .paper = "Bavoil and Myers 2008",
                      .section = "Weighted Average",
                      .summary = "every colour replaced by the average weighted by alpha; an approximation",
                      .pass_formula = "1",
                      .ties = TiePolicy::none,
                      .key = DepthKey::shader_z,
                      .geometry_passes = one_pass,
                      .run = run,
                      .features = {float_targets, fragment_programs},
                      .render_targets = 2}};
}

}  // namespace strata::peeling::listing::weighted_average
