// peeling/truth/real_texture.h - reference texture sampling in binary64 (nearest or bilinear), without the hardware's
// fixed-point filter weights.
//
// Rule     As texel_address.h and texture_sample.h in pipeline/textures, but filter weights are not quantized to 1/256.
//          Nearest: texel floor(u). Linear: texels floor(u - 1/2) and the next one, weighted by frac(u - 1/2); the same
//          along v. A texel channel is code / 255, or for sRGB textures the binary32 entry of srgb_to_linear (alpha
//          stays code / 255).
// Tests    tests/peeling/truth/truth_test.cpp
#pragma once
#include <array>

#include "pipeline/formats/texture.h"

namespace strata::peeling {

[[nodiscard]] std::array<double, 4> unquantized_sample(const pipeline::Texture& texture, double s, double t) noexcept;

}  // namespace strata::peeling
