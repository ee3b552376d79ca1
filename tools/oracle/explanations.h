// tools/oracle/explanations.h - mistakes that change a whole picture: does one of them make the candidate out of the
// reference?
//
// Rule     Each mistake says which pixel or which value the candidate would have. A moved pixel agrees if its codes are
//          equal; a computed value if it is within one code of the candidate's (half: 2^-9 of it, binary32: 2^-18),
//          because a port may round as it likes. `explained`: differing pixels that agree; `contradicted`: equal pixels
//          that do not.
// Tests    tests/tools/oracle/explanations_test.cpp
#pragma once
#include <span>
#include <string>
#include <vector>

#include "tools/oracle/pairs.h"

namespace strata::oracle {

struct Explanation {
    std::string mistake;   // "flipped_rows"
    std::string sentence;  // what the candidate then is
    std::uint64_t explained = 0, of = 0, contradicted = 0;
    [[nodiscard]] bool is_whole() const noexcept { return explained == of && contradicted == 0; }
};

// The mistakes that explain at least half of the differing pixels and more than they contradict, the best first.
[[nodiscard]] std::vector<Explanation> explanations(std::span<const Pair> pairs);

}  // namespace strata::oracle
