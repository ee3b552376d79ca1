// tools/oracle/verdict/report.h - a verdict as text and as JSON.
#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace strata::pipeline {
struct DrawList;
}

namespace strata::oracle::verdict {

struct Verdict;

// The first line of to_text.
[[nodiscard]] std::string first_line(const Verdict& verdict, const pipeline::DrawList& list);
// The verdict on the first line, its evidence below.
[[nodiscard]] std::string to_text(const Verdict& verdict, const pipeline::DrawList& list);
// What explains some of the wrong pixels, a sentence each.
[[nodiscard]] std::vector<std::string> leads_of(const Verdict& verdict, const pipeline::DrawList& list);
[[nodiscard]] nlohmann::ordered_json json_of(const Verdict& verdict, const pipeline::DrawList& list);

}  // namespace strata::oracle::verdict
