// tests/tools/oracle/mistakes/scenes_of_test.h - a laboratory over a scene of the suite, and pictures changed by hand.
#pragma once
#include "tools/oracle/mistakes/catalogue.h"
#include "tools/oracle/mistakes/diagnosis.h"
#include "tools/oracle/mistakes/suite.h"

namespace strata::test {

// Owns what the laboratory refers to, so it can be neither copied nor moved.
struct Bench {
    explicit Bench(const char* suite_scene)
        : opened{oracle::open(*oracle::find_suite_scene(suite_scene))}, laboratory{opened.input(), *opened.algorithm} {}
    Bench(const Bench&) = delete;
    Bench& operator=(const Bench&) = delete;

    [[nodiscard]] oracle::Picture with(const char* mistake) const {
        return laboratory.with(*oracle::find_mistake(mistake)).value();
    }
    [[nodiscard]] oracle::Picture with(const char* first, const char* second) const {
        const oracle::Mistake* const both[] = {oracle::find_mistake(first), oracle::find_mistake(second)};
        return laboratory.with(both).value();
    }

    oracle::OpenScene opened;
    oracle::Laboratory laboratory;
};

}  // namespace strata::test
