// tools/lab/probe/operations_table.h - findings about operations, as text and as JSON.
#pragma once
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tools/probe/operations.h"

namespace strata::tools {

// One row per operation, then the first counterexample of each operation that no hypothesis explains. Empty without
// findings.
[[nodiscard]] std::string operations_text(const std::vector<probe::OperationFinding>& findings);
[[nodiscard]] nlohmann::ordered_json operations_json(const std::vector<probe::OperationFinding>& findings);

}  // namespace strata::tools
