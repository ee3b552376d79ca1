// pipeline/geforce3/combiner_loops_simd.cpp - combiner_loops.h, compiled once per instruction set; that header defines
// the meaning. How kernels are written: rasterizer/reference/kernels.md. Tests:
// tests/pipeline/geforce3/combiner_test.cpp
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "pipeline/geforce3/combiner_loops_simd.cpp"
#include "hwy/foreach_target.h"  // compiles this file once per instruction set
#include "hwy/highway.h"
#include "pipeline/geforce3/combiner_loops.h"

HWY_BEFORE_NAMESPACE();
namespace strata::pipeline::HWY_NAMESPACE {
namespace {

// Vectorized by the compiler for this instruction set.
[[gnu::flatten]] void load(const float* from, std::int32_t* to, std::size_t count) noexcept {
    scalar::load(from, to, count);
}
[[gnu::flatten]] void multiply(const CombinerOperand& x, const CombinerOperand& y, CombinerProduct kind, std::size_t c,
                               std::int32_t* to, std::size_t count) noexcept {
    scalar::multiply(x, y, kind, c, to, count);
}
[[gnu::flatten]] void settle(const CombinerScaling& scaling, const std::int32_t* from, std::int32_t* to,
                             std::size_t count) noexcept {
    scalar::settle(scaling, from, to, count);
}
[[gnu::flatten]] void mix(const CombinerMix& operands, std::size_t c, float* to, std::size_t count) noexcept {
    scalar::mix(operands, c, to, count);
}

}  // namespace

const CombinerLoops* combiner_table() {
    static constexpr CombinerLoops loops{load, multiply, settle, mix};
    return &loops;
}

}  // namespace strata::pipeline::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "rasterizer/base/simd_dispatch.h"

namespace strata::pipeline {
STRATA_EXPORT(combiner_table);

const CombinerLoops& combiner_loops() noexcept {
    static constexpr CombinerLoops scalar_reference{scalar::load, scalar::multiply, scalar::settle, scalar::mix};
    return simd_is_scalar() ? scalar_reference : *kernel_of(HWY_DISPATCH_TABLE(combiner_table))();
}

}  // namespace strata::pipeline
#endif
