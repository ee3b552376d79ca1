// scenes/gltf/document/json.cpp - parses the JSON text and checks types and ranges of values (json.h).
#include "scenes/gltf/document/json.h"

#include <set>

#include "scenes/memory_limit.h"

namespace strata::scenes {
namespace {

// A pass over the text before parsing: rejects deep nesting and repeated keys, which the parser itself accepts. (The
// parser's own callback takes quadratic time on long arrays of objects.)
class Guard {
  public:
    explicit Guard(const FileLocation& location) : location_{location} {}

    bool null() { return true; }
    bool boolean(bool) { return true; }
    bool number_integer(Json::number_integer_t) { return true; }
    bool number_unsigned(Json::number_unsigned_t) { return true; }
    bool number_float(Json::number_float_t, const Json::string_t&) { return true; }
    bool string(Json::string_t&) { return true; }
    bool binary(Json::binary_t&) { return true; }
    bool start_object(std::size_t) { return enter(); }
    bool start_array(std::size_t) { return enter(); }
    bool end_object() { return leave(); }
    bool end_array() { return leave(); }
    bool key(Json::string_t& name) {
        if (!keys_.back().insert(name).second)
            location_.fail("INVALID_JSON", "each key once in an object", in_quotes(name) + " twice");
        return true;
    }
    bool parse_error(std::size_t, const std::string&, const Json::exception& error) {
        const std::string_view what = error.what();  // "[json.exception.parse_error.101] parse error at line ..."
        location_.fail("INVALID_JSON", "JSON text", one_line(what.substr(what.find(' ') + 1)));
    }

  private:
    bool enter() {
        keys_.emplace_back();
        if (keys_.size() > max_json_depth)
            location_.fail("INVALID_JSON", "nesting at most " + std::to_string(max_json_depth) + " deep",
                           "deeper nesting");
        return true;
    }
    bool leave() {
        keys_.pop_back();
        return true;
    }

    const FileLocation& location_;
    std::vector<std::set<std::string>> keys_;  // of the open objects; the set of an array stays empty
};

std::string escaped(std::string_view key) {  // RFC 6901
    std::string out;
    for (const char c : one_line(key)) {
        if (c == '~')
            out += "~0";
        else if (c == '/')
            out += "~1";
        else
            out += c;
    }
    return out;
}

}  // namespace

Json parse_json(std::string_view text, const std::string& file) {
    const FileLocation location{file, ""};
    // The library takes a NUL for the end of the text, and would ignore what follows. Some exporters pad the JSON chunk
    // of a GLB with NULs instead of spaces: those at the end are dropped.
    const std::size_t last = text.find_last_not_of('\0');
    text = text.substr(0, last == text.npos ? 0 : last + 1);
    if (const std::size_t at = text.find('\0'); at != text.npos)
        location.fail("INVALID_JSON", "JSON", "a NUL at byte " + std::to_string(at + 1));
    check_json_memory(file, text.size());
    Guard guard{location};
    Json::sax_parse(text.begin(), text.end(), &guard);
    return Json::parse(text.begin(), text.end());
}

// Objects and arrays are not written out, so that the message stays short.
std::string JsonAt::shown() const {
    switch (json_->type()) {
        case Json::value_t::object: return "an object";
        case Json::value_t::array: return "an array of " + std::to_string(json_->size());
        case Json::value_t::string: return in_quotes(json_->get_ref<const std::string&>());
        default: return json_->dump();
    }
}

std::optional<JsonAt> JsonAt::find(const std::string& key) const {
    const auto found = object().json_->find(key);
    if (found == json_->end()) return std::nullopt;
    return JsonAt{*found, location_.under(escaped(key))};
}

JsonAt JsonAt::member(const std::string& key) const {
    if (auto found = find(key)) return *std::move(found);
    location_.fail("UNDEFINED_PROPERTY", "the property " + one_line(key), "none");
}

const JsonAt& JsonAt::object() const {
    if (!json_->is_object()) fail("TYPE_MISMATCH", "an object");
    return *this;
}

std::vector<JsonAt> JsonAt::elements() const {
    if (!json_->is_array()) fail("TYPE_MISMATCH", "an array");
    std::vector<JsonAt> all;
    all.reserve(json_->size());
    for (const Json& element : *json_) all.emplace_back(element, location_.under(all.size()));
    return all;
}

std::vector<JsonAt> JsonAt::elements(const std::string& key) const {
    const auto array = find(key);
    return array ? array->elements() : std::vector<JsonAt>{};
}

std::size_t JsonAt::size(const std::string& key) const {
    const auto array = find(key);
    if (!array) return 0;
    if (!array->json_->is_array()) array->fail("TYPE_MISMATCH", "an array");
    return array->json_->size();
}

// The readers of single values reject a value of another type.
bool JsonAt::boolean() const {
    if (!json_->is_boolean()) fail("TYPE_MISMATCH", "true or false");
    return json_->get<bool>();
}

double JsonAt::number() const {
    if (!json_->is_number()) fail("TYPE_MISMATCH", "a number");
    return json_->get<double>();
}

std::string JsonAt::string() const {
    if (!json_->is_string()) fail("TYPE_MISMATCH", "a string");
    return json_->get<std::string>();
}

std::uint64_t JsonAt::integer(std::uint64_t lo, std::uint64_t hi) const {
    if (!json_->is_number_integer()) fail("TYPE_MISMATCH", "an integer");
    const bool is_negative = !json_->is_number_unsigned();
    if (is_negative || json_->get<std::uint64_t>() < lo || json_->get<std::uint64_t>() > hi)
        fail("VALUE_NOT_IN_RANGE", "an integer from " + std::to_string(lo) + " to " + std::to_string(hi));
    return json_->get<std::uint64_t>();
}

std::size_t JsonAt::index(std::size_t count) const {
    if (!json_->is_number_integer()) fail("TYPE_MISMATCH", "an index");
    if (!json_->is_number_unsigned()) fail("INVALID_INDEX", "an index, not negative");
    const auto value = json_->get<std::uint64_t>();
    if (value >= count) fail("UNRESOLVED_REFERENCE", "an index below " + std::to_string(count));
    return value;
}

void JsonAt::numbers(std::size_t count) const {
    const auto all = elements();
    if (all.size() != count) fail("ARRAY_LENGTH_NOT_IN_LIST", "an array of " + std::to_string(count) + " numbers");
    for (const JsonAt& element : all)
        if (!element.json_->is_number()) element.fail("ARRAY_TYPE_MISMATCH", "a number");
}

}  // namespace strata::scenes
