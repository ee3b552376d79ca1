// Tests the files that tools/new_algorithm.py writes: the listing is compiled unchanged and run. It must draw the same
// as `unsorted`; the expected lines are written by hand.
#include <catch2/catch.hpp>
#include <fstream>
#include <sstream>

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

std::string text_of(const std::string& name) {
    std::ostringstream text;
    text << std::ifstream{STRATA_RECIPE "/" + name}.rdbuf();
    return text.str();
}

std::size_t times(const std::string& text, const std::string& what) {
    std::size_t found = 0;
    for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++found;
    return found;
}

}  // namespace

TEST_CASE("a new algorithm from the recipe draws and is audited and is rejected by a device that lacks its features") {
    const std::vector<Algorithm> entries = listing::drawn_by_recipe::entries();
    REQUIRE(entries.size() == 1);
    CHECK(entries[0].name == "drawn_by_recipe");
    const TriangleScene scene = random_triangles(2001, 60);
    RenderOptions options;
    options.width = options.height = 64;
    options.background = {0.25f, 0.125f, 0, 0.5f};
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

TEST_CASE("a new algorithm has the last section of the page and the first line of the changes") {
    const std::string sections = text_of("peeling/reference/algorithms.md");
    const int listed = listing::drawn_by_recipe::entries()[0].listed;
    const std::string heading = "\n## " + std::to_string(listed / 10) + " `drawn_by_recipe`\n";
    REQUIRE(times(sections, heading) == 1);
    CHECK(times(sections, "\n## " + std::to_string(listed / 10) + " ") == 1);
    CHECK(sections.find("\n## ", sections.find(heading) + 1) == std::string::npos);
    for (const Algorithm& other : algorithms()) CHECK(other.listed < listed);
    const std::string changes = text_of("CHANGELOG.md");
    const std::size_t version = changes.find("\n## ");
    CHECK(changes.find("\n\n- Algorithm `drawn_by_recipe` (Nobody 1999): what it does.\n- ") ==
          changes.find('\n', version + 1));
}
