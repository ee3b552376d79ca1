// Tests the count of fragments at exactly the depth of an opaque surface, on a scene in which they are counted by hand.
#include <catch2/catch.hpp>

#include "peeling/registry.h"
#include "tests/peeling/rendering.h"

namespace {

using namespace strata::testing;
using namespace strata::peeling;
using namespace strata::pipeline;

// Opaque at depth 0.5 where y is even. Fragments at 0.25, 0.5 and 0.75 of (2, 0); two at 0.5 of (1, 2); and, without an
// opaque surface, one at 0.5 of (0, 1) and one at the far plane of (3, 3).
FragmentScene scene_of_ties() {
    FragmentScene scene{4, 4};
    const Rgba grey{0.5f, 0.5f, 0.5f, 0.5f};
    for (std::size_t p = 0; p < 16; ++p)
        if (p / 4 % 2 == 0) scene.pixels[p].opaque = {0.5f, {1, 0, 0, 1}};
    scene.pixels[2].fragments = {{0.25f, grey}, {0.5f, grey}, {0.75f, grey}};
    scene.pixels[9].fragments = {{0.5f, grey}, {0.5f, grey}};
    scene.pixels[4].fragments = {{0.5f, grey}};
    scene.pixels[15].fragments = {{1.0f, grey}};
    return scene;
}

}  // namespace

TEST_CASE("fragments at exactly the depth of an opaque surface are counted by the keys of every audited algorithm") {
    for (const Algorithm& algorithm : algorithms())
        for (const auto& [profile, depth] :
             {std::pair{"geforce8", DepthFormat::d24}, std::pair{"ideal", DepthFormat::d32f}}) {
            RenderOptions options = options_for(scene_of_ties());
            options.depth = depth;
            const RenderResult result = render(scene_of_ties(), {profile, algorithm.name}, options);
            if (result.outcome != Outcome::done) continue;
            INFO(algorithm.name << " on " << profile);
            CHECK(result.audit.opaque_ties == PixelCount{2, 2, 0});
            CHECK(result.audit.hidden_by_opaque_ties == 3);
            CHECK(diagnosed(result, Fault::ties_with_opaque) == 2);
        }
}

TEST_CASE("a scene whose surfaces and fragments have distinct depths has no ties with opaque surfaces") {
    FragmentScene scene{4, 4};
    scene.pixels[5].opaque = {0.5f, {1, 0, 0, 1}};
    scene.pixels[5].fragments = {{0.25f, {1, 1, 1, 0.5f}}, {0.75f, {1, 1, 1, 0.5f}}};
    const RenderResult result = render(scene, {"geforce8", "dual"});
    CHECK(result.audit.opaque_ties.pixels == 0);
    CHECK_FALSE(has_diagnostic(result, Fault::ties_with_opaque));
}
