// tools/strata/diagnose/diagnosis_page.h - the page of a diagnosis: the verdict, why, what else was tried, and both
// pictures.
#pragma once
#include <string>

#include "tools/oracle/compare.h"
#include "tools/oracle/mistakes/diagnosis.h"
#include "tools/strata/report/plain_page.h"

namespace strata::tools {

struct DiagnosisShown {
    const oracle::Diagnosis& diagnosis;
    const oracle::Comparison& comparison;  // of the two pictures
    const oracle::Picture& right;
    const oracle::Picture& candidate;
};

// `command`: what draws the right picture.
[[nodiscard]] PlainPage diagnosis_page(const std::string& command, const DiagnosisShown& shown);

}  // namespace strata::tools
