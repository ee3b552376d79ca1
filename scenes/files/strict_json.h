// scenes/files/strict_json.h - parses JSON written by hand, in which each key of an object may occur only once.
//
// Rule     JSON does not define the meaning of a repeated key, and most parsers use the last one: a line that an author
//          forgot to delete would be ignored silently. Here it is an error, as is nesting of more than 64 levels.
// Tests    tests/scenes/files/strict_json_test.cpp
#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace strata::scenes {

// `what` describes the expected text, as in "a camera in JSON". Throws InputError with the JSON pointer.
[[nodiscard]] nlohmann::json parse_strict_json(const std::string& text, const std::string& file,
                                               const std::string& what);

// The end of a message about a value: "an object", "an array of 3", or the value itself, at most 64 bytes of it.
[[nodiscard]] std::string json_in_words(const nlohmann::json& value);

}  // namespace strata::scenes
