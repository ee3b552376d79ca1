// pipeline/formats/lane_mask.h - booleans as all ones and zero, and selection without control flow, so that loops
// vectorize. The compiler may turn a conditional expression over floats into a branch (the unused side could raise a
// flag), which prevents vectorization.
#pragma once
#include <bit>
#include <cstdint>

namespace strata::pipeline {

// ~0 for true, 0 for false.
[[nodiscard]] constexpr std::uint32_t mask(bool yes) noexcept { return 0u - static_cast<std::uint32_t>(yes); }

// a if the mask is ~0, b if it is 0.
[[nodiscard]] constexpr std::uint32_t select(std::uint32_t chosen, std::uint32_t a, std::uint32_t b) noexcept {
    return (a & chosen) | (b & ~chosen);
}

[[nodiscard]] constexpr float select(std::uint32_t chosen, float a, float b) noexcept {
    return std::bit_cast<float>(select(chosen, std::bit_cast<std::uint32_t>(a), std::bit_cast<std::uint32_t>(b)));
}

}  // namespace strata::pipeline
