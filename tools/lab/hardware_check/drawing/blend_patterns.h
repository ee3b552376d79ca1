// tools/lab/hardware_check/drawing/blend_patterns.h - the patterns that suite Blend_surface blends into its surfaces,
// in seven texel formats.
//
// Rule     A word's fields are extended to 8 bits by repeating their upper bits; a missing alpha is 255. The wide
//          pattern has ramps in four equal quarters, the 16-bit one ramps over the whole; alpha decreases with the
//          squared distance from the centre. Binary32 arithmetic, truncated, as in the test.
// Source   the test's parameters (abaire/nxdk_pgraph_tests, MIT); pipeline/reference/chip-fragment.md 5.
// Tests    tests/tools/lab/hardware_check/hardware_digests.txt
#pragma once
#include <array>
#include <cstdint>

#include "pipeline/formats/texture.h"

namespace strata::hardware_check {

struct TexelField {
    int shift = 0, bits = 0;  // bits: 1, 4, 5, 6 or 8; 0: absent
};
struct TexelFormat {
    std::array<TexelField, 4> field;  // r g b a
    bool is_wide;                     // 32 bits per texel
};

// In the order of the test: A8B8G8R8, X8R8G8B8, R5G6B5, R6G5B5, X1R5G5B5, A1R5G5B5, A4R4G4B4.
inline constexpr std::array<TexelFormat, 7> blended_formats{{{{{{0, 8}, {8, 8}, {16, 8}, {24, 8}}}, true},
                                                             {{{{16, 8}, {8, 8}, {0, 8}, {0, 0}}}, true},
                                                             {{{{11, 5}, {5, 6}, {0, 5}, {0, 0}}}, false},
                                                             {{{{10, 6}, {5, 5}, {0, 5}, {0, 0}}}, false},
                                                             {{{{10, 5}, {5, 5}, {0, 5}, {0, 0}}}, false},
                                                             {{{{10, 5}, {5, 5}, {0, 5}, {15, 1}}}, false},
                                                             {{{{8, 4}, {4, 4}, {0, 4}, {12, 4}}}, false}}};

// Rectangle textures with nearest filtering.
[[nodiscard]] pipeline::Texture radial_pattern(const TexelFormat& format, int side);
[[nodiscard]] pipeline::Texture flat_pattern(const TexelFormat& format, int side, std::uint32_t word);

}  // namespace strata::hardware_check
