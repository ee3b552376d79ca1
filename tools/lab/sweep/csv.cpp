#include "tools/lab/sweep/csv.h"

#include <fmt/format.h>

#include <algorithm>

namespace strata::tools {

using nlohmann::ordered_json;

std::string csv_field(const ordered_json& value) {
    if (!value.is_string()) return value.dump();
    const auto text = value.get<std::string>();
    if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
    std::string quoted(1, '"');
    for (const char c : text) quoted.append(c == '"' ? 2 : 1, c);
    quoted += '"';
    return quoted;
}

std::string csv_of_columns(const std::vector<std::string>& pointers, const Lines& lines) {
    std::vector<ordered_json::json_pointer> places;
    std::vector<std::string> fields;
    for (const std::string& pointer : pointers) {
        places.emplace_back(pointer);
        fields.push_back(pointer.substr(1));
        std::replace(fields.back().begin(), fields.back().end(), '/', '.');
    }
    std::string text = fmt::format("{}\n", fmt::join(fields, ","));
    for (const ordered_json& line : lines) {
        fields.clear();
        for (const auto& place : places) {
            const ordered_json* value = line.contains(place) ? &line.at(place) : nullptr;
            fields.push_back(value == nullptr || value->is_null() ? "" : csv_field(*value));
        }
        text += fmt::format("{}\n", fmt::join(fields, ","));
    }
    return text;
}

}  // namespace strata::tools
