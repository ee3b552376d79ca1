// tools/oracle/fragments/near_depths.h - the lists of a pixel whose depths nearly meet: right ports may have them in
// another order, or may merge them.
//
// Rule     Neighbours may exchange their order if a movement of 1/16 pixel changes their distance by as much as it is.
//          A fragment that may meet the opaque surface is on either side of it. Neighbours at most `close_codes` apart
//          are one depth for some right ports: of a group of such neighbours any one may be kept, the group may be
//          reversed, or it may be one layer with the MAX of each channel.
// Tests    tests/tools/oracle/fragments/near_depths_test.cpp
#pragma once
#include <vector>

#include "tools/oracle/fragments/edge_lists.h"

namespace strata::oracle::verdict {

inline constexpr std::uint32_t close_codes = 2;

// Adds copies with all groups of close depths left in one way, and copies with one of several groups left so.
void add_close_depths(const OtherList& given, std::vector<OtherList>& others);
// Adds copies with depths in another order that nearly meet. `moved`: the renderings moved in the four diagonal
// directions.
void add_near_depths(const OtherList& given, Drawings moved, std::vector<OtherList>& others);

}  // namespace strata::oracle::verdict
