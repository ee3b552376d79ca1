// Tests long meshes against each vertex and triangle in a list of its own. Lists are transformed in chunks and in
// groups of sixteen.
#include <bit>
#include <catch2/catch.hpp>

#include "pipeline/vertices/prepare.h"
#include "tests/support/random_numbers.h"

namespace {

using namespace strata::testing;
using namespace strata::pipeline;

// `vertices` vertices with normals, colours and coordinates, and triangles between neighbours.
[[nodiscard]] Mesh long_mesh(Random& random, std::uint32_t vertices) {
    Mesh mesh;
    for (std::uint32_t i = 0; i < vertices; ++i) {
        const auto number = [&] { return random_float(random, -1, 1); };
        mesh.positions.push_back({number(), number(), number()});
        mesh.normals.push_back({number(), number(), number()});
        mesh.colors.push_back({number(), number(), number(), number()});
        mesh.texcoords.push_back({number(), number()});
    }
    for (std::uint32_t i = 0; i < vertices; ++i)
        for (const std::uint32_t step : {0u, 1u, 5u}) mesh.indices.push_back((i + step) % vertices);
    return mesh;
}

[[nodiscard]] DrawList two_meshes(std::uint32_t first, std::uint32_t second) {
    Random random{761};
    DrawList list;
    list.materials = {{.name = "",
                       .front = {1, 0.5f, 0.25f, 0.75f},
                       .back = {0.5f, 1, 0.125f, 0.5f},
                       .alpha_mode = AlphaMode::blend}};
    list.meshes = {long_mesh(random, first), long_mesh(random, second)};
    list.instances = {{.mesh = 0, .material = 0}, {.mesh = 1, .material = 0}, {.mesh = 0, .material = 0}};
    list.instances[2].model[3][0] = 0.5;
    return list;
}

using VertexBits = std::array<std::uint32_t, 14>;

// Vertex i of a mesh, transformed in a list of its own.
[[nodiscard]] VertexBits vertex_alone(const DrawList& list, const Instance& instance, std::size_t i, const View& view,
                                      const PrepareOptions& options) {
    const Mesh& mesh = list.meshes[instance.mesh];
    DrawList one;
    one.materials = list.materials;
    one.meshes.resize(1);
    one.meshes[0].positions = {mesh.positions[i]};
    one.meshes[0].normals = {mesh.normals[i]};
    one.meshes[0].colors = {mesh.colors[i]};
    one.meshes[0].texcoords = {mesh.texcoords[i]};
    one.instances = {instance};
    one.instances[0].mesh = 0;
    return std::bit_cast<VertexBits>(transform(one, view, options).vertices[0]);
}

}  // namespace

TEST_CASE("meshes of any length are transformed like their vertices alone and their triangles follow one another") {
    Random random{762};
    View view;
    view.projection = {1.5, 0, 0, 0, 0, 1.25, 0, 0, 0, 0, -1.1, -1, 0, 0, -0.3, 0};
    view.view = {0.8, 0.1, -0.6, 0, 0, 1, 0.2, 0, 0.6, 0, 0.8, 0, 0.1, -0.2, -3, 1};
    const PrepareOptions options{.alpha_scale = 0.5f, .threads = 2};
    for (const auto& [first, second] : {std::pair{1024u, 1025u}, {2049u, 15u}, {16u, 1023u}, {17u, 1u}}) {
        const DrawList list = two_meshes(first, second);
        const auto soup = transform(list, view, options);
        REQUIRE(soup.vertices.size() == 2 * first + second);
        REQUIRE(soup.indices.size() == 3 * (2 * first + second));
        std::size_t wrong = 0, base = 0, at = 0;
        for (const Instance& instance : list.instances) {
            const Mesh& mesh = list.meshes[instance.mesh];
            for (std::size_t i = 0; i < mesh.positions.size(); i += i % 1024 < 20 || i % 1024 > 1004 ? 1 : 13)
                wrong +=
                    std::bit_cast<VertexBits>(soup.vertices[base + i]) != vertex_alone(list, instance, i, view, options)
                        ? 1
                        : 0;
            for (const std::uint32_t index : mesh.indices) wrong += soup.indices[at++] != base + index ? 1 : 0;
            base += mesh.positions.size();
        }
        INFO(first << " and " << second << " vertices");
        CHECK(wrong == 0);
    }
}

TEST_CASE("r and q and coordinates of units belong to the vertices of the selected instances in order") {
    DrawList list = two_meshes(40, 30);
    list.materials.push_back(list.materials[0]);
    list.materials[1].alpha_mode = AlphaMode::opaque;
    list.instances[1].material = 1;
    CoordinateUnits units{};
    units[0] = {.enabled = true};
    strata::rasterizer::RasterState state;
    state.viewport = {0, 0, 32, 32};
    PrepareOptions options{.depth_quotient = true, .threads = 1, .units = units};
    const auto extras = [&](Selection selection) {
        options.selection = selection;
        auto all = prepare(list, {}, state, *find_profile("geforce8"), options).geometry.extras;
        const std::size_t given = selection == Selection::all ? 110 : selection == Selection::opaque ? 30 : 80;
        all.values.resize(18 * given);  // without those that clipping added
        return all.values;
    };
    const auto all = extras(Selection::all), opaque = extras(Selection::opaque),
               transparent = extras(Selection::transparent);
    const auto part = [&](std::size_t first, std::size_t end) {
        return std::vector<float>(all.begin() + static_cast<std::ptrdiff_t>(18 * first),
                                  all.begin() + static_cast<std::ptrdiff_t>(18 * end));
    };
    CHECK(opaque == part(40, 70));
    std::vector<float> others = part(0, 40);
    const std::vector<float> last = part(70, 110);
    others.insert(others.end(), last.begin(), last.end());
    CHECK(transparent == others);
    for (std::size_t i = 0; i < 40; ++i) {  // unit 0 has the coordinates of the mesh
        CHECK(all[18 * i + 2] == list.meshes[0].texcoords[i][0]);
        CHECK(all[18 * i + 3] == list.meshes[0].texcoords[i][1]);
        CHECK(all[18 * i + 4] == 0.0f);
        CHECK(all[18 * i + 5] == 1.0f);
    }
}
