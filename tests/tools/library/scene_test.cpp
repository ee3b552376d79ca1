// Tests scenes of the library: vertices written by hand, and pictures of the same triangles in other layouts.
#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>
#include <functional>
#include <type_traits>

#include "strata/strata.h"

using namespace strata;
using Catch::Matchers::Contains;

namespace {

constexpr float two_triangles[] = {-1, -1, 0.25f, 1, -1, 0.25f, -1, 1, 0.25f, 1, -1, -0.5f, 1, 1, -0.5f, -1, 1, -0.5f};
constexpr float six_colors[] = {1, 0, 0, 0.5f,  0, 1, 0, 0.5f,  0, 0, 1, 0.5f,
                                1, 1, 0, 0.25f, 0, 1, 1, 0.75f, 1, 0, 1, 0.5f};

std::string digest_of(const Scene& scene) {
    return render(scene, algorithm("dual"), profile("geforce8"), {.width = 24, .height = 16}).digest();
}

Triangles both() { return {.name = "both", .positions = {two_triangles, 6}, .colors = {six_colors, 6}}; }

// The error message of add() for triangles that are changed.
std::string message_for(const std::function<void(Triangles&)>& change) {
    Triangles triangles = both();
    change(triangles);
    Scene scene;
    try {
        scene.add(triangles);
    } catch (const InputError& error) {
        CHECK(scene.list().instances.empty());
        return error.what();
    }
    return "accepted";
}

}  // namespace

TEST_CASE("interleaved and indexed and plain vertices of equal content make the same scene") {
    Scene plain;
    plain.add(both());
    // Seven floats per vertex, at an odd address.
    std::vector<std::byte> memory(1 + 6 * 28);
    for (std::size_t v = 0; v < 6; ++v) {
        std::memcpy(memory.data() + 1 + 28 * v, two_triangles + 3 * v, 12);
        std::memcpy(memory.data() + 1 + 28 * v + 12, six_colors + 4 * v, 16);
    }
    Scene interleaved;
    interleaved.add({.name = "both", .positions = {memory.data() + 1, 6, 28}, .colors = {memory.data() + 13, 6, 28}});
    CHECK(interleaved.list().meshes == plain.list().meshes);
    const std::uint32_t order[] = {0, 1, 2, 3, 4, 5};
    Triangles indexed = both();
    indexed.indices = order;
    Scene by_index;
    by_index.add(indexed);
    CHECK(by_index.list().meshes == plain.list().meshes);
    CHECK(digest_of(interleaved) == digest_of(plain));
}

TEST_CASE("two vertices are a line and one a point") {
    const auto indices = [](Primitive primitive, std::span<const std::uint32_t> given) {
        Triangles shapes = both();
        shapes.primitive = primitive;
        shapes.indices = given;
        Scene scene;
        scene.add(shapes);
        CHECK(scene.list().meshes.at(0).primitive == primitive);
        return scene.list().meshes[0].indices;
    };
    const std::uint32_t four[] = {3, 1, 1, 2};
    using Indices = std::vector<std::uint32_t>;
    CHECK(indices(Primitive::lines, four) == Indices{3, 3, 1, 1, 1, 2});
    CHECK(indices(Primitive::points, std::span{four}.first(2)) == Indices{3, 3, 3, 1, 1, 1});
    CHECK(indices(Primitive::lines, {}) == Indices{0, 0, 1, 2, 2, 3, 4, 4, 5});
    CHECK_THAT(message_for([&](Triangles& t) {
                   t.primitive = Primitive::lines;
                   t.indices = std::span{four}.first(3);
               }),
               Contains("indices: expected two per line, found 3"));
    CHECK_THAT(message_for([](Triangles& t) { t.primitive = Primitive::polygon_lines; }),
               Contains("primitive: expected triangles, lines or points, found 3"));
}

TEST_CASE("without a camera positions are clip coordinates and a model matrix transforms them") {
    Scene moved;
    Triangles shifted = both();
    shifted.model = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -0.5, 0, 0, 1};
    moved.add(shifted);
    Scene by_view;
    by_view.add(both());
    View view;
    view.view = matrix_of({1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -0.5, 0, 0, 1});
    by_view.look(view);
    CHECK(digest_of(moved) == digest_of(by_view));
    Scene still;
    still.add(both());
    CHECK(digest_of(moved) != digest_of(still));
}

