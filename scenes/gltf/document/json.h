// scenes/gltf/document/json.h - parses JSON text into a tree that is safe to traverse; JsonAt is a value with its JSON
// pointer.
//
// Rule     Nesting is at most 100 deep, a key occurs once in its object, numbers are finite, text is UTF-8.
//          An integer must be written without a fraction: 3.0 is not an index.
// Tests    tests/scenes/gltf/gltf_bad_document_test.cpp
#pragma once
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scenes/gltf/document/file_location.h"

namespace strata::scenes {

using Json = nlohmann::json;

// Deep enough for any glTF document; without a limit a recursive traversal could exhaust the stack.
inline constexpr std::size_t max_json_depth = 100;

[[nodiscard]] Json parse_json(std::string_view text, const std::string& file);

// A value of the tree. Every accessor checks the type first and throws InputError with the JSON pointer.
class JsonAt {
  public:
    JsonAt(const Json& json, FileLocation location) : json_{&json}, location_{std::move(location)} {}

    [[nodiscard]] const FileLocation& location() const { return location_; }
    [[nodiscard]] const Json& json() const { return *json_; }
    [[nodiscard]] std::string shown() const;  // the value in short form, for the `found` part of an error

    // has() and find() are for members that may be absent; a member with the value null is present.
    [[nodiscard]] bool has(const std::string& key) const { return json_->is_object() && json_->contains(key); }
    [[nodiscard]] std::optional<JsonAt> find(const std::string& key) const;  // empty if the member is absent
    [[nodiscard]] JsonAt member(const std::string& key) const;               // if absent: UNDEFINED_PROPERTY

    [[nodiscard]] const JsonAt& object() const;          // *this, if it is an object
    [[nodiscard]] std::vector<JsonAt> elements() const;  // of an array
    [[nodiscard]] std::vector<JsonAt> elements(
        const std::string& key) const;                             // of an array that may be absent: then empty
    [[nodiscard]] std::size_t size(const std::string& key) const;  // of an array that may be absent

    [[nodiscard]] bool boolean() const;
    [[nodiscard]] double number() const;
    [[nodiscard]] std::string string() const;
    [[nodiscard]] std::uint64_t integer(std::uint64_t lo, std::uint64_t hi) const;  // else VALUE_NOT_IN_RANGE
    [[nodiscard]] std::size_t index(std::size_t count) const;                       // else UNRESOLVED_REFERENCE
    void numbers(std::size_t count) const;                                          // an array of `count` numbers

    [[noreturn]] void fail(std::string_view code, const std::string& expected) const {
        location_.fail(code, expected, shown());
    }

  private:
    const Json* json_;
    FileLocation location_;
};

}  // namespace strata::scenes
