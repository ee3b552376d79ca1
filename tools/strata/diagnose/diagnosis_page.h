// tools/strata/diagnose/diagnosis_page.h - the page of diagnose --report: the verdict, its reasons, the other
// hypotheses, and both pictures.
#pragma once
#include <string>

#include "tools/oracle/judge/judge.h"
#include "tools/strata/report/plain_page.h"

namespace strata::tools {

// `command` is the command that renders the right picture.
[[nodiscard]] PlainPage diagnosis_page(const std::string& command, const oracle::Judgement& judgement,
                                       const oracle::Picture& candidate);

}  // namespace strata::tools