TEST_CASE("triangles can be added to a loaded scene and opaque ones hide others") {
    Scene teapot{"teapot"};
    const std::string alone = digest_of(teapot);
    teapot.orbit(30, 20);
    CHECK(digest_of(teapot) == alone);  // its default view
    Scene hidden;
    hidden.add({.name = "wall", .positions = {two_triangles + 9, 3}, .color = {0, 0, 1, 1}, .is_transparent = false});
    const std::string wall = digest_of(hidden);
    hidden.add({.name = "behind", .positions = {two_triangles, 3}, .color = {1, 1, 1, 0.5f}});
    Scene behind_first;
    behind_first.add({.name = "behind", .positions = {two_triangles, 3}, .color = {1, 1, 1, 0.5f}});
    behind_first.add(
        {.name = "wall", .positions = {two_triangles + 9, 3}, .color = {0, 0, 1, 1}, .is_transparent = false});
    CHECK(digest_of(hidden) != wall);
    CHECK(digest_of(hidden) == digest_of(behind_first));
}

TEST_CASE("an invalid field of triangles is rejected by name and nothing is added") {
    const std::uint32_t wrong[] = {0, 1, 6};
    const std::uint32_t two[] = {0, 1};
    CHECK_THAT(message_for([](Triangles& t) {
                   t.positions.count = 5;
                   t.colors.count = 5;
               }),
               Contains("triangles 'both': positions.count: expected three per triangle, found 5"));
    CHECK_THAT(message_for([](Triangles& t) { t.positions.count = 0; }),
               Contains("positions.count: expected at least 1, found 0"));
    CHECK_THAT(message_for([](Triangles& t) { t.positions.first = nullptr; }),
               Contains("positions.first: expected the address of 6 vertices, found null"));
    CHECK_THAT(message_for([](Triangles& t) { t.positions.stride_bytes = 8; }),
               Contains("positions.stride_bytes: expected 0 or at least 12, found 8"));
    CHECK_THAT(message_for([](Triangles& t) { t.colors.count = 3; }),
               Contains("colors.count: expected 6 or none, found 3"));
    CHECK_THAT(message_for([](Triangles& t) { t.colors.stride_bytes = 12; }),
               Contains("colors.stride_bytes: expected 0 or at least 16, found 12"));
    CHECK_THAT(message_for([&](Triangles& t) { t.indices = wrong; }),
               Contains("indices[2]: expected less than 6, found 6"));
    CHECK_THAT(message_for([&](Triangles& t) { t.indices = two; }),
               Contains("indices: expected three per triangle, found 2"));
    CHECK_THAT(message_for([](Triangles& t) { t.color[3] = NAN; }), Contains("color[3]: expected a finite number"));
    CHECK_THAT(message_for([](Triangles& t) { t.model.emplace().fill(INFINITY); }),
               Contains("model[0]: expected a finite number"));
    CHECK(message_for([](Triangles&) {}) == "accepted");
}

TEST_CASE("a camera with an empty view volume is rejected by its field") {
    const auto said_of_camera = [](const std::function<void(LookAt&)>& change) -> std::string {
        LookAt camera;
        change(camera);
        try {
            Scene{}.look_at(camera);
        } catch (const InputError& error) {
            return error.what();
        }
        return "accepted";
    };
    CHECK(said_of_camera([](LookAt&) {}) == "accepted");
    CHECK_THAT(said_of_camera([](LookAt& c) { c.eye[1] = NAN; }), Contains("camera: eye: expected finite numbers"));
    CHECK_THAT(said_of_camera([](LookAt& c) { c.center = c.eye; }), Contains("center: expected another point"));
    CHECK_THAT(said_of_camera([](LookAt& c) { c.fovy_degrees = 180; }), Contains("fovy_degrees: expected"));
    CHECK_THAT(said_of_camera([](LookAt& c) { c.near = 0; }), Contains("near: expected a finite number above 0"));
    CHECK_THAT(said_of_camera([](LookAt& c) { c.far = c.near; }), Contains("far: expected a finite number above near"));
}

TEST_CASE("names are in the namespace of their minor version") {
    STATIC_REQUIRE(std::is_same_v<strata::Scene, strata::v0_1::Scene>);
    STATIC_REQUIRE(std::is_same_v<strata::Rendering, strata::v0_1::Rendering>);
    CHECK(version_major == 0);
    CHECK(version_minor == 1);
}

TEST_CASE("a wrong name is rejected with the nearest valid one and a wrong angle with its limits") {
    CHECK_THROWS_WITH(profile("geforc8"), Contains("profile: name: ") && Contains("did you mean 'geforce8'?"));
    CHECK_THROWS_WITH(algorithm("duel"), Contains("did you mean 'dual'?") && Contains("front_to_back"));
    CHECK_THROWS_WITH(Scene{"teapott"}, Contains("teapot"));
    CHECK_THROWS_AS(Scene{"teapot"}.orbit(0, 91), InputError);
    CHECK(version() ==
          std::to_string(version_major) + "." + std::to_string(version_minor) + "." + std::to_string(version_patch));
}
