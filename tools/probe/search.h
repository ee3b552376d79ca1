// tools/probe/search.h - the profile under which most pixels of a kit agree.
//
// Rule     Starts from the built-in profile that agrees best, with the device's own features and limits. Group after group:
//          every valid combination of the joint fields is tried on the group's first scene; the best of each kind (by the
//          first two fields) go on to all of its scenes, where pairs of the refined fields are tried until none gains. A
//          value is left only for one under which more pixels agree.
// Tests    tests/tools/probe/infer_test.cpp
#pragma once
#include "tools/probe/comparison.h"

namespace strata::probe {

// What the pack says of features and limits, put into a profile. InputError for values that fields cannot have.
[[nodiscard]] DeviceProfile with_features(DeviceProfile profile, const ProbePack& pack);

[[nodiscard]] DeviceProfile searched(const Comparison& device, const ProbePack& pack);

}  // namespace strata::probe
