// rasterizer/base/require.h - what the doors of the library ask of the values that come in: fields, named as a program writes them.
//
// Rule     A door throws InputError{thing, field, expected, found} before anything is read by a number that it has not checked.
#pragma once
#include <bit>
#include <concepts>
#include <cstdint>
#include <string>
#include <type_traits>

#include "rasterizer/base/enum_values.h"
#include "rasterizer/base/input_error.h"

namespace strata {

// The values of one thing ("draw list"); a field's name is made only when it is wrong.
class Requirements {
  public:
    explicit Requirements(const char* thing) : thing_{thing} {}

    template <std::integral Number>
    void within(const std::string& field, Number value, std::type_identity_t<Number> low,
                std::type_identity_t<Number> high) const {
        if (value < low || value > high) fail(field, std::to_string(low) + " to " + std::to_string(high), value);
    }
    void below(const std::string& field, std::uint64_t value, std::uint64_t limit) const {
        if (value >= limit) fail(field, "less than " + std::to_string(limit), value);
    }
    // Neither infinite nor NaN; bits, because a program may be compiled with fast-math.
    void finite(const std::string& field, float value) const {
        if ((std::bit_cast<std::uint32_t>(value) & 0x7f800000u) == 0x7f800000u) fail(field, "a finite number", value);
    }
    template <class Enum>
    void listed(const std::string& field, Enum value) const {
        if (is_listed(value)) return;
        std::string names;
        for (const std::string_view name : enum_names<Enum>) names += (names.empty() ? "" : ", ") + std::string{name};
        fail(field, "one of " + names, static_cast<int>(value));
    }
    [[noreturn]] void fail(const std::string& field, const std::string& expected, auto found) const {
        throw InputError(thing_, field, expected, std::to_string(found));
    }

  private:
    const char* thing_;
};

[[nodiscard]] inline std::string item(const char* list, std::size_t i) {
    return std::string{list} + "[" + std::to_string(i) + "]";
}

}  // namespace strata
