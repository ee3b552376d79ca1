// pipeline/stages/depth_compare.h - when a fragment lies behind a depth that an earlier pass stored: what peels in a
// program ask.
//
// Rule     The fragment's reference depth, quantised like a depth write unless `quantizes` is false, is behind if it is
//          greater than the stored code raised by `ulps` codes plus `absolute`. Without an epsilon and with a quantised
//          reference that is a comparison of codes. An unquantised reference is clamped to [0,1] first.
// Source   fragment-stages.md 6.2; keys-and-counts.md 4.2.
// Tests    tests/pipeline/stages/depth_compare_test.cpp
#pragma once
#include <algorithm>
#include <bit>
#include <cstdint>

#include "rasterizer/base/numerics.h"
#include "rasterizer/rules/depth_code.h"

namespace strata::pipeline {

// A program adds these to the stored depth before it compares: a part of the depth range, and a number of codes.
struct CompareEpsilon {
    // A part of the depth range, 0 to 1.
    double absolute = 0.0;
    // Codes of the buffer, 0 or more.
    int ulps = 0;
    friend bool operator==(const CompareEpsilon&, const CompareEpsilon&) = default;
};

inline namespace strict {

struct DepthCompare {
    rasterizer::DepthFormat format = rasterizer::DepthFormat::d32f;
    CompareEpsilon epsilon{};
    // Another path's depth is compared than is stored.
    bool has_reference = false;
    // The profile's raster.quantize_reference (depth.md 6.2).
    bool quantizes = true;

    // Only the fragment's own code is asked for: no reference array is needed.
    [[nodiscard]] bool is_plain() const noexcept { return !has_reference && quantizes && epsilon == CompareEpsilon{}; }

    // Whether codes are all that is compared: the reference's, and the stored one raised by `ulps`.
    [[nodiscard]] bool compares_codes() const noexcept { return quantizes && epsilon.absolute == 0.0; }

    // The stored code raised by `ulps`.
    [[nodiscard]] std::uint32_t raised(std::uint32_t stored) const noexcept {
        const std::uint64_t sum = std::uint64_t{stored} + static_cast<std::uint64_t>(epsilon.ulps);
        return static_cast<std::uint32_t>(std::min<std::uint64_t>(sum, rasterizer::max_code(format)));
    }
    // A code that lies behind wherever any does: D32F's may be beyond 1 where depths are not clamped.
    [[nodiscard]] std::uint32_t farthest_code() const noexcept {
        constexpr std::uint32_t infinity = 0x7f800000;
        return format == rasterizer::DepthFormat::d32f ? infinity : rasterizer::max_code(format);
    }
    // In the buffer's own units; exact.
    [[nodiscard]] double value(std::uint32_t code) const noexcept { return rasterizer::buffer_value(code, format); }
    // What is compared of a fragment, and what lies behind a stored code is greater than: codes as numbers, or values.
    [[nodiscard]] double own(std::uint32_t code, double z) const noexcept {
        if (compares_codes()) return code;
        return quantizes ? value(code) : std::min(z > 0.0 ? z : 0.0, rasterizer::buffer_units(format));
    }
    [[nodiscard]] double bound(std::uint32_t stored) const noexcept {
        if (compares_codes()) return raised(stored);
        return value(raised(stored)) + epsilon.absolute * rasterizer::buffer_units(format);
    }
    [[nodiscard]] bool is_behind(std::uint32_t code, double z, std::uint32_t stored) const noexcept {
        return compares_codes() ? code > raised(stored) : own(code, z) > bound(stored);
    }
    // What is compared of a fragment where depths are binary32 values and no codes.
    [[nodiscard]] double own(double z) const noexcept { return quantizes ? double{static_cast<float>(z)} : z; }
    // a > b of binary32 depths, b raised by the epsilon: `ulps` steps of its binary32 value, and `absolute`.
    [[nodiscard]] bool exceeds(double a, double b) const noexcept {
        const auto from = static_cast<float>(b);
        const auto steps = static_cast<std::uint32_t>(from > 0.0f ? epsilon.ulps : 0);
        const float to = std::bit_cast<float>(std::bit_cast<std::uint32_t>(from) + steps);
        return a > b + (double{to} - double{from}) + epsilon.absolute;
    }
    friend bool operator==(const DepthCompare&, const DepthCompare&) = default;
};

}  // namespace strict
}  // namespace strata::pipeline
