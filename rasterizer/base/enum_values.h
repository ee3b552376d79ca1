// rasterizer/base/enum_values.h - the values of an enum and their names, taken from the compiler, so that no list has
// to be maintained by hand.
//
// Rule     An enum of this project numbers its values 0, 1, 2 ... The compiler prints a value by name if the enum has a
//          constant of that number, else as a cast; the first cast ends the list. The name of a value is its
//          identifier.
// Source   __PRETTY_FUNCTION__ of GCC and Clang names template arguments.
// Tests    tests/rasterizer/base/enum_values_test.cpp, tests/pipeline/device/enum_lists_test.cpp
#pragma once
#include <array>
#include <cstddef>
#include <optional>
#include <string_view>
#include <utility>

namespace strata {
namespace enum_values_detail {

// "nearest_even" for rasterizer::Snap::nearest_even; empty for a number without a name.
template <auto value>
[[nodiscard]] consteval const char* spelling() {
    return __PRETTY_FUNCTION__;
}
template <auto value>
[[nodiscard]] consteval std::string_view identifier() {
    constexpr std::string_view start = "value = ";
    std::string_view text = spelling<value>();
    text.remove_prefix(text.find(start) + start.size());
    text = text.substr(0, text.find_first_of(";]"));
    // A cast ends in its number, as in "(strata::Snap)7". A bracket alone is not enough: Clang writes "(anonymous
    // namespace)::".
    const bool is_cast =
        text.back() >= '0' && text.back() <= '9' && text.find_last_not_of("0123456789") == text.rfind(')');
    return is_cast ? std::string_view{} : text.substr(text.rfind(':') + 1);
}

// Number of values of an enum: the first number from 0 on for which the compiler has no name. A gap in the numbers
// would end the list there, so no enum of this project has one.
template <class Enum, std::size_t number = 0>
[[nodiscard]] consteval std::size_t count() {
    if constexpr (identifier<static_cast<Enum>(number)>().empty())
        return number;
    else
        return count<Enum, number + 1>();
}

template <class Enum, std::size_t... number>
[[nodiscard]] consteval auto values(std::index_sequence<number...>) {
    return std::array<Enum, sizeof...(number)>{static_cast<Enum>(number)...};
}
template <class Enum, std::size_t... number>
[[nodiscard]] consteval auto names(std::index_sequence<number...>) {
    return std::array<std::string_view, sizeof...(number)>{identifier<static_cast<Enum>(number)>()...};
}

}  // namespace enum_values_detail

// Every value of an enum in numeric order, as a std::array<Enum, n>.
template <class Enum>
inline constexpr auto enum_values =
    enum_values_detail::values<Enum>(std::make_index_sequence<enum_values_detail::count<Enum>()>{});

// The identifiers, in the order of enum_values.
template <class Enum>
inline constexpr auto enum_names =
    enum_values_detail::names<Enum>(std::make_index_sequence<enum_values_detail::count<Enum>()>{});

// The identifier of a value; empty if the enum has no such value.
template <class Enum>
[[nodiscard]] constexpr std::string_view enum_name(Enum value) noexcept {
    const auto number = static_cast<std::size_t>(value);
    return number < enum_names<Enum>.size() ? enum_names<Enum>[number] : std::string_view{};
}

// True if a number read from outside is a value of its enum.
template <class Enum>
[[nodiscard]] constexpr bool is_listed(Enum value) noexcept {
    return static_cast<std::size_t>(value) < enum_values<Enum>.size();
}

// The value with that identifier (case-sensitive); empty if the enum has none.
template <class Enum>
[[nodiscard]] constexpr std::optional<Enum> enum_named(std::string_view name) noexcept {
    for (std::size_t i = 0; i < enum_names<Enum>.size(); ++i)
        if (enum_names<Enum>[i] == name) return enum_values<Enum>[i];
    return std::nullopt;
}

}  // namespace strata
