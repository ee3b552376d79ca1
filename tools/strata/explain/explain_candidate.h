// tools/strata/explain/explain_candidate.h - explain --candidate: the fragments that a port composited at one pixel of
// its picture.
#pragma once
#include <string>

#include "tools/strata/options/options.h"

namespace strata::tools {

struct CandidateQuestion {
    RunOptions run{};  // of the scene; width and height are replaced by the candidate's
    std::string candidate;
    int x = 0, y = 0;
    bool json = false;
};

// Prints the fragments that the picture composited at the pixel. Returns 0 if the pixel is right, 1 if it is not.
[[nodiscard]] int explain_candidate(CandidateQuestion question);

}  // namespace strata::tools
