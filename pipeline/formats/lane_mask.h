// pipeline/formats/lane_mask.h - yes and no as all ones and zero, and selections without control flow: what vector
// units want. A conditional expression over floats may become a branch (the unused side could raise a flag), and then
// no vectors.
#pragma once
#include <bit>
#include <cstdint>

namespace strata::pipeline {

// ~0 for yes, 0 for no.
[[nodiscard]] constexpr std::uint32_t mask(bool yes) noexcept { return 0u - static_cast<std::uint32_t>(yes); }

// a where the mask is ~0, b where it is 0.
[[nodiscard]] constexpr std::uint32_t select(std::uint32_t chosen, std::uint32_t a, std::uint32_t b) noexcept {
    return (a & chosen) | (b & ~chosen);
}

[[nodiscard]] constexpr float select(std::uint32_t chosen, float a, float b) noexcept {
    return std::bit_cast<float>(select(chosen, std::bit_cast<std::uint32_t>(a), std::bit_cast<std::uint32_t>(b)));
}

}  // namespace strata::pipeline
