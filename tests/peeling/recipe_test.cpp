// The file that tools/new_algorithm.py writes, compiled as it is and run. Model: unsorted, which draws the same.
#include <catch2/catch.hpp>

#include "peeling/registry.h"
#include "tests/peeling/rendering.h"
#include "tests/pipeline/frames.h"
#include "tests/support/random_triangles.h"

namespace strata::peeling::listing::drawn_by_recipe {
std::vector<Algorithm> entries();
}

namespace {

using namespace strata::testing;
using namespace strata::peeling;

}  // namespace

TEST_CASE(
    "a new algorithm as the recipe begins it draws, is audited, and is refused by a device that lacks what it names") {
    const std::vector<Algorithm> entries = listing::drawn_by_recipe::entries();
    REQUIRE(entries.size() == 1);
    CHECK(entries[0].name == "drawn_by_recipe");
    const TriangleScene scene = random_triangles(2001, 60);
    RenderOptions options;
    options.width = options.height = 64;
    const auto on = [&](const char* profile) {
        Renderer renderer{scene.list, scene.view, *strata::pipeline::find_profile(profile), options};
        return renderer.render(entries[0]);
    };
    const RenderResult drawn = on("geforce8");
    REQUIRE(drawn.outcome == Outcome::done);
    CHECK(drawn.frame.color == render(scene.list, scene.view, {"geforce8", "unsorted"}, options).frame.color);
    CHECK(drawn.frame.passes.geometry == 1);
    const RenderResult refused = on("geforce3");
    CHECK(refused.outcome == Outcome::refused);
    CHECK(refused.refusal.value().feature == "fragment programs that discard after a compare");
}
