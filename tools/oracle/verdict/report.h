// tools/oracle/verdict/report.h - a verdict as text and as JSON.
#pragma once
#include <string>

namespace strata::pipeline {
struct DrawList;
}

namespace strata::oracle::verdict {

struct Verdict;

// The first line of to_text.
[[nodiscard]] std::string first_line(const Verdict& verdict, const pipeline::DrawList& list);
// The verdict on the first line, its evidence below.
[[nodiscard]] std::string to_text(const Verdict& verdict, const pipeline::DrawList& list);
[[nodiscard]] std::string to_json(const Verdict& verdict, const pipeline::DrawList& list);

}  // namespace strata::oracle::verdict
