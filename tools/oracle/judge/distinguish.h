// tools/oracle/judge/distinguish.h - scenes of the suite that distinguish what looks the same in this one.
#pragma once
#include <string>

#include "tools/oracle/diagnosis/diagnosis.h"

namespace strata::oracle::verdict {
struct Verdict;
}

namespace strata::oracle {

// The command of the first scene of the suite on which the explanations give different pictures; "" if there is no such
// scene, or fewer than two explanations.
[[nodiscard]] std::string distinguishing_command(const verdict::Verdict& found);
// The scene that distinguishes the mistakes that give the same picture or, if none is known (`is_open`), the best ones.
[[nodiscard]] const SuiteScene* scene_for(const Diagnosis& found, bool is_open);

}  // namespace strata::oracle
