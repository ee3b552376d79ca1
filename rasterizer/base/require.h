// rasterizer/base/require.h - checks of the values that enter the library through its public functions. Fields are
// named as a program writes them.
//
// Rule     A public function throws InputError{thing, field, expected, found} before a value is used as an index, size
//          or enum that has not been checked.
#pragma once
#include <bit>
#include <concepts>
#include <cstdint>
#include <string>
#include <type_traits>

#include "rasterizer/base/enum_values.h"
#include "rasterizer/base/input_error.h"

namespace strata {

// The name of a field, composed only if the check fails: "width", "instances[3]", "meshes[2].indices".
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

// Checks of the fields of one thing, whose name begins the message ("draw list").
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
    // Throws if the value is infinite or NaN. Tests its bits, because the program may be compiled with -ffast-math.
    void finite(const FieldName& field, float value) const {
        if ((std::bit_cast<std::uint32_t>(value) & 0x7f800000u) == 0x7f800000u) fail(field, "a finite number", value);
    }
    // Throws if the number is not a value of its enum; the message lists the names.
    template <class Enum>
    void listed(const FieldName& field, Enum value) const {
        if (is_listed(value)) return;
        std::string names;
        for (const std::string_view name : enum_names<Enum>) names += (names.empty() ? "" : ", ") + std::string{name};
        fail(field, "one of " + names, static_cast<int>(value));
    }
    // Throws, for all other rules; `found` is the offending number.
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
