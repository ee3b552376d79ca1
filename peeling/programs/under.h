// peeling/programs/under.h - under_text-inl.h for a lane at a time.
// Tests: tests/peeling/programs/programs_test.cpp, tests/peeling/closed/columns_test.cpp
#pragma once
#include "rasterizer/base/numerics.h"

namespace strata::peeling {
inline namespace strict {
namespace scalar {

struct OneFloat {
    static constexpr float all(float v) noexcept { return v; }
};

#include "peeling/programs/under_text-inl.h"

}  // namespace scalar
}  // namespace strict
}  // namespace strata::peeling
