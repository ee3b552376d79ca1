// tools/oracle/report.h - a comparison in words: text for people, JSON for programs, JUnit for continuous integration.
#pragma once
#include <string>
#include <vector>

#include "tools/oracle/compare.h"

namespace strata::oracle {

// The verdict in the first line; then targets, kinds and explanations that there are.
[[nodiscard]] std::string to_text(const Comparison& comparison);
// One object; every key is always there.
[[nodiscard]] std::string to_json(const Comparison& comparison);
// A test case for continuous integration; an empty failure is none.
struct JunitCase {
    std::string group{}, name{}, failure{};
    bool is_skipped = false;
};
[[nodiscard]] std::string to_junit(const std::vector<JunitCase>& cases);
// "31 pixels, first at 4,7": those beyond the tolerance.
[[nodiscard]] std::string failure_of(const KindReport& kind);

// A test case a kind, failed where pixels differ beyond the tolerance, skipped where the targets cannot show it.
[[nodiscard]] std::string to_junit(const Comparison& comparison);

}  // namespace strata::oracle
