#include "tools/oracle/rules/rule.h"

#include "rasterizer/base/enum_values.h"

namespace strata::oracle::verdict {

std::string_view name(RuleKind kind) noexcept { return enum_name(kind); }

}  // namespace strata::oracle::verdict
