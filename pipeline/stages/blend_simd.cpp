// pipeline/stages/blend_simd.cpp - blending, one source for every instruction set: the loops of blend_lanes.h inlined
// (flatten) and compiled per instruction set over whole vectors, because the arrays of a batch have room for them. How
// kernels are written: rasterizer/reference/kernels.md. Tests: tests/pipeline/stages/simd_stages_test.cpp
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "pipeline/stages/blend_simd.cpp"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"
#include "pipeline/formats/half-inl.h"
#include "pipeline/stages/blend_lanes.h"

HWY_BEFORE_NAMESPACE();
namespace strata::pipeline::HWY_NAMESPACE {
namespace {

#if HWY_ARCH_X86 && HWY_TARGET <= HWY_AVX2 && !defined(HWY_DISABLE_F16C)  // has_halves of half-inl.h
struct HalfWords {
    using Words = hn::ScalableTag<std::uint32_t>;
    using Floats = hn::RebindToFloat<Words>;

    static void decode(const std::uint32_t* codes, float* HWY_RESTRICT values, std::size_t count) {
        for (std::size_t i = 0; i < count; i += hn::Lanes(Words{}))
            hn::StoreU(half_values(Words{}, hn::LoadU(Words{}, codes + i)), Floats{}, values + i);
    }
    static void encode_nearest(const float* values, std::uint32_t* HWY_RESTRICT codes, std::size_t count) {
        for (std::size_t i = 0; i < count; i += hn::Lanes(Words{}))
            hn::StoreU(half_codes(Words{}, hn::LoadU(Floats{}, values + i)), Words{}, codes + i);
    }
};
#else
using HalfWords = scalar::PlainHalves;
#endif

// Processes whole vectors of up to 16 lanes; results past the count are scratch.
[[gnu::flatten]] void blend_lanes(const Blend& state, ChannelType type, const DeviceProfile& profile, int channels,
                                  const scalar::ColorLanes& src, scalar::ColorCodes& codes, int count) {
    const std::size_t whole_vectors = (static_cast<std::size_t>(count) + 15) & ~std::size_t{15};
    scalar::blend<HalfWords>(state, type, profile, channels, src, codes, whole_vectors);
}

}  // namespace
}  // namespace strata::pipeline::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "rasterizer/base/simd_dispatch.h"

namespace strata::pipeline {

STRATA_EXPORT(blend_lanes);

void blend(const Blend& state, ChannelType type, const DeviceProfile& profile, int channels,
           const scalar::ColorLanes& src, scalar::ColorCodes& codes, int count) noexcept {
    if (simd_is_scalar())
        return scalar::blend(state, type, profile, channels, src, codes, static_cast<std::size_t>(count));
    kernel_of(HWY_DISPATCH_TABLE(blend_lanes))(state, type, profile, channels, src, codes, count);
}

}  // namespace strata::pipeline
#endif
