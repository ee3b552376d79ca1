// peeling/algorithms/fixed_passes/unsorted.cpp - OVER in submission order: the baseline; with triangles sorted by
// centroid, the painter's algorithm. peeling/reference/algorithms.md 1.
//
// Needs      nothing.
// Passes     1.
// Invariant  the target holds the fragments drawn so far, blended OVER; correct exactly where every pixel's fragments
//            are submitted back to front.
#include "peeling/algorithms/entry.h"
#include "peeling/programs/programs.h"
#include "peeling/programs/region_programs.h"

namespace strata::peeling::listing::unsorted {

using namespace pipeline;

void run(Region& region) {
    const Target color = region.make_color();
    region.set_name(color, "color");
    region.copy(region.opaque_color(), color);
    PassState state;
    state.depth = {.enabled = true, .func = CompareFunc::less, .write = false};
    state.depth_target = region.opaque_depth();
    state.color[0] = color;
    state.blend[0] = over_background(region.frame());
    state.needs.shader_z = false;
    region.begin_iteration();
    static_cast<void>(region.draw(state, [](const FragmentBatch& in, const Loads&, Outputs& out) {
        out.color[0] = in.color;
        out.traced = true;
        for (std::size_t i = 0; i < lanes(in); ++i) {
            out.side[i] = Side::back;
            out.key[i] = in.code[i];
        }
    }));
    region.publish(color);
}

std::vector<Algorithm> entries() {
    return {Algorithm{.name = "unsorted",
                      .listed = 10,
                      .paper = "Everitt 2001",
                      .section = "Figure 1 (b)",
                      .summary = "OVER in submission order; right where every pixel's fragments arrive back to front",
                      .pass_formula = "1",
                      .ties = TiePolicy::none,
                      .key = DepthKey::stored_code,
                      .blends_in_picture = true,
                      .geometry_passes = one_pass,
                      .run = run},
            Algorithm{.name = "painter",
                      .listed = 10,
                      .paper = "Everitt 2001",
                      .section = "Introduction",
                      .summary = "OVER of triangles sorted by centroid, far first; fails where triangles cross",
                      .pass_formula = "1",
                      .ties = TiePolicy::last,
                      .key = DepthKey::stored_code,
                      .order = ListOrder::back_to_front,
                      .blends_in_picture = true,
                      .geometry_passes = one_pass,
                      .run = run}};
}

}  // namespace strata::peeling::listing::unsorted
