// tools/oracle/mistakes/telling.h - which scene of the suite tells mistakes apart that leave one picture of another
// scene.
//
// Tests    tests/tools/oracle/mistakes/telling_test.cpp
#pragma once
#include <span>

#include "tools/oracle/mistakes/catalogue.h"
#include "tools/oracle/mistakes/suite.h"

namespace strata::oracle {

// The first in which each of them leaves a picture of its own; null if there is none.
[[nodiscard]] const SuiteScene* telling_scene(std::span<const Mistake* const> mistakes);

}  // namespace strata::oracle
