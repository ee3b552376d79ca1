// pipeline/formats/unorm8_product.h - 8-bit codes as devices read them that convert by binary32 products (UnormRounding::product_even).
//
// Rule     k * f32(1 / 255), rounded: for 126 of the 256 codes another float than k / 255.
// Source   formats.md 2.3; measured on llvmpipe: a front that dual reads back.
// Tests    tests/pipeline/region/region_test.cpp
#pragma once
#include <cstdint>

#include "rasterizer/base/numerics.h"

namespace strata::pipeline {
inline namespace strict {

[[nodiscard]] constexpr float unorm8_product(std::uint32_t code) noexcept {
    return static_cast<float>(static_cast<std::int32_t>(code)) * (1.0f / 255.0f);
}

}  // namespace strict
}  // namespace strata::pipeline
