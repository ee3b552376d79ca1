// tools/request/groups.h - the parts of the table of options, each in a source of its own.
#pragma once
#include <vector>

#include "tools/request/option_fields.h"

namespace strata::tools {

[[nodiscard]] std::vector<OptionField> view_fields();       // origin, reading and view
[[nodiscard]] std::vector<OptionField> device_fields();     // depth and targets
[[nodiscard]] std::vector<OptionField> algorithm_fields();  // algorithm
[[nodiscard]] std::vector<OptionField> sample_fields();     // shading and samples
[[nodiscard]] std::vector<OptionField> order_fields();      // order
[[nodiscard]] std::vector<OptionField> execution_fields();  // execution, resources and measures

}  // namespace strata::tools
