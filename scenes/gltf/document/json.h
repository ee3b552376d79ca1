// scenes/gltf/document/json.h - JSON text to a tree that is safe to walk, and a cursor that knows where it stands.
//
// Rule     Nesting is at most 100 deep, a key occurs once in its object, numbers are finite, text is UTF-8.
//          An integer is written as one: 3.0 is no index.
// Tests    tests/scenes/gltf/gltf_bad_document_test.cpp
#pragma once
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scenes/gltf/document/place.h"

namespace strata::scenes {

using Json = nlohmann::json;

// Deep enough for any document of glTF; without a limit a recursive walk over the tree could exhaust the stack.
inline constexpr std::size_t max_json_depth = 100;

[[nodiscard]] Json parse_json(std::string_view text, const std::string& file);

// A value of the tree. Every reader checks before it answers and throws InputError with the JSON pointer.
class JsonAt {
  public:
    JsonAt(const Json& json, Place place) : json_{&json}, place_{std::move(place)} {}

    [[nodiscard]] const Place& place() const { return place_; }
    [[nodiscard]] const Json& json() const { return *json_; }
    [[nodiscard]] std::string shown() const;  // the value in a few words, for `found`

    // has() and find() answer for a member that may be absent; a key with the value null is there.
    [[nodiscard]] bool has(const std::string& key) const { return json_->is_object() && json_->contains(key); }
    [[nodiscard]] std::optional<JsonAt> find(const std::string& key) const;  // an absent member is nothing
    [[nodiscard]] JsonAt member(const std::string& key) const;               // an absent member is UNDEFINED_PROPERTY

    [[nodiscard]] const JsonAt& object() const;          // itself, if it is one
    [[nodiscard]] std::vector<JsonAt> elements() const;  // of an array
    [[nodiscard]] std::vector<JsonAt> elements(
        const std::string& key) const;                             // of an array that may be absent: then none
    [[nodiscard]] std::size_t size(const std::string& key) const;  // of an array that may be absent

    [[nodiscard]] bool boolean() const;
    [[nodiscard]] double number() const;
    [[nodiscard]] std::string string() const;
    [[nodiscard]] std::uint64_t integer(std::uint64_t lo, std::uint64_t hi) const;  // else VALUE_NOT_IN_RANGE
    [[nodiscard]] std::size_t index(std::size_t count) const;                       // else UNRESOLVED_REFERENCE
    void numbers(std::size_t count) const;                                          // an array of `count` numbers

    [[noreturn]] void fail(std::string_view code, const std::string& expected) const {
        place_.fail(code, expected, shown());
    }

  private:
    const Json* json_;
    Place place_;
};

}  // namespace strata::scenes
