// tools/probe/search.h - the profile under which most pixels of a kit agree.
//
// Rule     Starts from the built-in profile that agrees best, with the device's own features and limits. Group after
//          group: every valid combination of the joint fields is tried on the group's first scene; the best of each
//          kind (by the first two fields) go on to all of its scenes, where fields are tried one and two at a time
//          until none gains. Points draw the search (comparison.h): a code that is nearly right counts, too, while
//          other fields are not known yet. At last the fields of all scenes that are not explained are tried on the
//          whole kit; if some stay, the search starts again from the next two built-in profiles.
// Tests    tests/tools/probe/search_test.cpp, infer_test.cpp
#pragma once
#include "tools/probe/comparison.h"

namespace strata::probe {

// What the pack says of features and limits, put into a profile. InputError for values that fields cannot have.
[[nodiscard]] DeviceProfile with_features(DeviceProfile profile, const ProbePack& pack);

// A device may cut its triangles by one rule and make their planes by another, which no profile says: where it draws
// comes before what it draws there. The values of the clip that cover most of its pixels; of equal ones the best.
[[nodiscard]] DeviceProfile covered_first(const Comparison& device, const DeviceProfile& start);

[[nodiscard]] DeviceProfile searched(const Comparison& device, const ProbePack& pack);

}  // namespace strata::probe
