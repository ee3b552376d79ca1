// tools/lab/probe/search/search.h - searches the profile under which most pixels of a kit agree.
//
// Rule     Starts from the built-in profile that agrees best, with the device's own features and limits. Group by
//          group, every valid combination of the joint fields is tried on the group's first scene; the best of each
//          kind (by the first two fields) are continued on all of its scenes, where fields are tried one and two at a
//          time until none gains. Points guide the search (comparison.h): a nearly correct code counts, too, while
//          other fields are not known yet. Finally the fields of all unexplained scenes are tried on the whole kit; if
//          some scenes remain unexplained, the search starts again from the next two built-in profiles.
// Tests    tests/tools/lab/probe/search_test.cpp, infer_test.cpp
#pragma once
#include "tools/lab/probe/search/comparison.h"

namespace strata::probe {

// The profile with the features and limits of the pack. InputError for values that the fields cannot have.
[[nodiscard]] DeviceProfile with_features(DeviceProfile profile, const ProbePack& pack);

// A device may clip its triangles by one rule and compute their planes by another, which no profile can express:
// coverage then takes precedence over values. Chooses the values of the clip fields whose coverage agrees at most
// pixels; of equal ones the best.
[[nodiscard]] DeviceProfile covered_first(const KitComparison& device, const DeviceProfile& start);

[[nodiscard]] DeviceProfile searched(const KitComparison& device, const ProbePack& pack);

}  // namespace strata::probe
