// Tests which scenes distinguish mistakes: a scene with one layer hides those that are visible with many layers.
#include "tools/oracle/rules/distinguish_rules.h"

#include <catch2/catch.hpp>

#include "tests/tools/oracle/verdict/opened_scene.h"

using namespace strata;
using namespace strata::oracle::verdict;
using namespace strata::test;

TEST_CASE("a scene with many layers distinguishes mistakes and one without these layers does not") {
    const std::vector<Rule> second{{.kind = RuleKind::lost, .n = 1}}, reversed{{.kind = RuleKind::reversed}},
        ninth{{.kind = RuleKind::lost, .n = 8}};
    const OpenedScene deep{"showroom", 32, 32}, shallow{"teapot", 32, 24};
    const SceneFragments many = deep.fragments(), few = shallow.fragments();
    CHECK(distinguishes(many, {second, reversed}));
    CHECK_FALSE(distinguishes(many, {second, second}));
    CHECK(distinguishes(few, {second, reversed}));
    CHECK_FALSE(distinguishes(few, {second, ninth}));  // `ninth` changes nothing in this scene
}

TEST_CASE("a rule about one instance or material does not apply to other scenes") {
    CHECK(is_of_any_scene({{.kind = RuleKind::reversed}, {.kind = RuleKind::some_lost, .scope = Scope::back_faces}}));
    CHECK_FALSE(is_of_any_scene({{.kind = RuleKind::some_lost, .scope = Scope::instance}}));
    CHECK_FALSE(is_of_any_scene({{.kind = RuleKind::reversed}, {.kind = RuleKind::decoded, .scope = Scope::material}}));
}
