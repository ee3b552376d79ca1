// tools/oracle/compare/explanations.h - tests whether a mistake that changes the whole image turns the reference into
// the candidate.
//
// Rule     Each mistake predicts the candidate's pixel or value. A moved pixel agrees if its codes are equal; a
//          computed value agrees if it is within one code of the candidate's (half: 2^-9 of it, binary32: 2^-18),
//          because a port may round differently. `explained`: differing pixels that agree; `contradicted`: equal pixels
//          that do not agree.
// Tests    tests/tools/oracle/compare/explanations_test.cpp
#pragma once
#include <span>
#include <string>
#include <vector>

#include "tools/oracle/picture/pairs.h"

namespace strata::oracle {

struct Explanation {
    std::string mistake;      // "flipped_rows"
    std::string description;  // a description of the candidate
    std::uint64_t explained = 0, of = 0, contradicted = 0;
    [[nodiscard]] bool is_whole() const noexcept { return explained == of && contradicted == 0; }
};

// The mistakes that explain at least half of the differing pixels and more than they contradict, the best first.
[[nodiscard]] std::vector<Explanation> explanations(std::span<const TargetPair> pairs);

}  // namespace strata::oracle
