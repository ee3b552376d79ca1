// peeling/programs/under.h - under_text-inl.h for single lanes.
// Tests: tests/peeling/programs/programs_test.cpp, tests/peeling/loops/block_passes_test.cpp
#pragma once
#include <cstdint>

#include "rasterizer/base/numerics.h"

namespace strata::peeling {

enum class FrontAlpha : std::uint8_t { covers, lets_through };  // the meaning of a front's alpha

inline namespace strict {
namespace scalar {

struct OneFloat {
    static constexpr float all(float v) noexcept { return v; }
};

#include "peeling/programs/under_text-inl.h"

// The transmittance of a front, from its alpha: 1 - alpha where alpha is coverage, else alpha itself.
[[nodiscard]] inline float through_front(FrontAlpha meaning, float alpha) noexcept {
    return meaning == FrontAlpha::covers ? let_through(OneFloat{}, alpha) : alpha;
}

// The alpha of a front of transmittance `through` over alpha `behind`: 1 - through (1 - behind), which is 1 if `behind`
// is 1.
[[nodiscard]] constexpr float alpha_over(float through, float behind) noexcept {
    return behind == 1.0f ? 1.0f : 1.0f - through * (1.0f - behind);
}

}  // namespace scalar
}  // namespace strict
}  // namespace strata::peeling
