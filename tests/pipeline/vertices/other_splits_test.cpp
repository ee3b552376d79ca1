// Tests other orders and diagonals of triangles on grids of quads whose expected result is known.
#include "pipeline/vertices/other_splits.h"

#include <catch2/catch.hpp>
#include <map>

#include "pipeline/vertices/prepare.h"
#include "rasterizer/walk/tile_rasterizer.h"
#include "tests/support/random_triangles.h"

namespace {

using namespace strata::testing;
using namespace strata::pipeline;
using strata::rasterizer::FragmentBatch;

// A grid of flat quads in the plane z = 0.25 x + 0.5 y, split from lower left to upper right.
[[nodiscard]] DrawList flat_grid(int side) {
    Mesh mesh;
    for (int y = 0; y <= side; ++y)
        for (int x = 0; x <= side; ++x) {
            const float u = 2.0f * static_cast<float>(x) / static_cast<float>(side) - 1.0f;
            const float v = 2.0f * static_cast<float>(y) / static_cast<float>(side) - 1.0f;
            mesh.positions.push_back({u, v, 0.25f * u + 0.5f * v});
        }
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            const auto a = static_cast<std::uint32_t>(y * (side + 1) + x), b = a + 1;
            const std::uint32_t d = a + static_cast<std::uint32_t>(side) + 1, c = d + 1;
            mesh.indices.insert(mesh.indices.end(), {a, b, c, a, c, d});
        }
    DrawList list;
    list.materials = {{.name = "plane", .alpha_mode = AlphaMode::blend, .double_sided = true, .unlit = true}};
    list.meshes = {mesh};
    list.instances = {{.mesh = 0, .material = 0}};
    return list;
}

struct Depths {
    std::map<std::array<int, 2>, std::uint32_t> code;
    bool once = true;  // no pixel is drawn twice
};

// Codes by pixel, relative to the viewport's corner.
[[nodiscard]] Depths codes(const DrawList& list, strata::rasterizer::DepthPath path, const char* profile,
                           int shift = 0) {
    strata::rasterizer::RasterState state;
    state.viewport = {0, 0, 32, 32};
    state.depth_format = DepthFormat::d24;
    PreparedDraw prepared = prepare(list, {}, state, *find_profile(profile), {.tile_size = 32});
    move_window(prepared.geometry, shift, shift);
    Depths depths;
    auto sink = [&](FragmentBatch& batch) {
        for (std::size_t i = 0; i < static_cast<std::size_t>(batch.count); ++i)
            depths.once &= depths.code.insert({{batch.x[i] - shift, batch.y[i] - shift}, batch.code[i]}).second;
    };
    strata::rasterizer::TileRasterizer rasterizer{prepared.geometry.state.viewport};
    rasterizer.draw(prepared.geometry, prepared.geometry.all_triangles, {path, DepthFormat::d24}, {.color = false},
                    strata::rasterizer::BatchSink{sink});
    return depths;
}

[[nodiscard]] std::size_t unlike(const Depths& a, const Depths& b) {
    std::size_t count = 0;
    for (const auto& [pixel, code] : a.code) count += b.code.at(pixel) != code ? 1 : 0;
    return count;
}

}  // namespace

TEST_CASE("lines and points have no other order and no diagonal") {
    DrawList list = flat_grid(2);
    list.meshes[0].indices = {0, 0, 1, 1, 1, 4};
    list.meshes[0].primitive = Primitive::lines;
    CHECK(rotate_vertices(list, 1).meshes == list.meshes);
    CHECK(flip_diagonals(list).list.meshes == list.meshes);
    CHECK(flip_diagonals(list).quads == 0);
}

TEST_CASE("rotating starts each triangle at another corner and changes nothing else") {
    const DrawList list = random_triangles(951, 10).list;
    for (const int k : {-1, 0, 1, 2, 3, 4}) {
        const DrawList other = rotate_vertices(list, k);
        for (std::size_t m = 0; m < list.meshes.size(); ++m) {
            CHECK(other.meshes[m].positions == list.meshes[m].positions);
            for (std::size_t i = 0; i < list.meshes[m].indices.size(); ++i) {
                const std::size_t corner = (i % 3 + static_cast<std::size_t>(k + 3)) % 3;
                CHECK(other.meshes[m].indices[i] == list.meshes[m].indices[i - i % 3 + corner]);
            }
        }
    }
}

// A quad of sides 1000, 499, 1 and 500 whose last corner is 7e-4 off the plane: 2^-20 of the first side is 9.5e-4, of
// any other less than 4.8e-4.
TEST_CASE("the permitted distance of a corner from the plane depends on the longest of all four sides") {
    DrawList list = flat_grid(1);
    list.meshes[0].positions = {{0, 0, 0}, {1000, 0, 0}, {501, 1, 0}, {500, 1, 7e-4f}};
    list.meshes[0].indices = {0, 1, 2, 0, 2, 3};
    CHECK(flip_diagonals(list).quads == 1);
    list.meshes[0].positions[3][2] = 10e-4f;
    CHECK(flip_diagonals(list).quads == 0);
}

TEST_CASE("flat quads are split along their other diagonal and bent ones and single triangles are unchanged") {
    const Flipped flipped = flip_diagonals(flat_grid(4));
    CHECK(flipped.quads == 16);
    CHECK(std::vector(flipped.list.meshes[0].indices.begin(), flipped.list.meshes[0].indices.begin() + 6) ==
          std::vector<std::uint32_t>{1, 6, 5, 5, 0, 1});
    CHECK(flip_diagonals(flipped.list).quads == 16);
    DrawList bent = flat_grid(1);
    bent.meshes[0].positions[3][2] += 0x1p-10f;
    CHECK(flip_diagonals(bent).quads == 0);
    DrawList arrow = flat_grid(1);  // not convex: its other diagonal is outside
    arrow.meshes[0].positions[1] = {-0.25f, 0.25f, 0.0625f};
    CHECK(flip_diagonals(arrow).quads == 0);
    CHECK(flip_diagonals(random_triangles(952, 10).list).quads == 0);
    DrawList touching = flat_grid(2);  // two triangles with one corner in common
    touching.meshes[0].indices = {4, 0, 2, 8, 6, 0};
    CHECK(flip_diagonals(touching).quads == 0);
}

TEST_CASE("no exact depth depends on order or diagonal or position but the chip's own depths do") {
    using strata::rasterizer::DepthPath;
    const DrawList list = flat_grid(5);
    const DrawList rotated = rotate_vertices(list, 1), flipped = flip_diagonals(list).list;
    const Depths before = codes(list, DepthPath::exact, "geforce3");
    REQUIRE(before.code.size() == 32 * 32);
    CHECK(unlike(before, codes(rotated, DepthPath::exact, "geforce3")) == 0);
    CHECK(unlike(before, codes(list, DepthPath::exact, "geforce3", 1000)) == 0);
    const Depths chip = codes(list, DepthPath::window_z, "geforce3");
    CHECK(unlike(chip, codes(list, DepthPath::window_z, "geforce3", 1000)) == 0);
    CHECK(unlike(chip, codes(rotated, DepthPath::window_z, "geforce3")) > 0);
    const Depths other = codes(flipped, DepthPath::window_z, "geforce3");
    CHECK(other.once);
    CHECK(other.code.size() == 32 * 32);
    CHECK(unlike(chip, other) > 0);
}
