// pipeline/fragments/cursor_steps_simd.cpp - step_cursors of cursor_steps.h, a vector of columns side by side.
// How kernels are written: kernels.md. Tests: tests/pipeline/fragments/cursor_steps_test.cpp
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "pipeline/fragments/cursor_steps_simd.cpp"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"
#include "pipeline/fragments/cursor_steps.h"

HWY_BEFORE_NAMESPACE();
namespace strata::pipeline::HWY_NAMESPACE {
namespace {
namespace hn = hwy::HWY_NAMESPACE;

using Words = hn::ScalableTag<std::uint64_t>;
using Numbers = hn::Rebind<std::uint32_t, Words>;

// The columns that fill no vector are stepped one by one.
std::size_t step(const ColumnPlaces& columns, const std::uint64_t* bounds, std::uint32_t* cursors, std::size_t first) {
    const Words d;
    const hn::RebindToSigned<Words> places;
    const auto ones = hn::Set(d, ~std::uint64_t{0}), greatest = hn::Set(d, 0xffffffffu), one = hn::Set(d, 1);
    const auto word = [&](auto index) { return hn::GatherIndex(d, columns.words, hn::BitCast(places, index)); };
    std::size_t k = first;
    for (; k + hn::Lanes(d) <= columns.count; k += hn::Lanes(d)) {
        const auto key = hn::LoadU(d, bounds + k);
        const auto bound = hn::IfThenElse(hn::Gt(key, greatest), ones, hn::ShiftLeft<32>(key));
        const auto begin = hn::PromoteTo(d, hn::LoadU(Numbers{}, columns.begin + k));
        auto at = hn::Add(begin, hn::PromoteTo(d, hn::LoadU(Numbers{}, cursors + k)));
        at = hn::Add(at, hn::IfThenElseZero(hn::Lt(word(at), bound), one));
        const auto before = hn::Add(word(hn::Sub(at, one)), one);
        if (!hn::AllFalse(d, hn::Or(hn::Lt(word(at), bound), hn::Gt(before, bound)))) return k;
        hn::StoreU(hn::TruncateTo(Numbers{}, hn::Sub(at, begin)), Numbers{}, cursors + k);
    }
    return scalar::step_cursors(columns, bounds, cursors, k);
}

}  // namespace
}  // namespace strata::pipeline::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "rasterizer/base/simd_dispatch.h"

namespace strata::pipeline {
HWY_EXPORT(step);

std::size_t step_cursors(const ColumnPlaces& columns, const std::uint64_t* bounds, std::uint32_t* cursors,
                         std::size_t first) noexcept {
    if (simd_is_scalar()) return scalar::step_cursors(columns, bounds, cursors, first);
    return kernel_of(HWY_DISPATCH_TABLE(step))(columns, bounds, cursors, first);
}

}  // namespace strata::pipeline
#endif
