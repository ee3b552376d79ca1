// tools/oracle/program/fit/at_random.h - layers that are lost, doubled or exchanged here and there: an edit that
// explains the wrong pixels one by one, while no property says which fragments it meets.
//
// Rule     At nearly every wrong pixel one fragment, or two that are left out, edited so give what is seen. That this
//          is no chance is asked of the colours that other wrong pixels show: few of them come out so.
// Tests    tests/tools/oracle/program/pairs_test.cpp
#pragma once
#include "tools/oracle/program/fit/prove.h"

namespace strata::oracle::program {

// Empty if no edit does. The program has words, and no edits.
[[nodiscard]] std::vector<Proof> explained_at_random(const Lists& lists, const Fitness& right);

}  // namespace strata::oracle::program
