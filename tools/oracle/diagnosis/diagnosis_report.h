// tools/oracle/diagnosis/diagnosis_report.h - a diagnosis as text and as JSON.
#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "tools/oracle/diagnosis/diagnosis.h"

namespace strata::oracle {

[[nodiscard]] std::string_view name(Conclusion conclusion) noexcept;

// "colours multiplied by their alpha twice (premultiplied_twice); and: ..."; "the correct renderer" if empty.
[[nodiscard]] std::string description_of(const std::vector<const Mistake*>& mistakes);

// What the emulations show, as a sentence with an end of line.
[[nodiscard]] std::string first_line(const Diagnosis& diagnosis);
// `comparison`: of the correct image and the candidate. The lines below the first: evidence, the next best findings,
// and, if the correct run did not make the image, the report of compare.
[[nodiscard]] std::string lines_of(const Diagnosis& diagnosis, const Comparison& comparison);
[[nodiscard]] inline std::string to_text(const Diagnosis& diagnosis, const Comparison& comparison) {
    return first_line(diagnosis) + lines_of(diagnosis, comparison);
}
// One object; all keys are always present.
[[nodiscard]] nlohmann::ordered_json json_of(const Diagnosis& diagnosis, const Comparison& comparison);

}  // namespace strata::oracle
