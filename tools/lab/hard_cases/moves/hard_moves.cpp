// tools/lab/hard_cases/moves/hard_moves.cpp - moves vertices by a seed, permutes triangles, and places the camera on a
// path (hard_moves.h).
#include "tools/lab/hard_cases/moves/hard_moves.h"

#include <bit>
#include <cmath>
#include <map>
#include <numeric>

#include "pipeline/vertices/matrix.h"
#include "rasterizer/base/split_mix.h"

namespace strata::tools {

namespace {

std::uint64_t mixed(std::uint64_t state) noexcept { return SplitMix64{state}.next(); }

// Numbers the distinct positions of the mesh; returns the number of each vertex's position.
std::vector<std::size_t> places_of(const pipeline::Mesh& mesh, std::size_t& count) {
    std::map<std::array<std::uint32_t, 3>, std::size_t> known;
    std::vector<std::size_t> places;
    for (const pipeline::Vec3& p : mesh.positions) {
        const std::array key{std::bit_cast<std::uint32_t>(p.x), std::bit_cast<std::uint32_t>(p.y),
                             std::bit_cast<std::uint32_t>(p.z)};
        places.push_back(known.emplace(key, known.size()).first->second);
    }
    count = known.size();
    return places;
}

float moved_value(float value, MoveSize size, bool up) noexcept {
    if (size == MoveSize::unit) return std::nextafterf(value, up ? INFINITY : -INFINITY);
    return static_cast<float>(double{value} * (up ? 1 + 0x1p-20 : 1 - 0x1p-20));
}

// Cosine and sine of the angle whose half has this tangent.
struct Turn {
    double cosine, sine;
    explicit Turn(double t) noexcept : cosine{(1 - t * t) / (1 + t * t)}, sine{2 * t / (1 + t * t)} {}
};

}  // namespace

std::string_view name_of(MoveSize size) noexcept { return size == MoveSize::unit ? "unit" : "relative"; }
double share_of(MoveSize size) noexcept { return size == MoveSize::unit ? 0x1p-23 : 0x1p-20; }

std::size_t coordinate_count(const scenes::Scene& scene) {
    std::size_t all = 0;
    for (const pipeline::Mesh& mesh : scene.list.meshes) {
        std::size_t places = 0;
        static_cast<void>(places_of(mesh, places));
        all += 3 * places;
    }
    return all;
}

scenes::Scene moved(const scenes::Scene& scene, const Move& move) {
    scenes::Scene result = scene;
    std::size_t before = 0;
    for (pipeline::Mesh& mesh : result.list.meshes) {
        std::size_t count = 0;
        const std::vector<std::size_t> places = places_of(mesh, count);
        for (std::size_t i = 0; i < places.size(); ++i)
            for (int axis = 0; axis < 3; ++axis) {
                const std::size_t number = before + 3 * places[i] + static_cast<std::size_t>(axis);
                if (move.alone && *move.alone != number) continue;
                const bool up = (mixed(mixed(move.seed) ^ number) & 1) != 0;
                mesh.positions[i][axis] = moved_value(mesh.positions[i][axis], move.size, up);
            }
        before += 3 * count;
    }
    return result;
}

// A Fisher-Yates shuffle.
Permuted permuted(const scenes::Scene& scene, std::uint64_t seed) {
    Permuted result{scene, std::vector<std::uint32_t>(scene.list.meshes[0].indices.size() / 3)};
    std::iota(result.from.begin(), result.from.end(), 0U);
    for (std::size_t left = result.from.size(); left > 1; --left)
        std::swap(result.from[left - 1], result.from[mixed(seed ^ mixed(left)) % left]);
    const auto& old = scene.list.meshes[0].indices;
    for (std::size_t i = 0; i < result.from.size(); ++i)
        for (std::size_t k = 0; k < 3; ++k)
            result.scene.list.meshes[0].indices[3 * i + k] = old[3 * std::size_t{result.from[i]} + k];
    return result;
}

pipeline::View view_on_path(const scenes::Scene& scene, int frame) {
    const double way = frame / double{path_frames};
    const Turn roll{way * 0x1p-6}, aside{way * 0x1p-7};
    // In column-major order: first the rotation about the axis, then sideways, then the shift.
    Matrix about = identity, turned = identity;
    about[0][0] = about[1][1] = roll.cosine;
    about[0][1] = roll.sine;
    about[1][0] = -roll.sine;
    turned[0][0] = turned[2][2] = aside.cosine;
    turned[0][2] = -aside.sine;
    turned[2][0] = aside.sine;
    turned[3][0] = way / 16;
    pipeline::View view = *scene.own_view;
    view.view = pipeline::product(pipeline::product(turned, about), view.view);
    return view;
}

}  // namespace strata::tools
