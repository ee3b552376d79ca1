#include "tools/oracle/reduce/defaults.h"

#include "tools/request/complete.h"
#include "tools/request/option_fields.h"

namespace strata::oracle {

namespace {

using peeling::RenderOptions;
using pipeline::Material;
using pipeline::Mesh;
using tools::OptionField, tools::OptionGroup, tools::PictureRequest;

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

std::vector<Simplification> of_scene() {
    return {{"the light", [](Golden& g) { return becomes(g.scene.list.light, {}); }},
            {"the file's lights", [](Golden& g) { return becomes(g.scene.list.lights, {}); }},
            {"textures",
             [](Golden& g) {
                 return any_of_all(g.scene.list.materials, [](Material& m) { return becomes(m.texture, -1); });
             }},
            {"lighting",
             [](Golden& g) {
                 return any_of_all(g.scene.list.materials, [](Material& m) { return becomes(m.unlit, true); });
             }},
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
            {"depth clamp", [](Golden& g) { return becomes(g.options.raster.depth_clamp, false); }}};
}

// Resets options of the table; false if they have their defaults or do not go together then.
bool reset(Golden& scene, const std::function<bool(const OptionField&)>& is_reset) {
    PictureRequest request = tools::request_of(scene.options);
    bool has_changed = false;
    for (const OptionField& field : tools::option_fields()) {
        if (!is_reset(field) || field.is_default(request)) continue;
        field.copy(request, {});
        has_changed = true;
    }
    if (!has_changed || tools::option_conflict(request)) return false;
    tools::complete(request, scene.profile);
    scene.options = request.render;
    return true;
}

bool is_of_samples(const OptionField& field) {
    return field.group == OptionGroup::samples || field.group == OptionGroup::shading;
}

// The view is written in its conventions, which therefore stay.
bool is_convention(const OptionField& field) { return field.name == "clip-depth" || field.name == "depth-order"; }

}  // namespace

std::vector<Simplification> simplifications() {
    std::vector<Simplification> all = of_scene();
    all.push_back({"the samples of a pixel", [](Golden& g) { return reset(g, is_of_samples); }});
    for (const OptionField& field : tools::option_fields())
        if (tools::is_of_frame(field) && !is_convention(field))
            all.push_back({field.option(), [&field](Golden& g) {
                               return reset(g, [&](const OptionField& other) { return &other == &field; });
                           }});
    return all;
}

}  // namespace strata::oracle
