// Tests the choice of a scene that distinguishes mistakes, against the mistakes' own pictures on that scene.
#include "tools/oracle/diagnosis/distinguishing_scene.h"

#include <catch2/catch.hpp>

#include "tools/oracle/emulations/mistake_renderer.h"

using namespace strata;
using namespace strata::oracle;

TEST_CASE("the scene that distinguishes mistakes has a different picture for each") {
    const Mistake* const both[] = {find_mistake("red_for_blue"), find_mistake("depth_24")};
    REQUIRE((both[0] != nullptr && both[1] != nullptr));
    const SuiteScene* scene = distinguishing_scene(both);
    REQUIRE(scene != nullptr);
    const OpenScene opened = open(*scene);
    const MistakeRenderer mistake_renderer{opened.input(), *opened.algorithm};
    const auto first = mistake_renderer.with(*both[0]), second = mistake_renderer.with(*both[1]);
    REQUIRE((first && second));
    CHECK(first->targets[0].codes != second->targets[0].codes);
    CHECK(first->targets[0].codes != mistake_renderer.right().targets[0].codes);
    CHECK(second->targets[0].codes != mistake_renderer.right().targets[0].codes);
}

TEST_CASE("one mistake needs no scene and a repeated mistake has none") {
    const Mistake* const one[] = {find_mistake("red_for_blue")};
    CHECK(distinguishing_scene(one) == nullptr);
    const Mistake* const twice[] = {one[0], one[0]};
    CHECK(distinguishing_scene(twice) == nullptr);
}
