// pipeline/geforce3/texture_environment.h - OpenGL's texture environment, expressed through the register combiners.
//
// Rule     One general stage per unit, in order of the units; Cf, Af is the primary colour for the first unit, then the
//          result of the previous stage. REPLACE Ct; MODULATE Cf Ct; DECAL Cf (1 - At) + Ct At; BLEND Cf (1 - Ct) + Cc
//          Ct; ADD Cf + Ct; alpha At, Af At, Af, Af At, Af At. COMBINE: REPLACE a; MODULATE a b; ADD a + b; ADD_SIGNED
//          a + b - 1/2; INTERPOLATE a c + b (1 - c); SUBTRACT a - b; times 1, 2 or 4. Textures are treated as RGBA.
//          GL_NONE passes Cf, Af through.
// Source   GL 1.2.1 3.8.9 (table 3.22); ARB_texture_env_add; ARB_texture_env_combine. The arithmetic is combiner.h's.
// Tests    tests/pipeline/geforce3/texture_environment_test.cpp
#pragma once
#include <array>
#include <span>

#include "pipeline/geforce3/combiner.h"

namespace strata::pipeline {

// GL_TEXTURE_ENV_MODE; `none` passes Cf and Af through, `combine` uses the two CombineStates below.
enum class TexEnvMode : std::uint8_t { none, replace, modulate, decal, blend, add, combine };
enum class CombineFunc : std::uint8_t { replace, modulate, add, add_signed, interpolate, subtract };
enum class CombineSource : std::uint8_t { texture, constant, primary_color, previous };
enum class CombineOperand : std::uint8_t { src_color, one_minus_src_color, src_alpha, one_minus_src_alpha };

struct CombineArgument {
    CombineSource source = CombineSource::texture;
    // For alpha only src_alpha or one_minus_src_alpha.
    CombineOperand operand = CombineOperand::src_color;
    friend bool operator==(const CombineArgument&, const CombineArgument&) = default;
};

// GL_COMBINE of colours or of alpha: a function of up to three arguments, times a factor.
struct CombineState {
    CombineFunc func = CombineFunc::modulate;
    std::array<CombineArgument, 3> argument{};
    // 1, 2 or 4: GL_RGB_SCALE and GL_ALPHA_SCALE have no factor of a half.
    CombinerScale scale = CombinerScale::by_one;
    friend bool operator==(const CombineState&, const CombineState&) = default;
};

struct TexEnv {
    TexEnvMode mode = TexEnvMode::none;
    Rgba color{0, 0, 0, 0};  // TEXTURE_ENV_COLOR
    // Used only by `combine`.
    CombineState rgb, alpha;
    friend bool operator==(const TexEnv&, const TexEnv&) = default;
};

// The combiners of up to four units, in order; units with `none` have no stage.
[[nodiscard]] Combiners texture_environment(std::span<const TexEnv> units);

// The combiners of shadow-map peeling: colour is unchanged, alpha becomes (1 - comparison) times alpha. `unit` has the
// comparison as luminance or intensity. pipeline/reference/combiners.md 4.2: published ports of Everitt's demo.
[[nodiscard]] Combiners peel_combiners(std::size_t unit);

}  // namespace strata::pipeline
