// Tests the random soup against its rule, and its first triangles against a separate program.
#include "scenes/procedural/random_soup.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <set>

namespace {

using namespace strata::scenes;
using strata::pipeline::Mesh;

Mesh soup(std::uint64_t seed, std::uint32_t triangles) { return make_random_soup({}, seed, triangles).list.meshes[0]; }

}  // namespace

TEST_CASE("a soup has the requested number of triangles in the unit cube on a grid with alpha above 0 and up to 1") {
    for (const std::uint32_t count : {0u, 1u, 5000u}) {
        const Mesh mesh = soup(7, count);
        CHECK(mesh.indices.size() == 3 * count);
        int wrong = 0;
        for (const auto& p : mesh.positions)
            for (const float x : strata::components(p))
                wrong += x >= -1 && x <= 1 && x * 8192 == std::floor(x * 8192) ? 0 : 1;
        for (const auto& c : mesh.colors)
            wrong += c[0] >= 0 && c[0] < 1 && c[1] >= 0 && c[1] < 1 && c[2] >= 0 && c[2] < 1 && c[3] > 0 && c[3] <= 1
                         ? 0
                         : 1;
        CHECK(wrong == 0);
    }
}

TEST_CASE("a longer soup of the same seed begins with the shorter one and another seed gives another soup") {
    const Mesh a = soup(3, 100), b = soup(3, 1000), c = soup(4, 100);
    CHECK(std::equal(a.positions.begin(), a.positions.end(), b.positions.begin()));
    CHECK(std::equal(a.colors.begin(), a.colors.end(), b.colors.begin()));
    CHECK(a.positions != c.positions);
}

TEST_CASE("a soup has these triangles on every machine") {
    const Mesh mesh = soup(1, 2);
    // From a separate 40-line program in another language, written from the rule; its splitmix64 begins
    // 0x910a2dec89025cc1 for seed 1.
    constexpr int corners[6][3] = {{7740, 4384, 3760},   {6468, 3568, 2884},   {6202, 5890, 3018},
                                   {-7468, 5820, -5334}, {-7232, 5956, -5246}, {-7492, 6618, -5918}};
    for (std::size_t v = 0; v < 6; ++v)
        for (std::size_t i = 0; i < 3; ++i) CHECK(mesh.positions[v][i] * 8192 == static_cast<float>(corners[v][i]));
    CHECK(mesh.colors[0] == strata::pipeline::Rgba{0x1.56167p-3f, 0x1.4a694cp-1f, 0x1.a175ap-1f, 0x1.c4c632p-1f});
    CHECK(mesh.colors[5] == strata::pipeline::Rgba{0x1.0f3c5cp-1f, 0x1.165c04p-1f, 0x1.7f18b2p-1f, 1});
}

TEST_CASE("about one triangle in eight repeats another exactly in both facings and others share planes") {
    const Mesh mesh = soup(11, 16000);
    using Point = std::array<float, 3>;
    const auto point = [](const strata::Vec3& p) { return Point{p.x, p.y, p.z}; };
    std::map<std::set<Point>, int> seen;
    int repeated = 0, flat = 0;
    for (std::size_t t = 0; t < mesh.positions.size(); t += 3) {
        const auto* p = &mesh.positions[t];
        repeated += seen[{point(p[0]), point(p[1]), point(p[2])}]++ > 0 ? 1 : 0;
        flat += p[0][2] == p[1][2] && p[1][2] == p[2][2] ? 1 : 0;
    }
    CHECK((repeated > 1600 && repeated < 2400));  // 2 in 16
    CHECK((flat > 800 && flat < 2400));           // 1 in 16, and those that repeat them
}
