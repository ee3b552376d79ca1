// scenes/files/strict_json.cpp - a JSON parser callback that rejects repeated keys and deep nesting (strict_json.h).
#include "scenes/files/strict_json.h"

#include <functional>
#include <nlohmann/json.hpp>
#include <set>
#include <vector>

#include "rasterizer/base/input_error.h"
#include "scenes/memory_limit.h"

namespace strata::scenes {
namespace {

using nlohmann::json;

constexpr int most_levels = 64;

// Tracks the keys of the objects that the parser is in.
class OpenObjects {
  public:
    explicit OpenObjects(const std::string& file) : file_{file} {}

    // Returning false would drop a value; all are kept.
    bool operator()(int depth, json::parse_event_t event, const json& parsed) {
        if (depth > most_levels)
            throw InputError(file_, location(), "at most 64 levels of arrays and objects", "deeper nesting");
        if (event == json::parse_event_t::object_start) levels_.emplace_back();
        if (event == json::parse_event_t::object_end) levels_.pop_back();
        if (event == json::parse_event_t::key) enter(parsed.get<std::string>());
        return true;
    }

  private:
    struct Level {
        std::set<std::string> names;
        std::string last;
    };

    void enter(const std::string& name) {
        Level& level = levels_.back();
        level.last = name;
        if (!level.names.insert(name).second) throw InputError(file_, location(), "each key once", "this key twice");
    }

    // The path of keys of the enclosing objects; array positions are not known here.
    [[nodiscard]] std::string location() const {
        std::string text;
        for (const Level& level : levels_) text += "/" + level.last;
        return text.empty() ? "/" : text;
    }

    const std::string& file_;
    std::vector<Level> levels_;
};

// The library takes a NUL for the end of the text, and would ignore what follows.
void check_no_nul(const std::string& text, const std::string& file, const std::string& what) {
    const std::size_t at = text.find('\0');
    if (at != text.npos) throw InputError(file, "byte " + std::to_string(at + 1), what, "a NUL");
}

}  // namespace

// The library's own message is not used: it names no file and differs between its versions.
json parse_strict_json(const std::string& text, const std::string& file, const std::string& what) {
    OpenObjects keys{file};
    check_no_nul(text, file, what);
    check_json_memory(file, text.size());
    try {
        return json::parse(text, std::ref(keys));
    } catch (const json::parse_error& error) {
        throw InputError(file, "byte " + std::to_string(error.byte), what, "a syntax error");
    } catch (const json::exception&) {
        throw InputError(file, "/", what, "a number out of range");
    }
}

// Objects and arrays are not written out: dump recurses, which is unsafe if they are nested deeply.
std::string json_in_words(const json& value) {
    if (value.is_object()) return "an object";
    if (value.is_array()) return "an array of " + std::to_string(value.size());
    return value.dump(-1, ' ', true, json::error_handler_t::replace).substr(0, 64);
}

}  // namespace strata::scenes
