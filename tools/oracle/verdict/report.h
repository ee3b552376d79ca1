// tools/oracle/verdict/report.h - a verdict in words and as JSON.
#pragma once
#include <string>

namespace strata::pipeline {
struct DrawList;
}

namespace strata::oracle::verdict {

struct Verdict;

// The verdict on a line, what it rests on below it.
[[nodiscard]] std::string to_text(const Verdict& verdict, const pipeline::DrawList& list);
[[nodiscard]] std::string to_json(const Verdict& verdict, const pipeline::DrawList& list);

}  // namespace strata::oracle::verdict
