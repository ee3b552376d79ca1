// tools/strata/explain_candidate.h - explain --candidate: what a port composited at one pixel of its picture.
#pragma once
#include <string>

#include "tools/strata/options/options.h"

namespace strata::tools {

struct CandidateQuestion {
    RunOptions run{};  // of the scene; the size is the candidate's
    std::string candidate;
    int x = 0, y = 0;
    bool json = false;
};

// Prints what the picture composited there. 0: it is right there, 1: it is not.
[[nodiscard]] int explain_candidate(CandidateQuestion question);

}  // namespace strata::tools
