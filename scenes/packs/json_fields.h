// scenes/packs/json_fields.h - reads and writes an object of a manifest field by field, with one function for both.
//
// Rule     A function template `x_fields(io, x)` names every field once, for JsonWriter and for JsonReader.
//          Floating-point numbers are written as {"decimal": [...], "bits": ["..."]}. If the two disagree, or a field
//          is missing, unknown or of another type, JsonReader throws InputError with the file and the JSON pointer.
// Tests    tests/scenes/packs/json_fields_test.cpp
#pragma once
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "rasterizer/base/enum_values.h"

namespace strata::scenes {

class JsonWriter {
  public:
    nlohmann::ordered_json object = nlohmann::ordered_json::object();

    void flag(const std::string& key, bool value) { object[key] = value; }
    void text(const std::string& key, const std::string& value) { object[key] = value; }
    template <class Integer>
    void whole(const std::string& key, Integer value, Integer, Integer) {
        object[key] = value;
    }
    // Not every reader supports 64-bit JSON numbers.
    void text(const std::string& key, std::uint64_t value) { object[key] = std::to_string(value); }
    void texts(const std::string& key, const std::vector<std::string>& values) { object[key] = values; }
    void reals(const std::string& key, std::span<const float> values) { object[key] = both(values); }
    void reals(const std::string& key, std::span<const double> values) { object[key] = both(values); }
    template <class Real>
    void real(const std::string& key, const Real& value) {
        reals(key, std::span<const Real>{&value, 1});
    }
    template <class Enum>
    void choice(const std::string& key, const Enum& value, std::span<const std::string_view> names = enum_names<Enum>) {
        object[key] = names[static_cast<std::size_t>(value)];
    }
    // Writes null, or what `fill(io, key, value)` writes.
    template <class T, class Fill>
    void optional(const std::string& key, const std::optional<T>& value, Fill fill) {
        if (value)
            fill(*this, key, *value);
        else
            object[key] = nullptr;
    }
    // Omitted if empty.
    template <class T, class Write>
    void if_any(const std::string& key, const std::optional<T>& value, Write write) {
        if (value) write(*this, key, *value);
    }
    template <class T, class Fields>
    void nested(const std::string& key, const T& value, Fields fields) {
        JsonWriter inner;
        fields(inner, value);
        object[key] = std::move(inner.object);
    }
    template <class List, class Fields>
    void list(const std::string& key, const List& values, Fields fields) {
        object[key] = nlohmann::ordered_json::array();
        for (const auto& value : values) {
            JsonWriter inner;
            fields(inner, value);
            object[key].push_back(std::move(inner.object));
        }
    }

  private:
    [[nodiscard]] static nlohmann::ordered_json both(std::span<const float> values);
    [[nodiscard]] static nlohmann::ordered_json both(std::span<const double> values);
};

class JsonReader {
  public:
    // `value` and `file` must outlive the reader. InputError unless `value` is an object.
    JsonReader(const nlohmann::json& value, const std::string& file, std::string pointer);

    void flag(const std::string& key, bool& value);
    void text(const std::string& key, std::string& value);
    void text(const std::string& key, std::uint64_t& value);
    void texts(const std::string& key, std::vector<std::string>& values);
    template <class Integer>
    void whole(const std::string& key, Integer& value, Integer lowest, Integer highest) {
        value =
            static_cast<Integer>(number(key, static_cast<std::int64_t>(lowest), static_cast<std::int64_t>(highest)));
    }
    void reals(const std::string& key, std::span<float> values);
    void reals(const std::string& key, std::span<double> values);
    template <class Real>
    void real(const std::string& key, Real& value) {
        reals(key, std::span<Real>{&value, 1});
    }
    template <class Enum>
    void choice(const std::string& key, Enum& value, std::span<const std::string_view> names = enum_names<Enum>) {
        value = static_cast<Enum>(place_in(key, names));
    }
    template <class T, class Fill>
    void optional(const std::string& key, std::optional<T>& value, Fill fill) {
        if (is_null(key)) return value.reset();
        value.emplace();
        fill(*this, key, *value);
    }
    template <class T, class Fill>
    void if_any(const std::string& key, std::optional<T>& value, Fill fill) {
        if (!value_.contains(key)) return value.reset();
        fill(*this, key, value.emplace());
    }
    template <class T, class Fields>
    void nested(const std::string& key, T& value, Fields fields) {
        JsonReader inner{at(key), file_, pointer_ + "/" + key};
        fields(inner, value);
        inner.end();
    }
    template <class List, class Fields>
    void list(const std::string& key, List& values, Fields fields) {
        const nlohmann::json& array = array_at(key);
        for (std::size_t i = 0; i < array.size(); ++i) {
            JsonReader inner{array[i], file_, pointer_ + "/" + key + "/" + std::to_string(i)};
            values.emplace_back();
            fields(inner, values.back());
            inner.end();
        }
    }

    // The value of a required key, which is marked as read.
    [[nodiscard]] const nlohmann::json& at(const std::string& key);
    // Of an optional key.
    [[nodiscard]] bool has(const std::string& key);
    [[nodiscard]] bool is_null(const std::string& key) { return at(key).is_null(); }
    [[noreturn]] void fail(const std::string& key, const std::string& expected) const;
    [[nodiscard]] std::string pointer_of(const std::string& key) const { return pointer_ + "/" + key; }
    // InputError if there is a key that was not read.
    void end() const;

  private:
    [[nodiscard]] std::int64_t number(const std::string& key, std::int64_t lowest, std::int64_t highest);
    [[nodiscard]] std::size_t place_in(const std::string& key, std::span<const std::string_view> names);
    [[nodiscard]] const nlohmann::json& array_at(const std::string& key);

    const nlohmann::json& value_;
    const std::string& file_;
    std::string pointer_;
    std::set<std::string> read_{}, known_{};
};

}  // namespace strata::scenes
