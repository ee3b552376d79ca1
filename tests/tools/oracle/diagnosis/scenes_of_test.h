// tests/tools/oracle/diagnosis/scenes_of_test.h - a mistake renderer for a scene of the suite, and pictures changed by
// hand.
#pragma once
#include "tools/oracle/diagnosis/diagnosis.h"
#include "tools/oracle/emulations/catalogue.h"
#include "tools/oracle/suite/suite.h"

namespace strata::test {

// Owns what the mistake renderer refers to, so it can be neither copied nor moved.
struct SceneFixture {
    explicit SceneFixture(const char* suite_scene)
        : opened{oracle::open(*oracle::find_suite_scene(suite_scene))},
          mistake_renderer{opened.input(), *opened.algorithm} {}
    SceneFixture(const SceneFixture&) = delete;
    SceneFixture& operator=(const SceneFixture&) = delete;

    [[nodiscard]] oracle::Picture with(const char* mistake) const {
        return mistake_renderer.with(*oracle::find_mistake(mistake)).value();
    }
    [[nodiscard]] oracle::Picture with(const char* first, const char* second) const {
        const oracle::Mistake* const both[] = {oracle::find_mistake(first), oracle::find_mistake(second)};
        return mistake_renderer.with(both).value();
    }

    oracle::OpenScene opened;
    oracle::MistakeRenderer mistake_renderer;
};

}  // namespace strata::test
