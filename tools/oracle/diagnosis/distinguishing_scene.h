// tools/oracle/diagnosis/distinguishing_scene.h - finds a scene of the suite that distinguishes mistakes with equal
// images of another scene.
//
// Tests    tests/tools/oracle/diagnosis/distinguishing_scene_test.cpp
#pragma once
#include <span>

#include "tools/oracle/emulations/catalogue.h"
#include "tools/oracle/suite/suite.h"

namespace strata::oracle {

// The first scene in which each of them gives a different image; null if there is none.
[[nodiscard]] const SuiteScene* distinguishing_scene(std::span<const Mistake* const> mistakes);

}  // namespace strata::oracle
