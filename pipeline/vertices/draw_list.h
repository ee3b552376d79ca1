// pipeline/vertices/draw_list.h - the input from a scene: meshes, materials, textures, instances and a view, as plain
// values.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/device/vertex_path.h"
#include "pipeline/formats/texture.h"
#include "pipeline/lighting/light.h"
#include "rasterizer/base/vector.h"
#include "rasterizer/rules/primitive.h"

namespace strata::pipeline {

using rasterizer::Primitive;
using strata::identity;
using strata::Matrix;
using strata::Rgba;
using strata::Vec2;
using strata::Vec3;

// A mesh in object space. `normals` must not be empty if the material is lit; `colors` and `texcoords` may be. An
// attribute is empty or has one value per position; three indices form a primitive (rasterizer/rules/primitive.h).
struct Mesh {
    std::string name;
    std::vector<Vec3> positions;
    // The fourth coordinates of homogeneous positions, for example in clip space with identity matrices; empty: 1.
    std::vector<float> w;
    std::vector<Vec3> normals;
    std::vector<Rgba> colors;
    // The coordinates for the material's base colour texture, with its transform applied.
    std::vector<Vec2> texcoords;
    // Three per triangle; a line has its first end twice, then the second; a point its vertex three times.
    std::vector<std::uint32_t> indices;
    Primitive primitive = Primitive::triangles;
    friend bool operator==(const Mesh&, const Mesh&) = default;
};

// glTF 2.0, 3.9.4: `mask` tests alpha against the material's cutoff, `blend` makes a surface transparent.
enum class AlphaMode : std::uint8_t { opaque, mask, blend };

// encoded: sRGB values are blended without decoding, as the hardware did (default). linear: decoded first, and encoded
// when a PNG is written.
enum class ColorSpace : std::uint8_t { encoded, linear };

// Colours are in the frame's colour space.
struct Material {
    std::string name;
    Rgba front{1, 1, 1, 1};
    // Equal to front unless the surface has two colours (the teapot: red outside, green inside).
    Rgba back{1, 1, 1, 1};
    AlphaMode alpha_mode = AlphaMode::opaque;
    float alpha_cutoff = 0.5f;
    // Index into DrawList::textures; -1 for none.
    int texture = -1;
    bool double_sided = false;
    bool unlit = false;
    friend bool operator==(const Material&, const Material&) = default;
};

// A mesh with a material and a model matrix.
struct Instance {
    std::uint32_t mesh = 0, material = 0;
    Matrix model = identity;
    // true: the triangles in the listed order are front to back at every pixel, seen from the scene's own view.
    bool arrives_sorted = false;
    friend bool operator==(const Instance&, const Instance&) = default;
};

// A light that casts shadows: its view of the scene, and how its shadow map is rendered and sampled. Surfaces outside
// the light's view keep `ambient` of their colour.
struct ShadowLight {
    // World to the light's eye space, and from there to its clip space.
    Matrix view = identity, projection = identity;
    // Side length of the square shadow map, 1 to 16384.
    int size_px = 512;
    // The fraction of its colour that a surface in shadow keeps, 0 to 1.
    float ambient = 0.5f;
    // Polygon offset of the shadow map's depths.
    float offset_factor = 0.0f, offset_units = 0.0f;
    // true: four comparisons, weighted; false: one, with the nearest texel.
    bool percentage_closer = true;
    friend bool operator==(const ShadowLight&, const ShadowLight&) = default;
};

// A whole scene. Instances are drawn in their order, and each instance's triangles in the order of its indices.
struct DrawList {
    std::optional<ShadowLight> light{};
    std::vector<Light> lights{};  // that a file brings; at most most_lights
    std::vector<Mesh> meshes;
    std::vector<Material> materials;
    std::vector<Texture> textures;
    std::vector<Instance> instances;  // in submission order
};

// True if it is the name of the instance's mesh or material.
[[nodiscard]] inline bool has_name(const DrawList& list, const Instance& instance, const std::string& name) {
    return name == list.meshes[instance.mesh].name || name == list.materials[instance.material].name;
}

// A camera: both matrices stored by columns, and the path by which positions are transformed
// (pipeline/reference/vertices.md 2).
struct View {
    // World to eye, and eye to clip.
    Matrix view = identity;
    Matrix projection = identity;
    VertexPath vertex_path = VertexPath::separate;
};

}  // namespace strata::pipeline
