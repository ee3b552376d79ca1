// Tests the volume beam against the formulas of scenes/reference/scenes.md 3 in 60 decimal digits.
#include "scenes/procedural/volume_beam.h"

#include <boost/math/constants/constants.hpp>
#include <boost/multiprecision/mpfr.hpp>
#include <catch2/catch.hpp>

namespace {

using namespace strata::scenes;
using Wide = boost::multiprecision::number<boost::multiprecision::mpfr_float_backend<60>>;

const Wide two_pi = 2 * boost::math::constants::pi<Wide>();

// True within the rounding to binary32 of numbers up to 1.
bool close(float value, const Wide& exact) { return abs(Wide{value} - exact) < 6e-8; }

}  // namespace

TEST_CASE("slice i of N is at z = -1 + 2 (i + 1/2) / N with the hue and the alphas of scenes.md 3") {
    for (const int slices : {1, 2, 7, 256}) {
        const auto mesh = make_volume_beam({}, slices, BeamOrder::far).list.meshes[0];
        REQUIRE(mesh.positions.size() == std::size_t(4 * slices));
        int wrong = 0;
        for (int i = 0; i < slices; ++i) {
            const Wide t = (Wide{i} + Wide{0.5}) / slices;
            for (int k = 0; k < 4; ++k) {
                const auto v = std::size_t(4 * i + k);
                const bool corner = mesh.positions[v][0] == (k % 2 == 1 ? 1.0f : -1.0f) &&
                                    mesh.positions[v][1] == (k / 2 == 1 ? 1.0f : -1.0f) &&
                                    close(mesh.positions[v][2], 2 * t - 1);
                bool color = mesh.colors[v][3] == 0.25f * static_cast<float>(1 + (7 * i + 5 * k) % 4);
                for (int c = 0; c < 3; ++c)
                    color = color && close(mesh.colors[v][std::size_t(c)], (1 + cos(two_pi * (t - Wide{c} / 3))) / 2);
                wrong += corner && color && mesh.normals[v] == strata::pipeline::Vec3{0, 0, 1} ? 0 : 1;
            }
            const std::vector<std::uint32_t> expected{0, 1, 3, 0, 3, 2};
            for (std::size_t n = 0; n < 6; ++n)
                wrong += mesh.indices[std::size_t(6 * i) + n] == std::uint32_t(4 * i) + expected[n] ? 0 : 1;
        }
        CHECK(wrong == 0);
    }
}

TEST_CASE("the order near is the reverse of the order far") {
    const auto far = make_volume_beam({}, 5, BeamOrder::far).list.meshes[0];
    const auto near = make_volume_beam({}, 5, BeamOrder::near).list.meshes[0];
    CHECK(far.indices == near.indices);
    for (std::size_t v = 0; v < 20; ++v) {
        const std::size_t mirrored = 4 * (4 - v / 4) + v % 4;
        CHECK(far.positions[v] == near.positions[mirrored]);
        CHECK(far.colors[v] == near.colors[mirrored]);
    }
}

TEST_CASE("the cone has 5000 triangles on 51 circles of 50 segments with the normals of its shell") {
    const auto mesh = make_volume_beam({}, 1, BeamOrder::far).list.meshes[1];
    CHECK(mesh.indices.size() == 3 * 5000);
    REQUIRE(mesh.positions.size() == 51 * 50);
    int wrong = 0;
    for (int j = 0; j <= 50; ++j) {
        const Wide s = Wide{j} / 50, y = Wide{"0.9"} - Wide{"1.8"} * s, radius = Wide{"0.02"} + Wide{"0.83"} * s;
        const Wide slope = Wide{"0.83"} / Wide{"1.8"}, length = sqrt(1 + slope * slope);
        for (int k = 0; k < 50; ++k) {
            const auto v = std::size_t(50 * j + k);
            const Wide c = cos(two_pi * k / 50), d = sin(two_pi * k / 50);
            const auto& p = mesh.positions[v];
            const auto& n = mesh.normals[v];
            const bool right = close(p[0], radius * c) && close(p[1], y) && close(p[2], radius * d) &&
                               close(n[0], c / length) && close(n[1], slope / length) && close(n[2], d / length) &&
                               mesh.colors[v] == strata::pipeline::Rgba{0.9f, 0.8f, 0.3f, 1};
            wrong += right ? 0 : 1;
        }
    }
    CHECK(wrong == 0);
    const std::vector<std::uint32_t> first(mesh.indices.begin(), mesh.indices.begin() + 6);
    CHECK(first == std::vector<std::uint32_t>{0, 1, 51, 0, 51, 50});
    const std::vector<std::uint32_t> seam(mesh.indices.begin() + 49 * 6, mesh.indices.begin() + 50 * 6);
    CHECK(seam == std::vector<std::uint32_t>{49, 0, 50, 49, 50, 99});
}
