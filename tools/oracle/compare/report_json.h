// tools/oracle/compare/report_json.h - the report of a comparison as a JSON document, for documents that contain it.
#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace strata::oracle {

struct Comparison;

// One object; all keys are always present.
[[nodiscard]] nlohmann::ordered_json json_of(const Comparison& comparison);
// The text of a document: indented, with an end of line; bytes that are no UTF-8 are replaced.
[[nodiscard]] std::string text_of(const nlohmann::ordered_json& document);

}  // namespace strata::oracle
