// Tests the bounding box of a draw list on small lists whose corners are worked out by hand, and the order of summation
// on values for which it matters.
#include "scenes/bounds.h"

#include <catch2/catch.hpp>
#include <limits>

namespace {

using namespace strata::scenes;
using strata::pipeline::DrawList;
using strata::pipeline::Matrix;
using strata::pipeline::Vec3;
using Corner3 = strata::Vec3d;

// One mesh of these positions, all of them drawn, with an instance for each matrix.
DrawList list_of(const std::vector<Vec3>& positions, const std::vector<Matrix>& models) {
    DrawList list;
    list.meshes.emplace_back().positions = positions;
    for (std::uint32_t i = 0; i < positions.size(); ++i) list.meshes[0].indices.push_back(i);
    for (const Matrix& model : models) list.instances.push_back({.mesh = 0, .material = 0, .model = model});
    return list;
}

constexpr Matrix identity = strata::pipeline::identity;

}  // namespace

TEST_CASE("the box of a list contains every drawn vertex of every instance and is tight") {
    Matrix moved = identity, turned{0, 2, 0, 0, -3, 0, 0, 0, 0, 0, 4, 0, 10, 20, 30, 1};  // x to 2y, y to -3x, z to 4z
    moved[3][0] = -7;
    const Bounds one = bounds_of(list_of({{1, 2, 3}, {-4, 5, -6}, {0, 0, 0}}, {identity}));
    CHECK(one.lo == Corner3{-4, 0, -6});
    CHECK(one.hi == Corner3{1, 5, 3});
    const Bounds both = bounds_of(list_of({{1, 2, 3}, {-4, 5, -6}}, {moved, turned}));
    CHECK(both.lo == Corner3{-11, 2, -6});
    CHECK(both.hi == Corner3{4, 22, 42});
}

TEST_CASE("vertices without an index and meshes without an instance do not count") {
    DrawList list = list_of({{1, 1, 1}, {9, 9, 9}}, {identity});
    list.meshes[0].indices = {0, 0, 0};
    list.meshes.emplace_back().positions = {{-50, 0, 0}};
    list.meshes[1].indices = {0, 0, 0};
    const Bounds bounds = bounds_of(list);
    CHECK(bounds.lo == Corner3{1, 1, 1});
    CHECK(bounds.hi == Corner3{1, 1, 1});
    CHECK_FALSE(bounds.is_empty());
}

TEST_CASE("an empty list has an empty box") {
    CHECK(bounds_of({}).is_empty());
    CHECK(bounds_of(list_of({}, {identity})).is_empty());
    CHECK(bounds_of(list_of({{1, 2, 3}}, {})).is_empty());
}

TEST_CASE("a vertex with an infinite or NaN coordinate does not count") {
    const float nan = std::numeric_limits<float>::quiet_NaN(), infinity = std::numeric_limits<float>::infinity();
    for (const float bad : {nan, infinity, -infinity})
        for (std::size_t i = 0; i < 3; ++i) {
            Vec3 broken{7, 7, 7};
            broken[static_cast<int>(i)] = bad;
            for (const bool comes_first : {false, true}) {
                const std::vector<Vec3> corners =
                    comes_first ? std::vector<Vec3>{broken, {1, 2, 3}} : std::vector<Vec3>{{1, 2, 3}, broken};
                const Bounds bounds = bounds_of(list_of(corners, {identity}));
                CHECK(bounds.lo == Corner3{1, 2, 3});
                CHECK(bounds.hi == Corner3{1, 2, 3});
            }
        }
    CHECK(bounds_of(list_of({{nan, 0, 0}}, {identity})).is_empty());
}

TEST_CASE("a vertex that its instance moves beyond binary64 along any axis does not count") {
    for (int axis = 0; axis < 3; ++axis) {
        Matrix huge = identity;
        huge[axis][axis] = 1e308;
        const Bounds bounds = bounds_of(list_of({{3, 3, 3}, {0, 0, 0}}, {huge}));
        CHECK(bounds.lo == Corner3{0, 0, 0});
        CHECK(bounds.hi == Corner3{0, 0, 0});
    }
}

TEST_CASE("a vertex is transformed in binary64 and summed from the first column to the translation") {
    // ((2^53 + 1) - 2^53) + 1/2 is 1/2, because the first sum is rounded; 2^53 + (1 - 2^53) would give 1, and the
    // others 0.
    Matrix m = identity;
    for (int r = 0; r < 3; ++r) {
        m[0][r] = 0x1p53;
        m[1][r] = 1;
        m[2][r] = -0x1p53;
        m[3][r] = 0.5;
    }
    const Bounds bounds = bounds_of(list_of({{1, 1, 1}}, {m}));
    CHECK(bounds.lo == Corner3{0.5, 0.5, 0.5});
    CHECK(bounds.hi == Corner3{0.5, 0.5, 0.5});
    Matrix small = identity;
    small[3][0] = 1e-300;
    CHECK(bounds_of(list_of({{0, 0, 0}}, {small})).hi[0] == 1e-300);  // too small for binary32
}
