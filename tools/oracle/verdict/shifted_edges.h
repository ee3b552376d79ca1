// tools/oracle/verdict/shifted_edges.h - whether the edges of a picture are moved in one direction.
//
// Rule     Pixels that the given coverage does not explain are compared with the scene moved by 1/16 pixel in the four
//          diagonal directions. Every triangle that enters or leaves such a pixel is one vote for the directions that
//          give the pixel's value. Snapping and tie rules move the vertices independently, so that no direction has
//          nearly all votes.
// Numbers  10 votes or more, 95 % of them for one direction: by chance 1 of 250 pictures with so many excused edges.
// Tests    tests/tools/oracle/verdict/shifted_edges_test.cpp
#pragma once
#include <string_view>

#include "tools/oracle/search/account.h"

namespace strata::oracle::verdict {

class SceneFragments;
class Colors;

// "right and up"; "" if the edges have no direction. `right`: the account that the picture is right by.
[[nodiscard]] std::string_view direction_of_edges(const SceneFragments& scene, const Colors& candidate,
                                                  const CheckedAccount& right);

}  // namespace strata::oracle::verdict
