// tools/oracle/verdict/report.h - a verdict in words and as JSON.
#pragma once
#include <string>

#include "tools/oracle/verdict/verdict.h"

namespace strata::oracle::verdict {

// The verdict on a line, what it rests on below it.
[[nodiscard]] std::string to_text(const Verdict& verdict, const pipeline::DrawList& list);
[[nodiscard]] std::string to_json(const Verdict& verdict, const pipeline::DrawList& list);

}  // namespace strata::oracle::verdict
