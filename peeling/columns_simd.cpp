// peeling/columns_simd.cpp - columns_sort.h compiled once an instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "peeling/columns_simd.cpp"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

#include "peeling/columns_sort.h"
#include "rasterizer/simd.h"

HWY_BEFORE_NAMESPACE();
namespace strata::peeling::HWY_NAMESPACE {

void sort(std::uint64_t* rows, std::size_t depth) { sort_rows(rows, depth); }

}  // namespace strata::peeling::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace strata::peeling {
HWY_EXPORT(sort);

void sort_columns(std::uint64_t* rows, std::size_t depth) {
    if (simd_is_scalar()) return sort_rows(rows, depth);
    HWY_DYNAMIC_DISPATCH(sort)(rows, depth);
}

}  // namespace strata::peeling
#endif
