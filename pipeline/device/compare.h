// pipeline/device/compare.h - the eight comparison functions, selected once outside the loop (GL 2.1 4.1.4 to 4.1.6).
// Operands keep their order: `passes<less>(a, b)` is a < b. A NaN passes only `notequal` and `always`
// (pipeline/reference/fragment-stages.md 1.2).
#pragma once
#include <cstdint>
#include <type_traits>

#include "pipeline/device/state.h"
#include "pipeline/formats/lane_mask.h"

namespace strata::pipeline {

// a FUNC b. The function is a template argument, so that a loop over lanes has one comparison and no switch.
template <CompareFunc func, class T>
[[nodiscard]] constexpr bool passes(T a, T b) noexcept {
    if constexpr (func == CompareFunc::never) return false;
    if constexpr (func == CompareFunc::less) return a < b;
    if constexpr (func == CompareFunc::equal) return a == b;
    if constexpr (func == CompareFunc::lequal) return a <= b;
    if constexpr (func == CompareFunc::greater) return a > b;
    if constexpr (func == CompareFunc::notequal) return a != b;
    if constexpr (func == CompareFunc::gequal) return a >= b;
    return true;
}

// Calls body(std::integral_constant<CompareFunc, func>).
template <class Body>
void with_compare(CompareFunc func, Body&& body) {
    using enum CompareFunc;
    switch (func) {
        case never: return body(std::integral_constant<CompareFunc, never>{});
        case less: return body(std::integral_constant<CompareFunc, less>{});
        case equal: return body(std::integral_constant<CompareFunc, equal>{});
        case lequal: return body(std::integral_constant<CompareFunc, lequal>{});
        case greater: return body(std::integral_constant<CompareFunc, greater>{});
        case notequal: return body(std::integral_constant<CompareFunc, notequal>{});
        case gequal: return body(std::integral_constant<CompareFunc, gequal>{});
        case always: return body(std::integral_constant<CompareFunc, always>{});
    }
}

}  // namespace strata::pipeline
