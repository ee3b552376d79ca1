// tools/probe/random_profile.h - random devices: every rule that decides a pixel of the kit at random.
//
// Rule     Features and limits are those of a built-in device, for a driver says them. A guard band has any power of
//          two as often as any other; every other field any of its values, until all go together (fields.h).
// Tests    tests/tools/probe/search_test.cpp
#pragma once
#include "tools/probe/fields.h"

namespace strata::probe {

// The same for a number on every machine.
[[nodiscard]] DeviceProfile random_profile(int number);

}  // namespace strata::probe
