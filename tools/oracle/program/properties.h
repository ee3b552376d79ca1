// tools/oracle/program/properties.h - the properties of a fragment and of a pixel on which a mistake may depend: one
// table.
//
// Rule     A property is a number; flags are 0 and 1. Properties of a pixel are also known where it has no fragments.
//          The price is in bits: plain properties are cheap, so that of conditions that select the same fragments the
//          plainest is told.
// Tests    tests/tools/oracle/program/parts_test.cpp
#pragma once
#include <cstdint>
#include <span>
#include <string_view>

#include "tools/oracle/program/lists.h"

namespace strata::oracle::program {

struct FragmentProperty {
    enum class Kind : std::uint8_t { number, integer, flag };

    std::string_view name;  // "alpha"; of a flag the words if it is 1: "back faces"
    std::string_view no{};  // of a flag, the words if it is 0
    Kind kind = Kind::number;
    bool is_of_pixel = false;
    double price = 5;
    double (*of)(const ListPixel& pixel, std::size_t k);  // k: the fragment; not used by properties of a pixel
    bool is_rounded = false;  // a port rounds it in every blend: near a threshold it may hold or not
};

[[nodiscard]] std::span<const FragmentProperty> properties();

// A property compared with a number.
struct Condition {
    enum class Is : std::uint8_t { equal, below, at_least };

    const FragmentProperty* property = nullptr;
    Is is = Is::equal;
    double threshold = 0;
    [[nodiscard]] bool holds(double v) const noexcept {
        return is == Is::equal ? v == threshold : is == Is::below ? v < threshold : v >= threshold;
    }
    [[nodiscard]] bool holds(const ListPixel& pixel, std::size_t k) const { return holds(property->of(pixel, k)); }
    friend bool operator==(const Condition&, const Condition&) = default;
};

}  // namespace strata::oracle::program
