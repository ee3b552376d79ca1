// peeling/algorithms/batched.cpp - objects are sorted by depth and divided into batches, and each batch's depth
// interval is peeled by itself. Wexler et al. 2005, compared in Carr, Mech and Miller 2008, section 2;
// peeling/reference/algorithms.md 15.
//
// Needs      a fragment program with discard (clip planes), separate alpha blending, a depth buffer that it can read.
// Passes     the sum over intervals of L + 1, where L is the number of layers in an interval. Of equal depths only the
//            first submitted is kept.
// Invariant  before interval j everything before its lower bound is composited. Intervals are half-open, so that a
//            fragment at a bound belongs to one of them.
#include <algorithm>
#include <utility>

#include "peeling/algorithms/entry.h"
#include "peeling/programs/depth_range.h"
#include "peeling/programs/layer_target.h"
#include "peeling/programs/region_programs.h"

namespace strata::peeling::listing::batched {

using namespace pipeline;

namespace {

constexpr std::size_t objects_in_a_batch = 4;

// Codes [low, high), and the objects that may have fragments in it.
struct CodeInterval {
    std::uint32_t low = 0, high = 0;
    std::vector<PrimitiveRange> objects;
};

struct ObjectDepths {
    std::uint32_t low = 0, high = 0;  // codes, inclusive
    PrimitiveRange primitives;
};

// The bounds are widened by one code on either side, more than the rounding of the conversion can need.
std::vector<ObjectDepths> objects_of(const Frame& frame) {
    const DepthFormat format = frame.key_request().format;
    // The bounds of the list are in z; w and its logarithm have no bounds.
    const rasterizer::DepthPath path = frame.key_request().path;
    const bool is_bounded = path != rasterizer::DepthPath::w_buffer && path != rasterizer::DepthPath::logarithmic;
    const auto code = [&](double z) { return to_depth_code(static_cast<float>(z), format, DepthRounding::nearest); };
    std::vector<ObjectDepths> objects;
    for (const DrawPart& part : frame.transparent->parts) {
        if (part.near > part.far) continue;  // the part draws nothing
        const std::uint32_t low = is_bounded ? code(part.near) : 0, high = is_bounded ? code(part.far) : ~0u - 1;
        objects.push_back({low - (low > 0 ? 1 : 0), high + 1, part.primitives});
    }
    return objects;
}

// Start of each batch: the nearest depth of every fourth object, with objects sorted nearest first.
std::vector<std::uint32_t> bounds_of(const std::vector<ObjectDepths>& objects) {
    std::vector<std::uint32_t> nearest, bounds{0};
    for (const ObjectDepths& o : objects) nearest.push_back(o.low);
    std::sort(nearest.begin(), nearest.end());
    for (std::size_t i = objects_in_a_batch; i < nearest.size(); i += objects_in_a_batch)
        if (nearest[i] > bounds.back()) bounds.push_back(nearest[i]);
    bounds.push_back(~0u);
    return bounds;
}

// Intervals cover all codes and do not overlap, so each fragment is peeled once. An object is drawn in every interval
// that its depth bounds overlap; an interval without objects has nothing to peel.
std::vector<CodeInterval> intervals_of(const Frame& frame) {
    const auto objects = objects_of(frame);
    const auto bounds = bounds_of(objects);
    std::vector<CodeInterval> intervals;
    for (std::size_t j = 0; j + 1 < bounds.size(); ++j) {
        CodeInterval interval{bounds[j], bounds[j + 1], {}};
        for (const ObjectDepths& o : objects)
            if (o.low < interval.high && o.high >= interval.low) interval.objects.push_back(o.primitives);
        if (!interval.objects.empty()) intervals.push_back(std::move(interval));
    }
    return intervals;
}

struct LayerTargets {
    Target layer, nearest, peeled, accumulated;
};

// front_to_back's peel over the interval's objects, with one more discard: codes outside [low, high).
DrawCounts peel(Region& region, const CodeInterval& interval, const LayerTargets& t, bool first) {
    region.clear(t.layer, {.color = {0, 0, 0, 0}});
    region.copy(region.opaque_depth(), t.nearest);
    PassState state;
    state.depth = {.enabled = true, .func = CompareFunc::less, .write = true};
    state.depth_target = t.nearest;
    state.color[0] = t.layer;
    state.reads[0] = t.peeled;
    state.needs = code_with_color;
    state.primitives = interval.objects;
    state.selection = {.keeps = KeptFragments::nearest, .least = interval.low, .most = interval.high - 1};
    if (!first) state.selection.near = KeyBound::beyond(t.peeled);
    return region.draw(state, [&, first](const FragmentBatch& in, const Loads& loads, Outputs& out) {
        premultiply(in.color, out.color[0], lanes(in));
        for (std::size_t i = 0; i < lanes(in); ++i)
            out.alive[i] &= mask(in.code[i] >= interval.low) & mask(in.code[i] < interval.high);
        if (!first) keep_behind(in, loads.depth(0), out);
    });
}

}  // namespace

void run(Region& region) {
    LayerTargets t{region.make_color(), region.make_depth(), region.make_depth(), region.make_color()};
    region.set_name(t.layer, "layer");
    region.set_name(t.peeled, "nearest");
    region.set_name(t.nearest, "nearest");
    region.set_name(t.accumulated, "accumulated");
    region.clear(t.accumulated, {.color = {0, 0, 0, 1}});
    for (const CodeInterval& interval : intervals_of(region.frame())) {
        region.begin_loop();
        for (bool first = true; !region.limit_reached(); first = false) {
            region.begin_iteration();
            const DrawCounts drawn = peel(region, interval, t, first);
            composite_layer(region, t.layer, t.nearest, t.accumulated);
            if (!region.any(drawn.passed, Idle::yes)) break;
            std::swap(t.peeled, t.nearest);
        }
    }
    publish_over_background(region, t.accumulated, region.opaque_color());
}

std::vector<Algorithm> entries() {
    return {Algorithm{.name = "batched",
                      .listed = 150,
                      .paper = "Wexler et al. 2005",
                      .section = "",
                      .summary = "objects taken in batches by depth, each batch's interval of depth peeled by itself",
                      .pass_formula = "sum of L + 1 over intervals",
                      .ties = TiePolicy::unique,
                      .exact = true,
                      .order = ListOrder::objects,
                      .runs_loops = true,
                      .compares_own_codes = true,
                      .run = run,
                      .features = {fragment_programs, separate_alpha_blend}}};
}

}  // namespace strata::peeling::listing::batched
