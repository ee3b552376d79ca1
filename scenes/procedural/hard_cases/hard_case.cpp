// scenes/procedural/hard_cases/hard_case.cpp - the list of all hard cases, and the scene of one (hard_case.h).
#include "scenes/procedural/hard_cases/hard_case.h"

#include <algorithm>

#include "scenes/bounds.h"
#include "scenes/numbers/srgb_encode.h"
#include "scenes/procedural/hard_cases/build_case.h"

namespace strata::scenes {

std::span<const HardCase> hard_cases() {
    using namespace hard;
    static const std::vector<HardCase> cases = [] {
        std::vector<HardCase> all;
        for (const auto& some : {plane_cases(), order_cases(), sliver_cases(), clip_cases(), depth_range_cases(),
                                 layer_cases(), alpha_cases(), input_cases(), frame_cases(), sample_cases()})
            all.insert(all.end(), some.begin(), some.end());
        return all;
    }();
    return cases;
}

const HardCase* find_hard_case(std::string_view name) {
    const auto cases = hard_cases();
    const auto found = std::ranges::find(cases, name, &HardCase::name);
    return found == cases.end() ? nullptr : &*found;
}

namespace {

// Colours outside 0 to 1 and NaN have no encoding: in the encoded space they are unchanged.
void convert_colors(pipeline::Mesh& mesh, pipeline::ColorSpace space) {
    if (space == pipeline::ColorSpace::encoded) return;
    for (pipeline::Rgba& color : mesh.colors) color = from_encoded(color, space);
}

}  // namespace

Scene make_hard_case(const SceneOptions& options, const HardCase& hard) {
    CaseScene built{.width = hard.width, .height = hard.height};
    hard.build(built);
    Scene scene;
    scene.name = "hard";
    built.transparent.name = "transparent";
    built.opaque.name = "opaque";
    scene.list.materials = {{.name = "transparent",
                             .alpha_mode = pipeline::AlphaMode::blend,
                             .texture = built.textures.empty() ? -1 : 0,
                             .double_sided = true,
                             .unlit = true},
                            {.name = "opaque", .double_sided = true, .unlit = true}};
    scene.list.textures = std::move(built.textures);
    for (pipeline::Mesh* mesh : {&built.transparent, &built.opaque}) {
        const auto number = static_cast<std::uint32_t>(scene.list.meshes.size());
        convert_colors(*mesh, options.color_space);
        if (!mesh->indices.empty()) scene.list.instances.push_back({.mesh = number, .material = number});
        scene.list.meshes.push_back(std::move(*mesh));
    }
    scene.own_view = built.view;
    scene.bounds = bounds_of(scene.list);
    return scene;
}

}  // namespace strata::scenes
