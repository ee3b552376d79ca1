// pipeline/stages/blend.h - blends a fragment's colour into its render target.
//
// Rule     R = s F + d G, s F - d G, d G - s F, min(s, d) or max(s, d); MIN and MAX ignore the factors. RGB and alpha
//          have separate terms. Without an alpha channel, destination alpha is 1. With blending off the source replaces
//          the destination, converted once. The arithmetic of 8-bit targets is in blend_unorm8.h, that of fp16 and
//          binary32 targets in blend_float.h. A packed target (packed.h) is blended as binary32: its codes are read as
//          values, so that sRGB colours are blended in linear light, and the result is rounded to codes once. Where
//          codes are those of 0 to 1, source and constant are clamped before.
// Source   pipeline/reference/fragment-stages.md 8 and 9 (GL 2.1 4.1.8 and table 4.1; D3D 11.3 17.1 and 17.5; packed:
//          GL 4.6 core 17.3.6, D3D 11.3 17.6).
// Cost     Terms that papers use run in one loop (blend_kernels.h), compiled once per instruction set; the others first
//          fill two arrays of factors.
// Tests    tests/pipeline/stages/blend_unorm8_test.cpp, tests/pipeline/stages/blend_float_test.cpp,
//          tests/pipeline/stages/simd_stages_test.cpp, tests/pipeline/stages/blend_packed_test.cpp,
//          tests/pipeline/stages/logic_op_test.cpp, tests/pipeline/stages/dither_test.cpp
#pragma once
#include <array>
#include <cstdint>

#include "pipeline/device/profile.h"
#include "pipeline/device/state.h"
#include "pipeline/formats/format.h"
#include "rasterizer/coverage/fragment_batch.h"

namespace strata::pipeline {

// Updates codes[c] for c < channels if the write mask has bit c, in all lanes i < count (and up to the next multiple of
// 16, as scratch); the caller stores the alive ones. All four channels of `src` are used, whatever the target stores: a
// two-channel target may blend by source alpha.
void blend(const Blend& state, ChannelType type, const DeviceProfile& profile, int channels,
           const std::array<rasterizer::Lanes<float>, 4>& src, std::array<rasterizer::Lanes<std::uint32_t>, 4>& codes,
           int count) noexcept;

// The blend of a target of this format, packed or not; a narrow one stores its codes by narrow.h afterwards.
void blend_into(Format format, const Blend& state, const DeviceProfile& profile,
                const std::array<rasterizer::Lanes<float>, 4>& src,
                std::array<rasterizer::Lanes<std::uint32_t>, 4>& codes, int count) noexcept;

// The window position of each lane, and the codes that the target had.
struct DitherLanes {
    const rasterizer::Lanes<std::uint16_t>&x, &y;
    const std::array<rasterizer::Lanes<std::uint32_t>, 4>& stored;
};

// What follows blending on fixed-point targets: dithering, the bits of narrow surfaces, the logical operation. `codes`
// are those of blend_into.
void finish_codes(Format format, const Blend& state, const std::array<rasterizer::Lanes<float>, 4>& src,
                  const DitherLanes& at, std::array<rasterizer::Lanes<std::uint32_t>, 4>& codes, int count) noexcept;

}  // namespace strata::pipeline
