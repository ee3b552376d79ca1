// tests/support/fragment_scene.h - frames whose pixels get exactly the fragments that a test specifies, in its order.
// Each fragment is a right triangle with legs of 1.5 pixels at its pixel's corner: it covers only that pixel's centre.
// Window positions are multiples of half a pixel and depths small binary fractions, so every intermediate value is
// exact.
#pragma once
#include <algorithm>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "pipeline/vertices/draw_list.h"

namespace strata::testing {

struct GivenFragment {
    float depth = 0;         // window depth; 2 depth - 1 must be exact in binary32
    pipeline::Rgba color{};  // not premultiplied
};

struct GivenPixel {
    std::vector<GivenFragment> fragments;  // transparent, in submission order
    std::optional<GivenFragment> opaque{};
};

struct FragmentScene {
    int width = 1, height = 1;       // powers of two
    std::vector<GivenPixel> pixels;  // row by row from the top left

    FragmentScene(int w, int h)
        : width{w}, height{h}, pixels(static_cast<std::size_t>(w) * static_cast<std::size_t>(h)) {}
};

inline void add_fragment(pipeline::Mesh& mesh, const FragmentScene& scene, std::size_t pixel, const GivenFragment& f) {
    const auto columns = static_cast<std::size_t>(scene.width);
    const float pixel_width = 2.0f / static_cast<float>(scene.width),
                pixel_height = 2.0f / static_cast<float>(scene.height);
    const float left = static_cast<float>(pixel % columns) * pixel_width - 1.0f;
    const float top = 1.0f - static_cast<float>(pixel / columns) * pixel_height;
    const float z = 2.0f * f.depth - 1.0f;
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(),
                          {{left, top, z}, {left, top - 1.5f * pixel_height, z}, {left + 1.5f * pixel_width, top, z}});
    mesh.colors.insert(mesh.colors.end(), 3, f.color);
    mesh.indices.insert(mesh.indices.end(), {first, first + 1, first + 2});
}

// Unlit and double-sided, to be drawn with identity matrices. Submission: the first fragments of all pixels, then the
// second ones, and so on.
[[nodiscard]] inline pipeline::DrawList draw_list(const FragmentScene& scene) {
    pipeline::Mesh transparent, opaque;
    std::size_t deepest = 0;
    for (const GivenPixel& pixel : scene.pixels) deepest = std::max(deepest, pixel.fragments.size());
    for (std::size_t round = 0; round < deepest; ++round)
        for (std::size_t p = 0; p < scene.pixels.size(); ++p)
            if (round < scene.pixels[p].fragments.size())
                add_fragment(transparent, scene, p, scene.pixels[p].fragments[round]);
    for (std::size_t p = 0; p < scene.pixels.size(); ++p)
        if (scene.pixels[p].opaque) add_fragment(opaque, scene, p, *scene.pixels[p].opaque);
    pipeline::DrawList list;
    list.materials = {
        {.name = "transparent", .alpha_mode = pipeline::AlphaMode::blend, .double_sided = true, .unlit = true},
        {.name = "opaque", .double_sided = true, .unlit = true}};
    for (pipeline::Mesh* mesh : {&transparent, &opaque}) {
        const auto number = static_cast<std::uint32_t>(list.meshes.size());
        if (!mesh->indices.empty()) list.instances.push_back({.mesh = number, .material = number});
        list.meshes.push_back(std::move(*mesh));
    }
    return list;
}

// The visible fragments, which are nearer than the opaque surface (or than the clear value 1): the input of a
// fragment-ordering model.
[[nodiscard]] inline std::vector<GivenFragment> visible(const GivenPixel& pixel) {
    const float limit = pixel.opaque ? pixel.opaque->depth : 1.0f;
    std::vector<GivenFragment> kept;
    for (const GivenFragment& f : pixel.fragments)
        if (f.depth < limit) kept.push_back(f);
    return kept;
}

}  // namespace strata::testing
