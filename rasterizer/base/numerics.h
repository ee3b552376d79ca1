// rasterizer/base/numerics.h - the floating-point rules on which every bit of a result depends. Every header with
// arithmetic includes this one.
//
// Rule     IEEE 754 binary32 and binary64, round to nearest even, each operation rounded once: no contraction into
//          fused multiply-add, no excess precision, no reassociation. Headers with inline arithmetic use the inline
//          namespace `strict`, so that the linker cannot merge their functions with those of a program compiled under
//          other rules.
// Source   rasterizer/reference/numbers.md 1.1 to 1.3; ISO C++ <cfenv>; the build target strata::numerics carries the
//          flags.
// Tests    tests/rasterizer/base/numerics_test.cpp
#pragma once
#include <cfloat>
#include <limits>

#ifdef __FAST_MATH__
#error "Strata's arithmetic must not be compiled with -ffast-math: link the target strata::numerics"
#endif
#if FLT_EVAL_METHOD != 0
#error "Strata's arithmetic needs FLT_EVAL_METHOD == 0: binary32 and binary64 operations without excess precision"
#endif

namespace strata {

static_assert(std::numeric_limits<float>::is_iec559 && std::numeric_limits<float>::digits == 24);
static_assert(std::numeric_limits<double>::is_iec559 && std::numeric_limits<double>::digits == 53);

}  // namespace strata
