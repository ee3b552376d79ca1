// rasterizer/base/require.h - what the doors of the library ask of the values that come in: fields, named as a program
// writes them.
//
// Rule     A door throws InputError{thing, field, expected, found} before anything is read by a number that it has not
//          checked.
#pragma once
#include <bit>
#include <concepts>
#include <cstdint>
#include <string>
#include <type_traits>

#include "rasterizer/base/enum_values.h"
#include "rasterizer/base/input_error.h"

namespace strata {

// A field, whose name is put together only when it is wrong: "width", "instances[3]", "meshes[2].indices".
class FieldName {
  public:
    FieldName(const char* name) noexcept : list_{name} {}  // NOLINT: a name is a field
    FieldName(const char* list, std::size_t item, const char* member = "") noexcept
        : list_{list}, member_{member}, item_{item} {}
    [[nodiscard]] std::string text() const {
        std::string text{list_};
        if (member_ == nullptr) return text;
        text += '[';
        text += std::to_string(item_);
        text += *member_ == 0 ? "]" : "].";
        return text += member_;
    }

  private:
    const char* list_;
    const char* member_ = nullptr;
    std::size_t item_ = 0;
};

// The values of one thing ("draw list").
class Requirements {
  public:
    explicit Requirements(const char* thing) : thing_{thing} {}

    // Throws unless low <= value <= high.
    template <std::integral Number>
    void within(const FieldName& field, Number value, std::type_identity_t<Number> low,
                std::type_identity_t<Number> high) const {
        if (value < low || value > high) fail(field, std::to_string(low) + " to " + std::to_string(high), value);
    }
    // Throws unless value < limit, where the limit is the size of the list that the value indexes.
    void below(const FieldName& field, std::uint64_t value, std::uint64_t limit) const {
        if (value >= limit) fail(field, "less than " + std::to_string(limit), value);
    }
    // Neither infinite nor NaN; bits, because a program may be compiled with fast-math.
    void finite(const FieldName& field, float value) const {
        if ((std::bit_cast<std::uint32_t>(value) & 0x7f800000u) == 0x7f800000u) fail(field, "a finite number", value);
    }
    // Throws if the number is no value of its enum; the message lists the names.
    template <class Enum>
    void listed(const FieldName& field, Enum value) const {
        if (is_listed(value)) return;
        std::string names;
        for (const std::string_view name : enum_names<Enum>) names += (names.empty() ? "" : ", ") + std::string{name};
        fail(field, "one of " + names, static_cast<int>(value));
    }
    // Throws for every other rule; `found` is the number that broke it.
    [[noreturn]] void fail(const FieldName& field, const std::string& expected, auto found) const {
        fail(field.text(), expected, found);
    }
    [[noreturn]] void fail(const std::string& field, const std::string& expected, auto found) const {
        throw InputError(thing_, field, expected, std::to_string(found));
    }

  private:
    const char* thing_;
};

}  // namespace strata
