// pipeline/formats/unorm8_product.h - the values of 8-bit codes on devices that convert by binary32 products.
//
// Rule     UnormRounding::product_even: k * f32(1 / 255), rounded; differs from k / 255 for 126 of the 256 codes.
//          product_even_wide: through 16 bits, 257 k * f32(1 / 65535), rounded; differs for 8 codes.
// Source   pipeline/reference/formats.md 2.3; measured on llvmpipe (a front target that dual peeling reads back) and on
//          SwiftShader.
// Tests    tests/pipeline/formats/unorm8_test.cpp, tests/pipeline/region/region_test.cpp
#pragma once
#include "pipeline/formats/unorm8.h"

namespace strata::pipeline {
inline namespace strict {

[[nodiscard]] constexpr float unorm8_product(std::uint32_t code) noexcept {
    return static_cast<float>(static_cast<std::int32_t>(code)) * (1.0f / 255.0f);
}
[[nodiscard]] constexpr float unorm8_wide(std::uint32_t code) noexcept {
    return static_cast<float>(static_cast<std::int32_t>(code)) * 257.0f * (1.0f / 65535.0f);
}

// The value of a code, as programs and binary32 blends read it.
template <UnormRounding rounding>
[[nodiscard]] constexpr float code_value(std::uint32_t code) noexcept {
    if constexpr (rounding == UnormRounding::product_even) return unorm8_product(code);
    if constexpr (rounding == UnormRounding::product_even_wide) return unorm8_wide(code);
    return unorm8_value(code);
}
[[nodiscard]] constexpr float code_value(std::uint32_t code, UnormRounding rounding) noexcept {
    using enum UnormRounding;
    switch (rounding) {
        case half_up: return code_value<half_up>(code);
        case product_even: return code_value<product_even>(code);
        case product_even_wide: break;
    }
    return code_value<product_even_wide>(code);
}

}  // namespace strict
}  // namespace strata::pipeline
