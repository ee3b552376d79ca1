// scenes/files/strict_json.h - JSON that people write: each key of an object once.
//
// Rule     JSON leaves it open what a repeated key means, and parsers let the last one win: a line that an author
//          forgot to delete would then be passed over in silence. Here it is an error, as is nesting of more than 64
//          levels.
// Tests    tests/scenes/files/strict_json_test.cpp
#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace strata::scenes {

// `what` is what the text ought to be, as in "a camera in JSON". Throws InputError with the place.
[[nodiscard]] nlohmann::json parse_strict_json(const std::string& text, const std::string& file,
                                               const std::string& what);

}  // namespace strata::scenes
