// tools/strata/probe/operations_text.h - what was found of a device's operations, as text and as JSON.
#pragma once
#include <nlohmann/json.hpp>
#include <string>

#include "tools/probe/operation.h"

namespace strata::tools {

// Empty where no operation was answered.
[[nodiscard]] std::string operations_text(const probe::OperationReplies& replies);
[[nodiscard]] nlohmann::ordered_json operations_json(const probe::OperationReplies& replies);

}  // namespace strata::tools
