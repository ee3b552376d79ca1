// pipeline/textures/texel_lerps.h - texture lookups with binary32 coordinates whose texels are mixed by linear
// interpolations: along s, then along t.
//
// Rule     Texels and weights are those of Mesa's drivers (texturing.md 2.5). Read as codes (code_lerps and
//          code_lerps_fused, if no axis mirrors and nothing is decoded): a, b become a + floor((w (b - a) + 128) /
//          256), times f32(1 / 255). Read as floats: a code's value is f32(code f32(1 / 255)), or that of srgb_mesa.h;
//          a, b become f32(a + f32(w f32(b - a))), or fma(w, f32(b - a), a) under code_lerps_fused.
// Source   pipeline/reference/texturing.md 2.5, 3.4 and 3.5.
// Tests    tests/pipeline/textures/texel_lerps_test.cpp
#pragma once
#include <array>

#include "pipeline/device/profile.h"
#include "pipeline/formats/texture.h"
#include "rasterizer/coverage/fragment_batch.h"

namespace strata::pipeline {

// Like `sample` (texture_sample.h), by one of the three rules.
void sample_lerps(const Texture& texture, TextureFilterPrecision rule, const rasterizer::Lanes<float>& s,
                  const rasterizer::Lanes<float>& t, std::array<rasterizer::Lanes<float>, 4>& rgba, int count) noexcept;

}  // namespace strata::pipeline
