// Tests which primitives polygon modes make of a list's triangles.
#include "pipeline/vertices/polygon_mode.h"

#include <catch2/catch.hpp>

namespace {

using namespace strata::pipeline;

Mesh mesh_of(Primitive primitive, const std::vector<std::uint32_t>& indices) {
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
    mesh.indices = indices;
    mesh.primitive = primitive;
    return mesh;
}

DrawList three_meshes() {
    DrawList list;
    list.meshes = {mesh_of(Primitive::triangles, {0, 1, 2, 3, 2, 1}), mesh_of(Primitive::lines, {0, 0, 3}),
                   mesh_of(Primitive::points, {2, 2, 2})};
    return list;
}

}  // namespace

TEST_CASE("a triangle's sides are drawn in the chip's order and its corners in the file's") {
    const DrawList list = three_meshes();
    CHECK(with_polygon_mode(list, PolygonMode::fill).meshes == list.meshes);
    const DrawList lines = with_polygon_mode(list, PolygonMode::line);
    CHECK(lines.meshes[0].primitive == Primitive::polygon_lines);
    // From the second index to the third: 1-2, 2-0, 0-1 and 2-1, 1-3, 3-2.
    CHECK(lines.meshes[0].indices == std::vector<std::uint32_t>{0, 1, 2, 1, 2, 0, 2, 0, 1, 3, 2, 1, 2, 1, 3, 1, 3, 2});
    const DrawList points = with_polygon_mode(list, PolygonMode::point);
    CHECK(points.meshes[0].primitive == Primitive::polygon_points);
    CHECK(points.meshes[0].indices == std::vector<std::uint32_t>{1, 2, 0, 2, 0, 1, 0, 1, 2, 2, 1, 3, 1, 3, 2, 3, 2, 1});
    for (std::size_t mesh : {1, 2}) {
        CHECK(lines.meshes[mesh] == list.meshes[mesh]);
        CHECK(points.meshes[mesh] == list.meshes[mesh]);
    }
    CHECK(with_polygon_mode(lines, PolygonMode::line).meshes == lines.meshes);
}
