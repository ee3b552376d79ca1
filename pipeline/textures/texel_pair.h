// pipeline/textures/texel_pair.h - the two texels of one axis between which a lookup by lerps lies, as Mesa's drivers
// find them.
//
// Source   pipeline/reference/texturing.md 2.5 (measured; gallivm/lp_bld_sample_soa.c, softpipe/sp_tex_sample.c).
// Tests    tests/pipeline/textures/texel_lerps_test.cpp
#pragma once
#include "pipeline/textures/texel_address.h"

namespace strata::pipeline {

// Two texels along an axis, and the weight of the second: in units of 1/256 if texels are mixed as codes.
struct TexelPair {
    std::int32_t first = 0, second = 0, weight_256 = 0;
    float weight = 0;
};

// llvmpipe has two ways: codes of RGBA8 that repeat or clamp on both axes, and floats for everything else.
enum class LerpAddress : std::uint8_t { codes, floats, softpipe };

// `coordinate` may be any value: NaN is treated as 0, values beyond +-2^31 as +-2^31.
[[nodiscard]] TexelPair texel_pair(const TexelAxis& axis, LerpAddress address, TextureFilter filter,
                                   float coordinate) noexcept;

}  // namespace strata::pipeline
