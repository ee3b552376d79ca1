// Tests the kinds of triangles in a random soup against the rule of random_soup.h, which relates each triangle to the
// one before it. The kinds are recognised from the soup alone.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>

#include "scenes/procedural/random_soup.h"

namespace {

using namespace strata::scenes;
using strata::pipeline::Mesh;
using Grid = std::array<int, 3>;  // in units of 1/8192
using Corners = std::array<Grid, 3>;

Corners corners_of(const Mesh& mesh, std::size_t triangle) {
    Corners corners{};
    for (std::size_t k = 0; k < 3; ++k)
        for (std::size_t i = 0; i < 3; ++i)
            corners[k][i] = static_cast<int>(std::lround(mesh.positions[3 * triangle + k][i] * 8192));
    return corners;
}

// True if the midpoint of two corners is on the grid.
Corners halved(const Corners& t) {
    Corners half = t;
    for (const std::size_t k : {std::size_t{1}, std::size_t{2}})
        for (std::size_t i = 0; i < 3; ++i) half[k][i] = t[0][i] + (t[k][i] - t[0][i]) / 2;
    return half;
}

int longest_side(const Corners& t) {
    int longest = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const auto [low, high] = std::minmax({t[0][i], t[1][i], t[2][i]});
        longest = std::max(longest, high - low);
    }
    return longest;
}

struct Kinds {
    int repeated = 0, turned = 0, halved = 0, flat = 0, fresh = 0, odd = 0, far_off = 0;
    std::map<int, int> sizes;   // sizes of new triangles: 0 for sides up to 1/32 of the cube's, 6 for up to all of it
    std::map<int, int> planes;  // planes of flat triangles, in eighths
};

Kinds kinds_of(const Mesh& mesh) {
    Kinds kinds;
    Corners last{};
    for (std::size_t t = 0; 3 * t < mesh.positions.size(); ++t) {
        const Corners now = corners_of(mesh, t);
        if (t > 0 && now == last) {
            ++kinds.repeated;
        } else if (t > 0 && now == Corners{last[0], last[2], last[1]}) {
            ++kinds.turned;
        } else if (t > 0 && now == halved(last)) {
            ++kinds.halved;
        } else {
            last = now;
            const bool is_flat = now[0][2] == now[1][2] && now[1][2] == now[2][2];
            const int side = longest_side(now);
            ++(is_flat ? kinds.flat : kinds.fresh);
            if (is_flat && now[0][2] % 1024 == 0) ++kinds.planes[now[0][2] / 1024];
            for (const Grid& corner : now)
                for (const int x : corner) {
                    kinds.odd += x % 2 != 0 ? 1 : 0;
                    kinds.far_off += std::abs(x) > 8192 ? 1 : 0;
                }
            ++kinds.sizes[std::max(0, static_cast<int>(std::ceil(std::log2(std::max(side, 1) / 16384.0))) + 6)];
        }
    }
    return kinds;
}

constexpr int soup_size = 32000;
const Mesh& large_soup() {
    static const Mesh mesh = make_random_soup({}, 2024, soup_size).list.meshes.at(0);
    return mesh;
}

bool is_share(int count, int of, double share) {  // within five standard deviations
    return std::fabs(count - of * share) < 5 * std::sqrt(of * share * (1 - share));
}

}  // namespace

TEST_CASE("one sixteenth each of a soup repeats the last new triangle or reverses it or halves it") {
    const Kinds kinds = kinds_of(large_soup());
    CHECK(is_share(kinds.repeated, soup_size, 1 / 16.0));
    CHECK(is_share(kinds.turned, soup_size, 1 / 16.0));
    CHECK(is_share(kinds.halved, soup_size, 1 / 16.0));
    CHECK(is_share(kinds.flat + kinds.fresh, soup_size, 13 / 16.0));
}

TEST_CASE("new triangles have even coordinates in the cube and occur in all seven sizes") {
    const Kinds kinds = kinds_of(large_soup());
    CHECK(kinds.odd == 0);
    CHECK(kinds.far_off == 0);
    REQUIRE(kinds.sizes.size() == 7);
    CHECK(kinds.sizes.begin()->first == 0);
    CHECK(kinds.sizes.rbegin()->first == 6);
    for (const auto& [size, count] : kinds.sizes) CHECK(count > soup_size / 40);
}

TEST_CASE("one sixteenth of a soup is flat at a multiple of 1/8 and each of the 17 is equally frequent") {
    const Kinds kinds = kinds_of(large_soup());
    REQUIRE(kinds.planes.size() == 17);
    CHECK(kinds.planes.begin()->first == -8);
    CHECK(kinds.planes.rbegin()->first == 8);
    for (const auto& [plane, count] : kinds.planes) {
        INFO("plane " << plane);
        if (std::abs(plane) < 8)
            CHECK(is_share(count, soup_size, 1 / (16.0 * 17)));
        else  // the cube's sides also flatten triangles that would extend beyond them
            CHECK(count > soup_size / (16 * 17));
    }
}

TEST_CASE("a quarter of the triangles have three colours and one colour in eight is opaque") {
    const Mesh& mesh = large_soup();
    int one_color = 0, three_colors = 0, opaque = 0, chosen = 0;
    float least = 2;
    for (std::size_t v = 0; v < mesh.colors.size(); v += 3) {
        const auto* c = &mesh.colors[v];
        const bool is_one = c[0] == c[1] && c[1] == c[2];
        ++(is_one ? one_color : three_colors);
        for (int k = 0; k < (is_one ? 1 : 3); ++k) {
            ++chosen;
            opaque += c[k][3] == 1 ? 1 : 0;
            least = std::min(least, c[k][3]);
        }
    }
    CHECK(one_color + three_colors == soup_size);
    CHECK(is_share(three_colors, soup_size, 0.25));
    CHECK(is_share(opaque, chosen, 0.125));
    CHECK((least > 0 && least < 0.001f));
}

TEST_CASE("the first triangle of a soup is new for any seed and seeds have nothing in common") {
    int without_area = 0;
    std::map<Corners, int> first;
    for (std::uint64_t seed = 0; seed < 500; ++seed) {
        const Corners corners = corners_of(make_random_soup({}, seed, 1).list.meshes.at(0), 0);
        without_area += corners[0] == corners[1] && corners[1] == corners[2] ? 1 : 0;
        ++first[corners];
    }
    CHECK(without_area == 0);
    CHECK(first.size() == 500);
}

TEST_CASE("a soup blends unlit on both sides and its vertices are numbered in order") {
    const Scene scene = make_random_soup({}, 5, 7);
    const Mesh& mesh = scene.list.meshes.at(0);
    REQUIRE(mesh.indices.size() == 21);
    for (std::uint32_t v = 0; v < 21; ++v) CHECK(mesh.indices[v] == v);
    const auto& material = scene.list.materials.at(0);
    CHECK((material.unlit && material.double_sided));
    CHECK(material.alpha_mode == strata::pipeline::AlphaMode::blend);
    CHECK(make_random_soup({.light = false}, 5, 7).list.materials == scene.list.materials);
}
