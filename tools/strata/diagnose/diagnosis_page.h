// tools/strata/diagnose/diagnosis_page.h - the page of diagnose --report: the verdict, its reasons, the other
// hypotheses, and both pictures.
#pragma once
#include <string>

#include "tools/oracle/compare/compare.h"
#include "tools/oracle/diagnosis/diagnosis.h"
#include "tools/strata/report/plain_page.h"

namespace strata::tools {

struct DiagnosisShown {
    const oracle::Diagnosis& diagnosis;
    const oracle::Comparison& comparison;  // of the right picture and the candidate
    const oracle::Picture& right;
    const oracle::Picture& candidate;
};

// `command` is the command that renders the right picture.
[[nodiscard]] PlainPage diagnosis_page(const std::string& command, const DiagnosisShown& shown);

}  // namespace strata::tools
