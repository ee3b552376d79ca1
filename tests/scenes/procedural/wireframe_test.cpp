// Tests the lines of the wireframe against the cells of the teapot's patches, counted by hand.
#include "scenes/procedural/wireframe.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <set>

#include "scenes/procedural/teapot.h"

using namespace strata::scenes;
using strata::pipeline::Mesh;

namespace {

using WireEnd = std::array<float, 3>;
WireEnd wire_end(const strata::pipeline::Vec3& p) { return {p[0], p[1], p[2]}; }

}  // namespace

TEST_CASE("the wireframe has each side of the cells once, beside the glass of the teapot") {
    for (const int n : {1, 4}) {
        const Scene scene = make_wireframe({}, n), teapot = make_teapot({}, n);
        REQUIRE(scene.list.meshes.size() == 3);
        CHECK(scene.list.meshes[0] == teapot.list.meshes[0]);
        const Mesh& wires = scene.list.meshes[2];
        CHECK(wires.primitive == strata::pipeline::Primitive::lines);
        // Row by row of every patch: the sides between neighbours in a row and between rows, by their ends on the pot.
        std::set<std::set<WireEnd>> sides;
        const auto row = static_cast<std::size_t>(n) + 1;
        const auto& pot = teapot.list.meshes[0].positions;
        for (std::size_t patch = 0; patch < 32; ++patch)
            for (std::size_t i = 0; i < row; ++i)
                for (std::size_t j = 0; j < row; ++j)
                    for (const auto& [u, v] : {std::pair{i + 1, j}, {i, j + 1}}) {
                        if (u == row || v == row) continue;
                        const std::set<WireEnd> ends{wire_end(pot[patch * row * row + i * row + j]),
                                                     wire_end(pot[patch * row * row + u * row + v])};
                        if (ends.size() == 2) sides.insert(ends);
                    }
        std::set<std::set<WireEnd>> drawn;
        for (std::size_t i = 0; i < wires.indices.size(); i += 3) {
            CHECK(wires.indices[i] == wires.indices[i + 1]);
            drawn.insert({wire_end(pot[wires.indices[i]]), wire_end(pot[wires.indices[i + 2]])});
        }
        CHECK(drawn == sides);
        CHECK(wires.indices.size() == 3 * sides.size());
        for (std::size_t v = 0; v < pot.size(); ++v) {
            double squared = 0;
            for (int axis = 0; axis < 3; ++axis)
                squared += std::pow(double{wires.positions[v][axis]} - double{pot[v][axis]}, 2.0);
            REQUIRE(std::sqrt(squared) == Approx(1.0 / 64).epsilon(1e-3));
        }
    }
}
