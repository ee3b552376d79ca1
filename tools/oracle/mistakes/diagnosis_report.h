// tools/oracle/mistakes/diagnosis_report.h - a diagnosis in words and as JSON.
#pragma once
#include <string>

#include "tools/oracle/mistakes/diagnosis.h"

namespace strata::oracle {

[[nodiscard]] std::string_view name(Verdict verdict) noexcept;

// "colours multiplied by their alpha twice (premultiplied_twice); and: ..."; "the right machine" for none.
[[nodiscard]] std::string sentence_of(const std::vector<const Mistake*>& mistakes);

// `comparison`: of the right picture and the candidate. The verdict in the first line, then the next best findings;
// where the right machine did not make the picture, what compare says of it.
[[nodiscard]] std::string to_text(const Diagnosis& diagnosis, const Comparison& comparison);
// One object; every key is always there.
[[nodiscard]] std::string to_json(const Diagnosis& diagnosis, const Comparison& comparison);

}  // namespace strata::oracle
