// tools/lab/probe/search/random_profile.h - random devices: every rule that affects a pixel of the kit has a random
// value.
//
// Rule     Features and limits are those of a built-in device, because a driver reports them. Powers of two are equally
//          likely for a guard band; every other field has any of its values. Values are drawn until all are consistent
//          (fields.h).
// Tests    tests/tools/lab/probe/search_test.cpp
#pragma once
#include "tools/lab/probe/search/fields.h"

namespace strata::probe {

// A given number gives the same profile on every machine.
[[nodiscard]] DeviceProfile random_profile(int number);

}  // namespace strata::probe
