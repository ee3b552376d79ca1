// scenes/procedural/random_soup.cpp - triangles on an integer grid, from one sequence of random numbers.
#include "scenes/procedural/random_soup.h"

#include <algorithm>

#include "rasterizer/base/numerics.h"
#include "rasterizer/base/split_mix.h"
#include "scenes/bounds.h"
#include "scenes/numbers/srgb_encode.h"

namespace strata::scenes {
namespace {

// Coordinates are integers until the end: each is k / 8192 with |k| <= 8192 and thus exact in binary32, so equal
// corners and points on a plane tie exactly.
constexpr int one = 8192;  // grid steps per unit
using Corner = std::array<int, 3>;
using Triangle = std::array<Corner, 3>;

// Even coordinates, so that a midpoint of two corners is on the grid.
int even_in_range(int x) noexcept { return std::clamp(x, -one / 2, one / 2) * 2; }

// The corners are in a box around the center whose half side is one of seven powers of two, 1 down to 1/64 in units of
// the scene, so that a soup has large triangles and small ones.
Triangle new_triangle(SplitMix64& random) noexcept {
    const int half_side = (one / 2) >> random.below(7);
    Corner center{};
    for (int& x : center) x = random.below(one + 1) - one / 2;
    Triangle triangle{};
    for (Corner& corner : triangle) {
        for (std::size_t i = 0; i < 3; ++i) {
            const int offset = random.below(2 * static_cast<std::uint64_t>(half_side) + 1) - half_side;
            corner[i] = even_in_range(center[i] + offset);
        }
    }
    return triangle;
}

// All corners at one z. There are few such z, so flat triangles that overlap often share their plane.
Triangle flattened(Triangle triangle, int z) noexcept {
    for (Corner& corner : triangle) corner[2] = z;
    return triangle;
}

// The triangle at the first corner with sides of half the length.
Triangle nested(const Triangle& outer) noexcept {
    Triangle inner = outer;
    for (std::size_t i = 0; i < 3; ++i) {
        inner[1][i] = (outer[0][i] + outer[1][i]) / 2;
        inner[2][i] = (outer[0][i] + outer[2][i]) / 2;
    }
    return inner;
}

// `last` is the last new triangle; the first triangle is always new. Of 16 triangles, on average, one repeats the last
// new one, one repeats it with the opposite winding, one is inside it and one is flat at one of 17 depths: the ties
// that peeling has to handle.
Triangle next_triangle(SplitMix64& random, Triangle& last, bool first) noexcept {
    const int kind = random.below(16);
    if (!first) {
        if (kind == 0) return last;
        if (kind == 1) return {last[0], last[2], last[1]};
        if (kind == 2) return nested(last);
    }
    last = new_triangle(random);
    if (kind == 3) last = flattened(last, (random.below(17) - 8) * (one / 8));
    return last;
}

// One triangle in eight is opaque. Alpha is never 0: a step of 2^-24 is added. All random numbers are generated before
// the choice, so that each colour consumes the same number of them.
pipeline::Rgba next_color(SplitMix64& random) noexcept {
    pipeline::Rgba color{};
    for (std::size_t i = 0; i < 3; ++i) color[i] = random.unit();
    const bool is_opaque = random.below(8) == 0;
    const float alpha = random.unit() + 0x1p-24f;  // exact
    color[3] = is_opaque ? 1.0f : alpha;
    return color;
}

}  // namespace

Scene make_random_soup(const SceneOptions& options, std::uint64_t seed, std::uint32_t triangles) {
    SplitMix64 random{seed};
    pipeline::Mesh mesh;
    mesh.name = "soup";
    mesh.positions.reserve(std::size_t{3} * triangles);
    mesh.colors.reserve(std::size_t{3} * triangles);
    mesh.indices.reserve(std::size_t{3} * triangles);
    Triangle last{};
    for (std::uint32_t i = 0; i < triangles; ++i) {
        // One triangle in four has a colour at each corner and is interpolated; the others repeat one.
        const bool color_per_corner = random.below(4) == 0;
        pipeline::Rgba color{};
        const Triangle triangle = next_triangle(random, last, i == 0);
        for (std::uint32_t k = 0; k < 3; ++k) {
            const auto& [x, y, z] = triangle[k];
            if (k == 0 || color_per_corner) color = from_encoded(next_color(random), options.color_space);
            mesh.positions.push_back(
                {static_cast<float>(x) / one, static_cast<float>(y) / one, static_cast<float>(z) / one});
            mesh.colors.push_back(color);
            mesh.indices.push_back(3 * i + k);
        }
    }
    Scene scene;
    scene.name = "random";
    scene.list.meshes.push_back(std::move(mesh));
    scene.list.materials.push_back(
        {.name = "soup", .alpha_mode = pipeline::AlphaMode::blend, .double_sided = true, .unlit = true});
    scene.list.instances = {{.mesh = 0, .material = 0}};
    scene.bounds = bounds_of(scene.list);
    return scene;
}

}  // namespace strata::scenes
