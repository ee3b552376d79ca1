#include "tools/oracle/reduce/defaults.h"

namespace strata::oracle {

namespace {

using peeling::RenderOptions;
using pipeline::Material;
using pipeline::Mesh;

// Sets `value`; true if it was different.
template <class T>
bool becomes(T& value, const T& wanted) {
    if (value == wanted) return false;
    value = wanted;
    return true;
}

// Calls change(x) for all; true if one of them returned true.
template <class T, class Change>
bool any_of_all(std::vector<T>& values, Change change) {
    bool has_changed = false;
    for (T& value : values) has_changed |= change(value);
    return has_changed;
}

constexpr Simplification all_simplifications[] = {
    {"loads of other samples",
     [](Golden& g) {
         const bool has_changed = becomes(g.options.sampling.loads, {});
         return becomes(g.options.sampling.composites, {}) || has_changed;
     }},
    {"the samples of a pixel",
     [](Golden& g) {
         if (!becomes(g.options.sampling.samples, 1)) return false;
         g.options.sampling = {};
         g.options.raster.interpolation = {};
         g.options.raster.sample_coverage = {};
         return true;
     }},
    {"the light", [](Golden& g) { return becomes(g.scene.list.light, {}); }},
    {"textures",
     [](Golden& g) { return any_of_all(g.scene.list.materials, [](Material& m) { return becomes(m.texture, -1); }); }},
    {"lighting",
     [](Golden& g) { return any_of_all(g.scene.list.materials, [](Material& m) { return becomes(m.unlit, true); }); }},
    {"colours of vertices",
     [](Golden& g) { return any_of_all(g.scene.list.meshes, [](Mesh& m) { return becomes(m.colors, {}); }); }},
    {"materials' colours",
     [](Golden& g) {
         return any_of_all(g.scene.list.materials, [](Material& m) {
             const float front = m.front[3], back = m.back[3];
             return becomes(m.front, {1, 1, 1, front}) | becomes(m.back, {1, 1, 1, back});
         });
     }},
    {"one-sided surfaces",
     [](Golden& g) {
         return any_of_all(g.scene.list.materials, [](Material& m) { return becomes(m.double_sided, true); });
     }},
    {"opaque surfaces",
     [](Golden& g) {
         return any_of_all(g.scene.list.materials,
                           [](Material& m) { return becomes(m.alpha_mode, pipeline::AlphaMode::blend); });
     }},
    {"the background", [](Golden& g) { return becomes(g.options.background, RenderOptions{}.background); }},
    {"the order of triangles", [](Golden& g) { return becomes(g.options.sort, {}); }},
    {"the polygon offset", [](Golden& g) { return becomes(g.options.raster.polygon_offset, {}); }},
    {"the scissor", [](Golden& g) { return becomes(g.options.raster.scissor, {}); }},
    {"depth clamp", [](Golden& g) { return becomes(g.options.raster.depth_clamp, false); }},
    {"the depth format", [](Golden& g) { return becomes(g.options.depth, {}); }},
    {"the depth path", [](Golden& g) { return becomes(g.options.depth_path, {}); }},
    {"the picture's format", [](Golden& g) { return becomes(g.options.result_format, {}); }},
    {"the back's format", [](Golden& g) { return becomes(g.options.back_format, {}); }},
    {"the colour format", [](Golden& g) { return becomes(g.options.color_format, {}); }},
    {"the limit of passes", [](Golden& g) { return becomes(g.options.max_passes, 0); }},
    {"the rule that ends the peel", [](Golden& g) { return becomes(g.options.termination, {}); }},
};

}  // namespace

std::span<const Simplification> simplifications() { return all_simplifications; }

}  // namespace strata::oracle
