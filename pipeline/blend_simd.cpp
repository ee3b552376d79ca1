// pipeline/blend_simd.cpp - blending, one source for every instruction set: the loops of blend_lanes.h inlined (flatten)
// and compiled for the set, over whole vectors, since the arrays of a batch have room for them.
// Tests: tests/pipeline/simd_stages_test.cpp
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "pipeline/blend_simd.cpp"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

#include "pipeline/blend_lanes.h"
#include "rasterizer/simd.h"

HWY_BEFORE_NAMESPACE();
namespace strata::pipeline::HWY_NAMESPACE {
namespace {

[[gnu::flatten]] void blend_lanes(const Blend& state, ChannelType type, const DeviceProfile& profile, int channels,
                                  const scalar::ColorLanes& src, scalar::ColorCodes& codes, int count) {
    scalar::blend(state, type, profile, channels, src, codes, (static_cast<std::size_t>(count) + 15) & ~std::size_t{15});
}

}  // namespace
}  // namespace strata::pipeline::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace strata::pipeline {

HWY_EXPORT(blend_lanes);

void blend(const Blend& state, ChannelType type, const DeviceProfile& profile, int channels,
           const scalar::ColorLanes& src, scalar::ColorCodes& codes, int count) noexcept {
    if (simd_is_scalar())
        return scalar::blend(state, type, profile, channels, src, codes, static_cast<std::size_t>(count));
    HWY_DYNAMIC_DISPATCH(blend_lanes)(state, type, profile, channels, src, codes, count);
}

}  // namespace strata::pipeline
#endif
