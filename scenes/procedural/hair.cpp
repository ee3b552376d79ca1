// scenes/procedural/hair.cpp - grows the strands and builds the head (hair.h).
#include "scenes/procedural/hair.h"

#include <array>
#include <cmath>

#include "rasterizer/base/split_mix.h"
#include "rasterizer/rules/primitive.h"
#include "scenes/bounds.h"
#include "scenes/numbers/srgb_encode.h"

namespace strata::scenes {
namespace {

using Point = std::array<double, 3>;

constexpr double scalp_end = -0.25, strand_length = 1.25, gravity = 0.9, chance = 0.35;
constexpr float root_alpha = 0.75f, tip_alpha = 0.15f;
constexpr int head_cells = 12;  // along a side of each of six faces
constexpr Rgba head_color{0.55f, 0.38f, 0.3f, 1};

Point of_length_one(const Point& p) {
    const double length = std::sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
    return {p[0] / length, p[1] / length, p[2] / length};
}
pipeline::Vec3 to_vec3(const Point& p) {
    return {static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2])};
}
double between_minus_one_and_one(SplitMix64& random) { return 2.0 * double{random.unit()} - 1.0; }
Point in_cube(SplitMix64& random) {
    const double x = between_minus_one_and_one(random), y = between_minus_one_and_one(random);
    return {x, y, between_minus_one_and_one(random)};
}

// Points of the ball have directions without a preference.
Point root_of(SplitMix64& random) {
    while (true) {
        const Point p = in_cube(random);
        const double squared = p[0] * p[0] + p[1] * p[1] + p[2] * p[2];
        if (squared > 0.01 && squared < 1.0)
            if (const Point on_sphere = of_length_one(p); on_sphere[1] > scalp_end) return on_sphere;
    }
}

void grow_strand(pipeline::Mesh& mesh, SplitMix64& random, int segments, pipeline::ColorSpace space) {
    const float shade = 0.5f + 0.5f * random.unit();
    Point at = root_of(random), along = at;
    const double step = strand_length / segments;
    for (int k = 0; k <= segments; ++k) {
        const auto vertex = static_cast<std::uint32_t>(mesh.positions.size());
        if (k > 0) rasterizer::append_primitive(mesh.indices, std::array{vertex - 1, vertex});
        const float t = static_cast<float>(k) / static_cast<float>(segments);
        mesh.positions.push_back(to_vec3(at));
        mesh.colors.push_back(from_encoded({shade * (0.35f + 0.4f * t), shade * (0.2f + 0.3f * t), shade * 0.12f,
                                            root_alpha + (tip_alpha - root_alpha) * t},
                                           space));
        const Point turn = in_cube(random);
        for (std::size_t i = 0; i < 3; ++i) {
            at[i] += step * along[i];
            along[i] += step * (chance * turn[i] - (i == 1 ? gravity : 0.0));
        }
        along = of_length_one(along);
    }
}

// A cube's grid of cells, moved onto the unit sphere.
pipeline::Mesh make_head() {
    pipeline::Mesh head;
    head.name = "head";
    constexpr auto row = static_cast<std::uint32_t>(head_cells) + 1;
    for (std::uint32_t face = 0; face < 6; ++face) {
        const std::size_t axis = face % 3;
        const double side = face < 3 ? 1 : -1;
        const auto first = static_cast<std::uint32_t>(head.positions.size());
        for (std::uint32_t v = 0; v < row; ++v)
            for (std::uint32_t u = 0; u < row; ++u) {
                Point p{};
                p[axis] = side;
                p[(axis + 1) % 3] = (2.0 * u / head_cells - 1.0) * side;
                p[(axis + 2) % 3] = 2.0 * v / head_cells - 1.0;
                head.positions.push_back(to_vec3(of_length_one(p)));
                head.normals.push_back(head.positions.back());
                if (u == row - 1 || v == row - 1) continue;
                const std::uint32_t i = first + v * row + u;
                head.indices.insert(head.indices.end(), {i, i + 1, i + row, i + row, i + 1, i + row + 1});
            }
    }
    return head;
}

}  // namespace

Scene make_hair(const SceneOptions& options, const Hair& hair) {
    Scene scene;
    scene.name = "hair";
    pipeline::DrawList& list = scene.list;
    const Rgba skin = from_encoded(head_color, options.color_space);
    list.materials.push_back({.name = "head", .front = skin, .back = skin, .unlit = !options.light});
    list.materials.push_back(
        {.name = "hair", .alpha_mode = pipeline::AlphaMode::blend, .double_sided = true, .unlit = true});
    list.meshes.push_back(make_head());
    pipeline::Mesh strands;
    strands.name = "strands";
    strands.primitive = pipeline::Primitive::lines;
    SplitMix64 random{hair.seed};
    for (int i = 0; i < hair.strands; ++i) grow_strand(strands, random, hair.segments, options.color_space);
    list.meshes.push_back(std::move(strands));
    list.instances = {{.mesh = 0, .material = 0}, {.mesh = 1, .material = 1}};
    scene.bounds = bounds_of(list);
    return scene;
}

}  // namespace strata::scenes
