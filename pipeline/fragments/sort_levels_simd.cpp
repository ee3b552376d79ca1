// pipeline/fragments/sort_levels_simd.cpp - sort_levels.h, compiled once per instruction set. How kernels are written:
// rasterizer/reference/kernels.md. Tests: tests/pipeline/fragments/sort_levels_test.cpp
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "pipeline/fragments/sort_levels_simd.cpp"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"
#include "pipeline/fragments/sort_levels.h"

HWY_BEFORE_NAMESPACE();
namespace strata::pipeline::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

// scalar::Levels in vectors. Not inline by itself: between it and its callers are the loops of sort_levels.h, which are
// not compiled for an instruction set.
struct VectorLevels {
    using Wide = hn::CappedTag<std::uint64_t, block_lanes>;
    static constexpr std::size_t step = hn::MaxLanes(Wide{});

    static void exchange(std::uint64_t* a, std::uint64_t* b) {
        for (std::size_t lane = 0; lane < block_lanes; lane += step) {
            const auto x = hn::LoadU(Wide{}, a + lane), y = hn::LoadU(Wide{}, b + lane);
            hn::StoreU(hn::Min(x, y), Wide{}, a + lane);
            hn::StoreU(hn::Max(x, y), Wide{}, b + lane);
        }
    }
    static bool in_order(const std::uint64_t* a, const std::uint64_t* b) {
        for (std::size_t lane = 0; lane < block_lanes; lane += step)
            if (!hn::AllFalse(Wide{}, hn::Lt(hn::LoadU(Wide{}, b + lane), hn::LoadU(Wide{}, a + lane)))) return false;
        return true;
    }
};

[[gnu::flatten]] void sort_all(std::uint64_t* levels, std::size_t height) { sort_rising<VectorLevels>(levels, height); }

}  // namespace
}  // namespace strata::pipeline::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "rasterizer/base/simd_dispatch.h"

namespace strata::pipeline {
STRATA_EXPORT(sort_all);

void sort_levels(std::uint64_t* levels, std::size_t height) noexcept {
    if (simd_is_scalar()) return sort_rising<scalar::Levels>(levels, height);
    kernel_of(HWY_DISPATCH_TABLE(sort_all))(levels, height);
}

}  // namespace strata::pipeline
#endif
