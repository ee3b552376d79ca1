// pipeline/vertices/draw_list.h - what a scene hands to the machine: meshes, materials, textures, instances and a view. Plain values.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/device/vertex_path.h"
#include "pipeline/formats/texture.h"
#include "rasterizer/base/vector.h"

namespace strata::pipeline {

using strata::identity;
using strata::Matrix;
using strata::Rgba;
using strata::Vec2;
using strata::Vec3;

// Object space. `normals` is never empty when the material is lit; `colors` and `texcoords` may be empty.
struct Mesh {
    std::string name;
    std::vector<Vec3> positions;
    std::vector<Vec3> normals;
    std::vector<Rgba> colors;
    std::vector<Vec2> texcoords;  // the set that the material's base colour texture names, transform already applied
    std::vector<std::uint32_t> indices;  // three a triangle
    friend bool operator==(const Mesh&, const Mesh&) = default;
};

enum class AlphaMode : std::uint8_t { opaque, mask, blend };  // glTF 2.0, 3.9.4

// encoded: sRGB values are blended as they are, as the hardware did (default). linear: decoded first, encoded when a PNG is written.
enum class ColorSpace : std::uint8_t { encoded, linear };

// Colours are in the frame's colour space.
struct Material {
    std::string name;
    Rgba front{1, 1, 1, 1};
    Rgba back{1, 1, 1, 1};  // equal to front unless the surface has two colours (the teapot: red outside, green inside)
    AlphaMode alpha_mode = AlphaMode::opaque;
    float alpha_cutoff = 0.5f;
    int texture = -1;  // index into DrawList::textures
    bool double_sided = false;
    bool unlit = false;
    friend bool operator==(const Material&, const Material&) = default;
};

struct Instance {
    std::uint32_t mesh = 0, material = 0;
    Matrix model = identity;
    bool arrives_sorted = false;  // front to back at every pixel, as listed, from the scene's own view
    friend bool operator==(const Instance&, const Instance&) = default;
};

// A light that casts shadows: how it sees the scene, and how its shadow map is made and looked at. What it does not see
// keeps `ambient` of its colour.
struct ShadowLight {
    Matrix view = identity, projection = identity;    // world to the light's eye, to its clip space
    int size_px = 512;                                // of the square shadow map
    float ambient = 0.5f;                             // 0 to 1
    float offset_factor = 0.0f, offset_units = 0.0f;  // polygon offset of the shadow map's depths
    bool percentage_closer = true;                    // four comparisons, weighted; false: the nearest texel's
    friend bool operator==(const ShadowLight&, const ShadowLight&) = default;
};

struct DrawList {
    std::optional<ShadowLight> light{};
    std::vector<Mesh> meshes;
    std::vector<Material> materials;
    std::vector<Texture> textures;
    std::vector<Instance> instances;  // in submission order
};

struct View {
    Matrix view = identity;        // world to eye
    Matrix projection = identity;  // eye to clip
    VertexPath vertex_path = VertexPath::separate;
};

}  // namespace strata::pipeline
