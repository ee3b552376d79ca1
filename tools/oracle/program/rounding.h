// tools/oracle/program/rounding.h - how a port rounds while it composites, as a value, and what it stores.
//
// Rule     An emulation makes every rounding of one port: of its layers, of the accumulator after each blend, of the
//          transmittance, and of the result. `once` composites exactly and rounds the result.
// Source   GL 4.6 2.3.5 (normalised integers), 17.3.6 (blending); pipeline/reference/fragment-stages.md 8.
// Tests    tests/tools/oracle/program/parts_test.cpp
#pragma once
#include <algorithm>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "tools/oracle/rounding/storage_rounding.h"

namespace strata::oracle::program {

enum class PortFormat : std::uint8_t { exact, unorm8, unorm10, unorm16, half };

[[nodiscard]] constexpr double codes_of(PortFormat format) noexcept {
    switch (format) {
        case PortFormat::unorm8: return 255;
        case PortFormat::unorm10: return 1023;
        case PortFormat::unorm16: return 65535;
        case PortFormat::half: return 0x1p11;
        case PortFormat::exact: break;
    }
    return 0x1p18;
}
[[nodiscard]] constexpr double step_of(PortFormat format) noexcept { return 1 / codes_of(format); }

// The value as it is stored. Integers are clamped to [0, 1].
[[nodiscard]] inline double stored(PortFormat format, double v, bool truncates = false) noexcept {
    using verdict::StorageRounding;
    if (format == PortFormat::exact) return v;
    if (format == PortFormat::half) return StorageRounding::nearest_half(v);
    const double scale = codes_of(format), code = std::clamp(v, 0.0, 1.0) * scale;
    return StorageRounding::floor_of(code + (truncates ? 1e-9 : 0.5)) / scale;
}

enum class BlendForm : std::uint8_t {
    once,         // exactly
    over,         // back to front
    under,        // front to back with the transmittance
    under_alpha,  // front to back with the alpha reached
    both_ends     // the near half UNDER, the far half OVER what is behind
};

struct PortRounding {
    BlendForm form = BlendForm::once;
    PortFormat blend = PortFormat::exact;   // of the accumulator
    PortFormat weight = PortFormat::exact;  // of the transmittance
    PortFormat layers = PortFormat::exact;  // of layers before they are blended
    bool premultiplies = false;             // layers are stored multiplied by alpha
    bool splits = false;                    // the two products of a blend are rounded before they are added
    bool truncates = false;                 // accumulator and result
    PortFormat result = PortFormat::exact;
    friend bool operator==(const PortRounding&, const PortRounding&) = default;
    [[nodiscard]] double kept(double v) const noexcept { return stored(blend, v, truncates); }
    [[nodiscard]] double weighed(double v) const noexcept { return stored(weight, v, truncates); }
};

// The roundings that are tried for a picture of this format; the first one rounds once.
[[nodiscard]] std::vector<PortRounding> roundings(PortFormat format);
[[nodiscard]] std::string describe(const PortRounding& rounding);
// The narrowest format that holds all values.
[[nodiscard]] PortFormat narrowest(std::span<const double> values);

}  // namespace strata::oracle::program
