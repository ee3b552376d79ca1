// tools/oracle/folders/folders_report.h - the comparison of two folders as text, as JSON and as JUnit test cases.
#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "tools/oracle/compare/report.h"
#include "tools/oracle/folders/compare_folders.h"

namespace strata::oracle {

// "3 of 4 pictures fail: 1 different, 1 missing, 1 extra"
[[nodiscard]] std::string counts_of(const FolderSummary& summary);
// The state, then these words: "different: 3 of 4 pictures fail: ..."
[[nodiscard]] std::string first_line(const FolderSummary& summary);
// "different (nearest of 2 baselines: menu@mac.png): 2 of 384 pixels differ by at most 3 codes; ..."
[[nodiscard]] std::string words_of(const FolderCase& one);
// The name, then these words: "menu.png: different: 2 of 384 pixels differ by at most 3 codes; ..."
[[nodiscard]] std::string line_of(const FolderCase& one);
// A test case that fails unless the case is accepted.
[[nodiscard]] JunitCase junit_case(const FolderCase& one);
// One object; all keys are always present.
[[nodiscard]] nlohmann::ordered_json json_of(const FolderCase& one);
// The document with the cases of json_of().
[[nodiscard]] nlohmann::ordered_json json_of(const FolderSummary& summary, nlohmann::ordered_json cases);

}  // namespace strata::oracle
