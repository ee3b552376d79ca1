// Tests the movements of hard cases: single units against binary32 bits, whose neighbours are the adjacent integers,
// and camera paths against the definition of a rotation.
#include "tools/lab/hard_cases/moves/hard_moves.h"

#include <algorithm>
#include <bit>
#include <catch2/catch.hpp>
#include <cmath>
#include <set>

#include "scenes/procedural/hard_cases/hard_case.h"

namespace {

using namespace strata;

scenes::Scene moves_scene(const char* name) { return make_hard_case({}, *scenes::find_hard_case(name)); }

// Calls body with each coordinate of both scenes.
void for_each_coordinate(const scenes::Scene& a, const scenes::Scene& b, const auto& body) {
    for (std::size_t m = 0; m < 2; ++m)
        for (std::size_t i = 0; i < a.list.meshes[m].positions.size(); ++i)
            for (int axis = 0; axis < 3; ++axis)
                body(a.list.meshes[m].positions[i][axis], b.list.meshes[m].positions[i][axis]);
}

}  // namespace

TEST_CASE("every coordinate moves by one unit or by 2^-20 of its value upwards or downwards") {
    const scenes::Scene scene = moves_scene("planes-8-close");
    int up = 0, down = 0, wrong = 0;
    for_each_coordinate(scene, tools::moved(scene, {tools::MoveSize::unit, 1}), [&](float before, float after) {
        const auto bits = std::bit_cast<std::int32_t>(before), now = std::bit_cast<std::int32_t>(after);
        if (bits != 0 && std::abs(now - bits) != 1) ++wrong;
        ++(after > before ? up : down);
    });
    CHECK(wrong == 0);
    CHECK(up > 30);
    CHECK(down > 30);
    for_each_coordinate(scene, tools::moved(scene, {tools::MoveSize::relative, 1}), [&](float before, float after) {
        const double off = std::fabs(double{after} - before);
        if (std::fabs(off - 0x1p-20 * std::fabs(before)) > 0x1p-24 * std::fabs(before)) ++wrong;
    });
    CHECK(wrong == 0);
}

TEST_CASE(
    "corners of a mesh with equal positions move together and a move of one coordinate leaves all others unchanged") {
    const scenes::Scene scene = moves_scene("rotated-quad");
    // Two triangles share a diagonal: four distinct positions.
    CHECK(tools::coordinate_count(scene) == 12);
    const auto moved_all = tools::moved(scene, {tools::MoveSize::relative, 5});
    const auto& before = scene.list.meshes[0].positions;
    const auto& after = moved_all.list.meshes[0].positions;
    int together = 0;
    for (std::size_t i = 0; i < before.size(); ++i)
        for (std::size_t k = 0; k < i; ++k)
            if (before[i] == before[k]) together += after[i] == after[k] ? 1 : 100;
    CHECK(together == 2);
    for (std::size_t number = 0; number < 12; ++number) {
        std::set<std::pair<float, float>> changed;
        for_each_coordinate(scene, tools::moved(scene, {tools::MoveSize::unit, 0, number}), [&](float was, float is) {
            if (was != is) changed.insert({was, is});
        });
        CHECK(changed.size() == 1);
    }
}

TEST_CASE("a permutation has every triangle once at the index that it reports") {
    const scenes::Scene scene = moves_scene("pinwheel");
    const tools::Permuted other = tools::permuted(scene, 7);
    std::vector<std::uint32_t> sorted = other.from;
    std::sort(sorted.begin(), sorted.end());
    REQUIRE(sorted.size() == 32);
    int wrong = 0;
    for (std::uint32_t i = 0; i < 32; ++i) {
        if (sorted[i] != i) ++wrong;
        for (std::size_t k = 0; k < 3; ++k)
            if (other.scene.list.meshes[0].indices[3 * i + k] !=
                scene.list.meshes[0].indices[3 * std::size_t{other.from[i]} + k])
                ++wrong;
    }
    CHECK(wrong == 0);
    CHECK(other.from != sorted);
}

TEST_CASE("a camera path begins at the view and rotates rigidly in equal steps") {
    const scenes::Scene scene = moves_scene("woven");
    CHECK(tools::view_on_path(scene, 0).view == scene.own_view->view);
    double last = 0;
    for (int frame = 1; frame < tools::path_frames; ++frame) {
        const Matrix m = tools::view_on_path(scene, frame).view;
        for (int a = 0; a < 3; ++a)
            for (int b = 0; b < 3; ++b) {
                double dot = 0;
                for (int r = 0; r < 3; ++r) dot += m[a][r] * m[b][r];
                CHECK(std::fabs(dot - (a == b ? 1 : 0)) < 1e-15);
            }
        CHECK(m[3][0] == frame / 1024.0);
        const double step = std::fabs(m[0][1]) - last;
        CHECK(std::fabs(step - 0x1p-11) < 1e-6);
        last = std::fabs(m[0][1]);
    }
}
