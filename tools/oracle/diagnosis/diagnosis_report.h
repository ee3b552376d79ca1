// tools/oracle/diagnosis/diagnosis_report.h - a diagnosis as text and as JSON.
#pragma once
#include <string>

#include "tools/oracle/diagnosis/diagnosis.h"

namespace strata::oracle {

[[nodiscard]] std::string_view name(Conclusion conclusion) noexcept;

// "colours multiplied by their alpha twice (premultiplied_twice); and: ..."; "the correct renderer" if empty.
[[nodiscard]] std::string description_of(const std::vector<const Mistake*>& mistakes);

// `comparison`: of the correct image and the candidate. The first line is the verdict; the next best findings follow,
// and, if the correct run did not make the image, the report of compare.
[[nodiscard]] std::string to_text(const Diagnosis& diagnosis, const Comparison& comparison);
// One object; all keys are always present.
[[nodiscard]] std::string to_json(const Diagnosis& diagnosis, const Comparison& comparison);

}  // namespace strata::oracle
