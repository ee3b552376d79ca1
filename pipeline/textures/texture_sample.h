// pipeline/textures/texture_sample.h - colour lookups in 2D and rectangle textures.
//
// Rule     Addressing: texel_address.h. `single`: texels are converted to binary32 (k / 255, or the sRGB table), then
//          summed bilinearly in binary32. `unorm8`: the exact sum of the 8-bit texels is rounded once to 8 bits, half
//          up; with sRGB decoding the binary32 result is rounded to 8 bits instead, also that of a nearest lookup.
//          Alpha is never decoded. Linear interpolations: texel_lerps.h.
// Source   pipeline/reference/texturing.md 2 and 3.
// Numbers  unorm8: texel * weight <= 255 * 65536 and the weights add up to 65536: below 2^24 including the rounding
//          half.
// Tests    tests/pipeline/textures/texture_sample_test.cpp
#pragma once
#include <array>

#include "pipeline/device/profile.h"
#include "pipeline/formats/texture.h"
#include "rasterizer/coverage/fragment_batch.h"

namespace strata::pipeline {

// Writes r g b a at (s, t) to lanes [0, count). The texture must have width * height * 4 texel bytes.
void sample(const Texture& texture, TextureFilterPrecision precision, const rasterizer::Lanes<float>& s,
            const rasterizer::Lanes<float>& t, std::array<rasterizer::Lanes<float>, 4>& rgba, int count) noexcept;

}  // namespace strata::pipeline
