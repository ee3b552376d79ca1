// pipeline/stages/depth_compare.h - decides whether a fragment is behind a depth that an earlier pass stored: the
// comparison of peels in a fragment program.
//
// Rule     The fragment's reference depth, quantized like a depth write unless `quantizes` is false, is behind if it is
//          greater than the stored code raised by `ulps` codes plus `absolute`. Without an epsilon and with a quantized
//          reference this is a comparison of codes. An unquantized reference is clamped to [0,1] first.
// Source   pipeline/reference/fragment-stages.md 6.2; peeling/reference/keys-and-counts.md 4.2.
// Tests    tests/pipeline/stages/depth_compare_test.cpp
#pragma once
#include <algorithm>
#include <bit>
#include <cstdint>

#include "rasterizer/base/numerics.h"
#include "rasterizer/rules/depth_code.h"

namespace strata::pipeline {

// A program adds these to the stored depth before it compares: a fraction of the depth range, and a number of codes.
struct CompareEpsilon {
    // A fraction of the depth range, 0 to 1.
    double absolute = 0.0;
    // Codes of the buffer, 0 or more.
    int ulps = 0;
    friend bool operator==(const CompareEpsilon&, const CompareEpsilon&) = default;
};

inline namespace strict {

struct DepthCompare {
    rasterizer::DepthFormat format = rasterizer::DepthFormat::d32f;
    CompareEpsilon epsilon{};
    // The compared depth is computed by another path than the stored one.
    bool has_reference = false;
    // The profile's raster.quantize_reference (rasterizer/reference/depth.md 6.2).
    bool quantizes = true;

    // True if only the fragment's own code is compared: no reference array is needed.
    [[nodiscard]] bool is_plain() const noexcept { return !has_reference && quantizes && epsilon == CompareEpsilon{}; }

    // True if only codes are compared: that of the reference, and the stored one raised by `ulps`.
    [[nodiscard]] bool compares_codes() const noexcept { return quantizes && epsilon.absolute == 0.0; }

    // The stored code raised by `ulps`.
    [[nodiscard]] std::uint32_t raised(std::uint32_t stored) const noexcept {
        const std::uint64_t sum = std::uint64_t{stored} + static_cast<std::uint64_t>(epsilon.ulps);
        return static_cast<std::uint32_t>(std::min<std::uint64_t>(sum, rasterizer::max_code(format)));
    }
    // A code that is behind every other code: D32F codes may exceed 1 if depths are not clamped.
    [[nodiscard]] std::uint32_t farthest_code() const noexcept {
        constexpr std::uint32_t infinity = 0x7f800000;
        return format == rasterizer::DepthFormat::d32f ? infinity : rasterizer::max_code(format);
    }
    // The exact value of a code in the buffer's own units.
    [[nodiscard]] double value(std::uint32_t code) const noexcept { return rasterizer::buffer_value(code, format); }
    // The quantity that is compared for a fragment; the fragment is behind if it is greater than that of the stored
    // code. Codes as numbers, or values.
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
    // The same if depths are binary32 values instead of codes.
    [[nodiscard]] double own(double z) const noexcept { return quantizes ? double{static_cast<float>(z)} : z; }
    // a > b for binary32 depths, where b is raised by the epsilon: by `ulps` steps of its binary32 value, and by
    // `absolute`.
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
