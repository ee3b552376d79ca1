// Tests that frames do not depend on earlier or concurrent ones: each must equal that of a renderer that draws only
// this frame.
#include <catch2/catch.hpp>
#include <limits>
#include <set>
#include <span>

#include "peeling/registry.h"
#include "tests/peeling/rendering.h"
#include "tests/support/difference.h"
#include "tests/support/random_triangles.h"

namespace {

using namespace strata;
using namespace strata::testing;
using peeling::Algorithm;
using peeling::Renderer;
using peeling::RenderOptions;
using peeling::RenderResult;

// Tiles of two sizes at the edges, because no side is a multiple of the tile size.
RenderOptions options_sized(int width, int height) {
    RenderOptions options;
    options.width = width;
    options.height = height;
    options.threads = 1;
    options.background = {0.1f, 0.2f, 0.3f, 1};
    return options;
}

std::vector<const Algorithm*> all_algorithms() {
    std::vector<const Algorithm*> all;
    for (const Algorithm& algorithm : peeling::algorithms()) all.push_back(&algorithm);
    return all;
}

RenderResult alone(const TriangleScene& scene, const RenderOptions& options, const Algorithm& algorithm) {
    return Renderer{scene.list, scene.view, *pipeline::find_profile("geforce8"), options}.render(algorithm);
}

}  // namespace

TEST_CASE(
    "frames in sequence equal those of separate renderers for any order and tile size and depth of earlier ones") {
    const TriangleScene scene = random_triangles(801, 40);
    RenderOptions plain = options_sized(150, 100), two_lists = plain;
    two_lists.vertex_paths.second = pipeline::VertexPath::toward_zero;
    const std::vector<const Algorithm*> sequence = all_algorithms();
    for (const RenderOptions& options : {plain, two_lists}) {
        std::vector<RenderResult> expected;
        for (const Algorithm* algorithm : sequence) expected.push_back(alone(scene, options, *algorithm));
        Renderer renderer{scene.list, scene.view, *pipeline::find_profile("geforce8"), options};
        std::string wrong;
        std::set<int> sizes_used;
        // Forwards and backwards, so that each frame has different predecessors.
        for (std::size_t turn = 0; turn < 2 * sequence.size(); ++turn) {
            const std::size_t i = turn < sequence.size() ? turn : 2 * sequence.size() - 1 - turn;
            const RenderResult found = renderer.render(*sequence[i]);
            if (const std::string what = difference(found, expected[i]); !what.empty())
                wrong += sequence[i]->name + " after " + std::to_string(turn) + " others: " + what + "; ";
            sizes_used.insert(found.frame.work.tile_size);
        }
        CHECK(wrong == "");
        CHECK(sizes_used.size() >= 3);  // 0 for a whole frame, and two tile sizes
    }
}

TEST_CASE("the seconds of an algorithm's lists do not contain those of the algorithms before it") {
    const TriangleScene scene = random_triangles(804, 40);
    Renderer renderer{scene.list, scene.view, *pipeline::find_profile("geforce8"), options_sized(90, 70)};
    const auto rendered = [&](const char* name) { return renderer.render(*peeling::find_algorithm(name)); };
    const RenderResult first = rendered("dual"), between = rendered("painter"), last = rendered("dual");
    REQUIRE(first.frame.work.tile_size == between.frame.work.tile_size);  // nothing is binned again
    CHECK(first.seconds.geometry > 0);
    CHECK(between.seconds.geometry > 0);
    CHECK(last.seconds.geometry == first.seconds.geometry);
}

TEST_CASE("two renderers of different scenes and sizes that draw alternately do not disturb each other") {
    const TriangleScene first = random_triangles(802, 30), second = random_triangles(803, 60, 0.4f);
    const RenderOptions large = options_sized(90, 70), small = options_sized(33, 41);
    const pipeline::DeviceProfile& profile = *pipeline::find_profile("geforce8");
    Renderer one{first.list, first.view, profile, large}, other{second.list, second.view, profile, small};
    std::string wrong;
    for (const char* name : {"dual", "coherent_ideal", "front_to_back", "batched", "layer_peel", "dual", "a_buffer"}) {
        const Algorithm& algorithm = *peeling::find_algorithm(name);
        const RenderResult of_one = one.render(algorithm), of_other = other.render(algorithm);
        wrong +=
            difference(of_one, alone(first, large, algorithm)) + difference(of_other, alone(second, small, algorithm));
    }
    CHECK(wrong == "");
}

TEST_CASE("a dropped triangle is reported by its index in the given list for any order that the algorithm draws") {
    TriangleScene scene = random_triangles(804, 8);
    scene.list.instances.resize(1);  // only the transparent one
    auto& mesh = scene.list.meshes[0];
    const std::uint32_t broken = mesh.indices[3 * 5];
    mesh.positions[broken].x = std::numeric_limits<float>::quiet_NaN();
    const auto corners = [&](std::size_t triangle) { return std::span{mesh.indices}.subspan(3 * triangle, 3); };
    std::size_t count = 0, first = mesh.indices.size();
    for (std::size_t triangle = mesh.indices.size() / 3; triangle-- > 0;)
        if (std::ranges::count(corners(triangle), broken) > 0) ++count, first = triangle;
    const std::string expected =
        std::to_string(count) + " triangles dropped, the first is number " + std::to_string(first);
    std::string wrong;
    for (const Algorithm* algorithm : all_algorithms()) {
        const RenderResult found = alone(scene, options_sized(32, 24), *algorithm);
        if (found.outcome != peeling::Outcome::done) continue;
        const auto named = std::ranges::find(found.frame.diagnostics, pipeline::Fault::non_finite_vertices,
                                             &pipeline::Diagnostic::fault);
        if (named == found.frame.diagnostics.end() || named->detail != expected) wrong += algorithm->name + " ";
    }
    CHECK(wrong == "");
}
