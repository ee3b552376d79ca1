// pipeline/textures/texel_lerps.h - texture lookups with binary32 coordinates whose texels are mixed by linear
// interpolations: along s, then along t.
//
// Rule     u = f32(c size), where c is the coordinate; under code_lerps c is its fraction if the axis repeats and its
//          size is not a power of two. Nearest: texel floor(u). code_lerps: p = nearest_even(256 u) - 128, texel p >>
//          8, weight p & 255 of the next one; codes a, b become a + floor((w (b - a) + 128) / 256). single_lerps: v =
//          f32(u - 1/2), with u clamped to [1/2, size - 1/2] under clamp to edge; texel floor(v), weight w = v -
//          floor(v); values a, b become f32(a + f32(w f32(b - a))). A code's value is f32(code f32(1 / 255)).
// Source   pipeline/reference/texturing.md 2.5 and 3.4.
// Tests    tests/pipeline/textures/texel_lerps_test.cpp
#pragma once
#include <array>

#include "pipeline/device/profile.h"
#include "pipeline/formats/texture.h"
#include "rasterizer/coverage/fragment_batch.h"

namespace strata::pipeline {

// Like `sample` (texture_sample.h), by one of the two rules.
void sample_lerps(const Texture& texture, TextureFilterPrecision rule, const rasterizer::Lanes<float>& s,
                  const rasterizer::Lanes<float>& t, std::array<rasterizer::Lanes<float>, 4>& rgba, int count) noexcept;

}  // namespace strata::pipeline
