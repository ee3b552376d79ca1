// peeling/algorithms/shadow_map.cpp - one layer per pass with a shadow map rendered from the eye. Everitt 2001, "Shadow
// Mapping as Depth Test"; peeling/reference/algorithms.md 3.
//
// Needs      depth textures and an alpha test; shadow_map_depth_replace also NV_texture_shader.
// Passes     N + 1 for N distinct depths if the compared depth R is the stored one (depth_replace writes,
//            perspective_rq compares). If R is computed by another path, a fragment may compare as behind its own
//            stored depth, and its layer is never removed.
// Invariant  before pass i, `map` = the copied depth buffer of pass i-1, and layers 0 .. i-1 are saved; alpha is 0
//            where a pixel has no such layer.
#include "peeling/algorithms/entry.h"
#include "peeling/programs/layer_quads.h"
#include "peeling/programs/region_programs.h"

namespace strata::peeling::listing::shadow_map {

using namespace pipeline;

namespace {

struct ShadowTargets {
    Target color, depth;  // targets of the frame
    Target map;           // the depth texture of the previous pass; none in the first
};

// A fragment whose R is not behind the map is in shadow: its alpha is multiplied by (1 - shadow), and the alpha test
// discards alpha 0. The map's texel is the one at the fragment's own pixel: s/q and t/q of a screen-aligned lookup are
// off by less than a subpixel (pipeline/reference/texturing.md 2.4). Fragments that store alpha 0 are also discarded in
// pass 0: a layer of theirs would be invisible.
DrawCounts peel(Region& region, const ShadowTargets& to) {
    const bool first = !to.map.exists();
    const DepthCompare compare = region.frame().depth_compare();
    PassState state;
    state.alpha = {.enabled = true, .func = CompareFunc::greater, .ref = 0.0f};
    state.depth = {.enabled = true, .func = CompareFunc::less, .write = true};
    state.depth_target = to.depth;
    state.color[0] = to.color;
    state.reads[0] = to.map;
    state.needs.shader_z = false;
    state.needs.reference = !first;
    state.selection = nearest_behind(compare, to.map);
    const PreparedDraw& list = first ? *region.frame().transparent : region.frame().second_list();
    return region.draw(state, list, [first, compare](const FragmentBatch& in, const Loads& loads, Outputs& out) {
        out.color[0] = in.color;
        if (first) return;
        Lanes<float>& alpha = out.color[0][3];
        const bool by_codes = compare.compares_codes() && compare.epsilon.ulps == 0;
        for (std::size_t i = 0; by_codes && i < lanes(in); ++i)
            alpha[i] = select(mask(in.reference_code[i] > loads.depth(0)[i]), alpha[i], 0.0f);
        for (std::size_t i = 0; !by_codes && i < lanes(in); ++i)
            alpha[i] = select(mask(compare.is_behind(in.reference_code[i], in.reference_z[i], loads.depth(0)[i])),
                              alpha[i], 0.0f);
    });
}

// The copy of glCopyTexSubImage2D, of the whole buffer.
[[nodiscard]] Target copied(Region& region, Target from, Target to) {
    region.copy(from, to);
    return to;
}

}  // namespace

void run(Region& region) {
    ShadowTargets buffers{region.make_color(), region.make_depth(), {}};
    region.set_name(buffers.color, "color");
    region.set_name(buffers.depth, "depth");
    SavedLayers layers;
    while (!region.limit_reached()) {
        region.begin_iteration();
        region.clear(buffers.color, {.color = {0, 0, 0, 0}});
        region.copy(region.opaque_depth(), buffers.depth);
        const DrawCounts drawn = peel(region, buffers);
        buffers.map = copied(region, buffers.depth, region.make_depth());
        layers.depth.push_back(buffers.map);
        region.set_name(buffers.map, "map");
        layers.color.push_back(copied(region, buffers.color, region.make_color()));
        region.set_name(layers.color.back(), "layer");
        if (!region.any(drawn.passed, idle_when_zero(region.frame()))) {
            region.keep_no_layer(layers.color.back(), layers.depth.back());
            break;
        }
        region.keep_layer(layers.color.back(), layers.depth.back());
    }
    publish_quads(region, layers);
}

std::vector<Algorithm> entries() {
    return {
        Algorithm{
            .name = "shadow_map",
            .listed = 30,
            .paper = "Everitt 2001",
            .section = "Shadow Mapping as Depth Test; An Invariance Issue",
            .summary =
                "one layer a pass by shadow comparison and alpha test; its two depths may differ in their last bits",
            .pass_formula = "N + 1 where the compared depth is the stored one",
            .ties = TiePolicy::unique,
            .key = DepthKey::stored_code,
            .makes_layers = true,
            .kills_alpha_zero = true,
            .geometry_passes = every_layer_and_one,
            .run = run,
            .compares = DepthPath::perspective_rq},
        Algorithm{
            .name = "shadow_map_depth_replace",
            .listed = 30,
            .paper = "Everitt 2001",
            .section = "An Invariance Issue, Listing 2",
            .summary = "the same with a depth replaced by a texture shader: stored and compared depth are one quotient",
            .pass_formula = "N + 1",
            .ties = TiePolicy::unique,
            .key = DepthKey::stored_code,
            .exact = true,
            .makes_layers = true,
            .kills_alpha_zero = true,
            .geometry_passes = every_layer_and_one,
            .run = run,
            .features = {depth_replace},
            .stores = DepthPath::depth_replace,
            .compares = DepthPath::perspective_rq}};
}

}  // namespace strata::peeling::listing::shadow_map
