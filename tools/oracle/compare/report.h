// tools/oracle/compare/report.h - the report of a comparison as text, as JSON and as JUnit for continuous integration.
#pragma once
#include <string>
#include <vector>

#include "tools/oracle/compare/compare.h"

namespace strata::oracle {

// The verdict in the first line, then targets, kinds and explanations.
[[nodiscard]] std::string to_text(const Comparison& comparison);
// One object; all keys are always present.
[[nodiscard]] std::string to_json(const Comparison& comparison);
// A test case for continuous integration; it fails unless `failure` is empty.
struct JunitCase {
    std::string group{}, name{}, failure{};
    bool is_skipped = false;
};
[[nodiscard]] std::string to_junit(const std::vector<JunitCase>& cases);
// "RMSE 0.567/255, PSNR 53.07 dB" in the steps of the reference's codes; of floats the RMSE is that of the values.
// Empty without figures.
[[nodiscard]] std::string noise_of(const TargetReport& target);
// "NaN at 0 pixels of the reference and 1 of the candidate, first at 5,5", and the same of infinity. Empty without
// both.
[[nodiscard]] std::string not_finite_of(const TargetReport& target);
// "31 pixels, first at 4,7": those beyond the tolerance.
[[nodiscard]] std::string failure_of(const KindReport& kind);

// One test case per kind, failed if pixels differ beyond the tolerance, skipped if the targets cannot show the kind.
[[nodiscard]] std::string to_junit(const Comparison& comparison);

}  // namespace strata::oracle
