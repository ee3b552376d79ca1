// peeling/algorithms/object_sorted.cpp - objects are ordered front to back by occlusion queries, then each is
// composited in submission order. Govindaraju et al. 2005, compared in Carr, Mech and Miller 2008, section 2;
// peeling/reference/algorithms.md 16.
//
// Needs      occlusion queries, separate alpha blending.
// Passes     1 per object and 2 per query, for n objects: 3 n - 2 if submitted front to back, n^2 + 2 n - 2 at most.
//            Fragments of one object stay in submission order, and cycles of objects are not split: both are diagnosed,
//            not repaired.
// Invariant  at every pixel everything composited is in front of all remaining objects, unless a fault is reported.
#include <vector>

#include "peeling/algorithms/entry.h"
#include "peeling/programs/depth_range.h"
#include "peeling/programs/region_programs.h"

namespace strata::peeling::listing::object_sorted {

using namespace pipeline;

namespace {

using Objects = std::vector<PrimitiveRange>;

// True if object `which` is behind any of the others at some pixel: counts its fragments that are behind the nearest
// fragment of the others.
bool is_occluded(Region& region, const Objects& remaining, std::size_t which, Target nearest) {
    Objects others = remaining;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(which));
    region.copy(region.opaque_depth(), nearest);
    PassState state;
    state.depth = {.enabled = true, .func = CompareFunc::less, .write = true};
    state.depth_target = nearest;
    state.needs = code_only;
    state.primitives = others;
    static_cast<void>(region.draw(state, [](const FragmentBatch&, const Loads&, Outputs&) {}));
    state.depth = {.enabled = true, .func = CompareFunc::greater, .write = false};
    state.reads[0] = region.opaque_depth();
    state.primitives = {&remaining[which], 1};
    const DrawCounts behind = region.draw(
        state, [](const FragmentBatch& in, const Loads& loads, Outputs& out) { keep_before(in, loads.depth(0), out); });
    return region.any(behind.passed, Idle::no);
}

// The object's own fragments are blended UNDER in submission order; they are not sorted.
void composite(Region& region, const PrimitiveRange& object, Target accumulated) {
    PassState state = composite_state(accumulated);
    state.depth = {.enabled = true, .func = CompareFunc::less, .write = false};
    state.depth_target = region.opaque_depth();
    state.primitives = {&object, 1};
    static_cast<void>(
        region.draw(state, [](const FragmentBatch& in, const Loads&, Outputs& out) { composite_under(in, out); }));
}

// Returns the first object that no other one occludes, or index 0 if each is occluded (a cycle).
std::size_t front_object(Region& region, const Objects& remaining, Target nearest) {
    if (remaining.size() == 1) return 0;
    for (std::size_t i = 0; i < remaining.size(); ++i) {
        if (region.limit_reached(2)) return 0;
        if (!is_occluded(region, remaining, i, nearest)) return i;
    }
    report(region, Fault::out_of_order, "no object lies in front of all others: the first is taken");
    return 0;
}

}  // namespace

void run(Region& region) {
    const Target accumulated = region.make_color(), nearest = region.make_depth();
    region.set_name(accumulated, "accumulated");
    region.set_name(nearest, "nearest");
    region.clear(accumulated, {.color = {0, 0, 0, 1}});
    Objects remaining;
    for (const DrawPart& part : region.frame().transparent->parts)
        if (part.near <= part.far) remaining.push_back(part.primitives);
    while (!remaining.empty() && !region.limit_reached()) {
        region.begin_iteration();
        const std::size_t front = front_object(region, remaining, nearest);
        if (region.limit_reached()) break;
        composite(region, remaining[front], accumulated);
        remaining.erase(remaining.begin() + static_cast<std::ptrdiff_t>(front));
    }
    publish_over_background(region, accumulated, region.opaque_color());
}

std::vector<Algorithm> entries() {
    return {Algorithm{
        .name = "object_sorted",
        .listed = 160,
        .paper = "Govindaraju et al. 2005",
        .section = "",
        .summary = "objects ordered by occlusion queries, then composited; wrong where objects or their own triangles "
                   "overlap out of order",
        .pass_formula = "3 n - 2 to n^2 + 2 n - 2, n objects",
        .ties = TiePolicy::first,
        .order = ListOrder::objects,
        .whole_frame = true,
        .compares_own_codes = true,
        .run = run,
        .features = {fragment_programs, separate_alpha_blend}}};
}

}  // namespace strata::peeling::listing::object_sorted
