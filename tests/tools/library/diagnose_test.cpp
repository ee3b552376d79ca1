// Tests the library's diagnosis on pictures with a deliberate mistake in their pixels or in the state.
#include <strata/strata.h>

#include <catch2/catch.hpp>
#include <utility>

using Catch::Contains;

namespace {

strata::Scene own_triangles() {
    // Two triangles that cross, in clip space.
    const float positions[] = {-0.9f, -0.8f, 0.1f, 0.9f, -0.7f, 0.6f, 0.0f, 0.9f,  -0.2f,
                               -0.7f, 0.8f,  0.5f, 0.8f, 0.7f,  0.0f, 0.1f, -0.9f, 0.2f};
    strata::Scene scene;
    scene.add({.positions = {positions, 6}, .color = {0.9f, 0.4f, 0.1f, 0.6f}});
    return scene;
}

const strata::RenderOptions frame{.width = 24, .height = 20, .background = {0.1f, 0.2f, 0.3f, 1}};

}  // namespace

TEST_CASE("the library names the mistake of a picture and accepts a correct picture") {
    const strata::Scene scene = own_triangles();
    const auto& dual = strata::algorithm("dual");
    const auto profile = strata::profile("geforce8");
    const auto right = strata::render(scene, dual, profile, frame);
    const auto fine = strata::diagnose(scene, right.picture(), dual, profile, frame);
    CHECK(fine.is_right());
    CHECK(fine.verdict() == "right");
    CHECK(fine.mistakes().empty());

    // Red and blue are swapped by hand; the picture has only colour.
    auto turned = strata::picture_of(right.color());
    auto& codes = turned.targets[0].codes;
    for (std::size_t i = 0; i < codes.size(); i += 4) std::swap(codes[i], codes[i + 2]);
    const auto found = strata::diagnose(scene, turned, dual, profile, frame);
    CHECK_FALSE(found.is_right());
    CHECK(found.mistakes() == std::vector<std::string>{"red_for_blue"});
    CHECK_THAT(found.text(), Catch::StartsWith("wrong: every pixel is that of: ") && Contains("(red_for_blue)"));
    CHECK_THAT(found.json(), Contains("\"verdict\": \"one_mistake\""));
    CHECK(found.comparison.differing == found.diagnosis.differing);

    auto spoiled = strata::picture_of(right.color());
    for (std::size_t i = 0; i < spoiled.targets[0].codes.size(); i += 7) spoiled.targets[0].codes[i] ^= 0x2a;
    const auto none = strata::diagnose(scene, spoiled, dual, profile, frame);
    CHECK(none.verdict() == "unknown_mistake");
    CHECK(none.mistakes().empty());
}

TEST_CASE("a candidate without a target is rejected by name") {
    const strata::Scene scene = own_triangles();
    CHECK_THROWS_WITH(
        strata::diagnose(scene, strata::Picture{}, strata::algorithm("dual"), strata::profile("geforce8"), frame),
        "candidate: targets: expected at least one, found none");
}

TEST_CASE("the library names the mistake of a resolved picture") {
    const strata::Scene scene = own_triangles();
    const auto& peel = strata::algorithm("front_to_back");
    const auto profile = strata::profile("geforce8");
    strata::RenderOptions four = frame;
    four.sampling.samples = 4;
    const auto right = strata::render(scene, peel, profile, four);
    CHECK(strata::diagnose(scene, right.picture(), peel, profile, four).is_right());
    const auto single = strata::render(scene, peel, profile, frame);
    const auto found = strata::diagnose(scene, strata::picture_of(single.color()), peel, profile, four);
    CHECK(found.mistakes() == std::vector<std::string>{"no_samples"});
    CHECK(found.diagnosis.at_edges > 0u);
}
