// peeling/truth/real_texture.h - a texture lookup without rounding: the texel or the bilinear sum at a binary64
// coordinate.
//
// Rule     texel_address.h and texture_sample.h without 256ths: nearest is texel floor(u); linear weighs the two texels
//          about u - 1/2 by the fraction itself. Texels are k / 255, or the binary32 of the sRGB table.
// Tests    tests/peeling/truth/truth_test.cpp
#pragma once
#include <array>

#include "pipeline/formats/texture.h"

namespace strata::peeling {

[[nodiscard]] std::array<double, 4> real_sample(const pipeline::Texture& texture, double s, double t) noexcept;

}  // namespace strata::peeling
