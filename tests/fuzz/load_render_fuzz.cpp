// tests/fuzz/load_render_fuzz.cpp - any bytes must be rejected with InputError or give a scene that can be rendered.
// Run: load_render_fuzz CORPUS (made by make_corpus); tools/test.sh runs it for one minute.
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <span>

#include "peeling/registry.h"
#include "peeling/render.h"
#include "rasterizer/base/input_error.h"
#include "scenes/camera.h"
#include "scenes/gltf/gltf.h"

namespace {

using strata::scenes::Scene;

// Small limits, so that a run reads many files instead of a few large ones; otherwise the same as in normal use.
constexpr strata::scenes::GltfLimits limits{.elements = 4096, .texels = 1 << 16, .instanced = 1 << 16};

void require(bool holds) {
    if (!holds) std::abort();
}

// Conditions that the renderer relies on without checking them.
void check_invariants(const Scene& scene) {
    for (const auto& mesh : scene.list.meshes) {
        require(mesh.indices.size() % 3 == 0 && !mesh.indices.empty());
        for (const std::uint32_t index : mesh.indices) require(index < mesh.positions.size());
        for (const std::size_t size : {mesh.normals.size(), mesh.colors.size(), mesh.texcoords.size()})
            require(size == 0 || size == mesh.positions.size());
    }
    for (const auto& texture : scene.list.textures)
        require(texture.texels.size() ==
                std::size_t{4} * static_cast<std::size_t>(texture.width) * static_cast<std::size_t>(texture.height));
    for (const auto& material : scene.list.materials)
        require(material.texture < static_cast<int>(scene.list.textures.size()));
    for (const auto& instance : scene.list.instances) {
        require(instance.mesh < scene.list.meshes.size() && instance.material < scene.list.materials.size());
        const auto& material = scene.list.materials[instance.material];
        require(material.unlit || !scene.list.meshes[instance.mesh].normals.empty());
        require(material.texture < 0 || !scene.list.meshes[instance.mesh].texcoords.empty());
    }
}

// Renders at 16 x 16 by the layered and the min-max peel with opaque surfaces first; replay, which rasterizes every
// pass here, and literal execution must agree.
void render(const Scene& scene) {
    strata::peeling::RenderOptions options{.width = 16, .height = 16, .max_passes = 8, .tile_size = 8, .threads = 1};
    const auto view = strata::scenes::orbit_view(scene.bounds, 30, 20, 1.0);
    const auto& profile = *strata::pipeline::find_profile("geforce8");
    std::array<strata::pipeline::Image, 2> color;
    for (const char* name : {"front_to_back", "dual"}) {
        for (const auto execution : {strata::pipeline::Execution::literal, strata::pipeline::Execution::replay}) {
            options.execution = execution;
            options.fragment_memory = 0;
            strata::peeling::Renderer renderer{scene.list, view, profile, options};
            auto result = renderer.render(*strata::peeling::find_algorithm(name));
            require(result.outcome == strata::peeling::Outcome::done);
            color[static_cast<std::size_t>(execution)] = std::move(result.frame.color);
        }
        require(color[0] == color[1]);
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    try {
        const Scene scene = strata::scenes::load_gltf_bytes(std::as_bytes(std::span(data, size)), "fuzz", {}, limits);
        check_invariants(scene);
        if (!scene.bounds.is_empty()) render(scene);
    } catch (const strata::InputError&) {
    }
    return 0;
}
