// peeling/algorithms/fixed_passes/bucket_peel.cpp - divides the depth range of every pixel into 16 equal buckets and
// composites the nearest and the farthest fragment of each. Liu et al. 2009, "Efficient Depth Peeling via Bucket Sort",
// sections 3 and 4; peeling/reference/algorithms.md 24.
//
// Needs      float MAX blending, eight render targets, separate alpha blending. GeForce8 has all of these.
// Passes     6: one for the bounds of depth, one for the buckets, four for colours. Fragments of equal depth are
//            merged. Fragments between the nearest and the farthest of a bucket are lost, which is reported.
// Invariant  before colour pass p, `accumulated` = buckets 0 to 4 p - 1, composited.
#include <array>

#include "peeling/algorithms/entry.h"
#include "peeling/programs/depth_float.h"
#include "peeling/programs/depth_range.h"
#include "peeling/programs/fixed_passes/buckets.h"
#include "peeling/programs/region_programs.h"

namespace strata::peeling::listing::bucket_peel {

using namespace pipeline;

namespace {

constexpr std::size_t targets = buckets / 2, in_a_pass = 4;  // two buckets per target: (-near, far) of each
constexpr Rgba empty_ends{-2, -2, -2, -2};
PassState max_state(const Region& region) {
    PassState state;
    state.depth = {.enabled = true, .func = CompareFunc::less, .write = false};
    state.depth_target = region.opaque_depth();
    state.blend.fill(blend_mode::max);
    state.needs = code_only;
    return state;
}

void find_bounds(Region& region, Target bounds, DepthFormat format) {
    region.clear(bounds, {.color = empty_ends});
    PassState state = max_state(region);
    state.color[0] = bounds;
    static_cast<void>(region.draw(state, [format](const FragmentBatch& in, const Loads&, Outputs& out) {
        for (std::size_t i = 0; i < lanes(in); ++i) {
            out.color[0][1][i] = depth_as_float(in.code[i], format);
            out.color[0][0][i] = 0.0f - out.color[0][1][i];
        }
    }));
}

void fill_buckets(Region& region, Target bounds, const std::array<Target, targets>& ends, DepthFormat format) {
    const bool reversed = has_float_keys(region.frame());
    PassState state = max_state(region);
    state.color = ends;
    state.reads[0] = bounds;
    for (const Target target : ends) region.clear(target, {.color = empty_ends});
    static_cast<void>(region.draw(state, [format, reversed](const FragmentBatch& in, const Loads& loads, Outputs& out) {
        for (std::size_t i = 0; i < lanes(in); ++i) {
            const float depth = depth_as_float(in.code[i], format);
            const std::size_t own_bucket = bucket_of(reversed, depth, loads.color(0)[0][i], loads.color(0)[1][i]);
            for (std::size_t b = 0; b < buckets; ++b) {
                const std::size_t channel = b % 2 * 2;
                out.color[b / 2][channel][i] = b == own_bucket ? 0.0f - depth : empty_ends[0];
                out.color[b / 2][channel + 1][i] = b == own_bucket ? depth : empty_ends[0];
            }
        }
    }));
}

// One colour pass: the premultiplied colours of the nearest and the farthest fragments of four buckets, in eight
// targets under MAX. The only fragment of a bucket is written as its nearest.
void find_colors(Region& region, Target bounds, std::size_t first, const std::array<Target, targets>& ends,
                 const std::array<Target, targets>& colors, PixelSet& lost) {
    PassState state = max_state(region);
    state.needs = code_with_color;
    state.color = colors;
    state.reads = {bounds, ends[first / 2], ends[first / 2 + 1], region.opaque_depth()};
    for (const Target target : colors) region.clear(target, {});
    const DepthFormat format = region.frame().key_request().format;
    const bool reversed = has_float_keys(region.frame());
    static_cast<void>(region.draw(state, [&](const FragmentBatch& in, const Loads& loads, Outputs& out) {
        for (std::size_t i = 0; i < lanes(in); ++i) {
            const float depth = depth_as_float(in.code[i], format), a = in.color[3][i];
            const std::size_t bucket = bucket_of(reversed, depth, loads.color(0)[0][i], loads.color(0)[1][i]) - first;
            std::size_t place = targets;  // no target: the fragment writes 0
            if (bucket < in_a_pass && in.code[i] < loads.depth(3)[i]) {
                const ColorLanes& both = loads.color(static_cast<int>(1 + bucket / 2));
                const std::size_t channel = bucket % 2 * 2;
                const bool is_near = 0.0f - depth == both[channel][i], is_far = depth == both[channel + 1][i];
                if (is_near || is_far)
                    place = 2 * bucket + (is_near ? 0 : 1);
                else if (out.alive[i] != 0)
                    lost.add(in.pixel[i]);
            }
            for (std::size_t t = 0; t < targets; ++t) {
                for (std::size_t c = 0; c < 3; ++c) out.color[t][c][i] = t == place ? in.color[c][i] * a : 0.0f;
                out.color[t][3][i] = t == place ? a : 0.0f;
            }
        }
    }));
}

// Composites the eight layers of a colour pass UNDER, near to far. A pixel without a fragment in a layer has 0 there,
// which UNDER ignores.
void composite(Region& region, const std::array<Target, targets>& colors, Target accumulated) {
    for (const Target layer : colors) {
        PassState state;
        state.color[0] = accumulated;
        state.blend[0] = blend_mode::under;
        state.reads[0] = layer;
        static_cast<void>(region.full_screen(
            state, [](const FragmentBatch&, const Loads& loads, Outputs& out) { out.color[0] = loads.color(0); }));
    }
}

}  // namespace

void run(Region& region) {
    std::array<Target, targets> ends, colors;
    const Target bounds = region.make(Format::rg32f), accumulated = region.make_color();
    region.set_name(bounds, "bounds"), region.set_name(accumulated, "accumulated");
    for (std::size_t t = 0; t < targets; ++t) {
        region.set_name(ends[t] = region.make(Format::rgba32f), "buckets");
        region.set_name(colors[t] = region.make_color(), "layer");
    }
    region.clear(accumulated, {.color = {0, 0, 0, 1}});
    const DepthFormat format = region.frame().key_request().format;
    PixelSet lost{region};
    const bool has_passes = !region.limit_reached(3);
    if (has_passes) {
        region.begin_iteration();
        find_bounds(region, bounds, format);
        fill_buckets(region, bounds, ends, format);
    }
    for (std::size_t first = 0; has_passes && first < buckets && !region.limit_reached(); first += in_a_pass) {
        find_colors(region, bounds, first, ends, colors, lost);
        composite(region, colors, accumulated);
    }
    lost.report(region, Fault::buffer_overflow, "more than two depths in a bucket: those between its ends are lost");
    publish_over_background(region, accumulated, region.opaque_color());
}

std::vector<Algorithm> entries() {
    return {Algorithm{.name = "bucket_peel",
                      .listed = 240,
                      .paper = "Liu et al. 2009",
                      .section = "Efficient Depth Peeling via Bucket Sort",
                      .summary = "a pixel's depths in 16 equal buckets, of each the nearest and the farthest fragment",
                      .pass_formula = "6",
                      .ties = TiePolicy::none,
                      .compares_own_codes = true,
                      .geometry_passes = [](int) { return 6; },
                      .run = run,
                      .features = {float_targets, fragment_programs, separate_alpha_blend},
                      .render_targets = 8}};
}

}  // namespace strata::peeling::listing::bucket_peel
