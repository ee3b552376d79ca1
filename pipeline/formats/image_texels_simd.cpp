// pipeline/formats/image_texels_simd.cpp - image_texels.h, compiled once per instruction set. A vector is 16 bytes, one
// pixel of codes: images have no greater alignment, and non-temporal stores are combined into cache lines whatever
// their width. How kernels are written: rasterizer/reference/kernels.md. Tests:
// tests/pipeline/formats/image_texels_test.cpp
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "pipeline/formats/image_texels_simd.cpp"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"
#include "pipeline/formats/image_texels.h"

HWY_BEFORE_NAMESPACE();
namespace strata::pipeline::HWY_NAMESPACE {
namespace {
namespace hn = hwy::HWY_NAMESPACE;

using Pixel = hn::CappedTag<std::uint32_t, 4>;
using Bytes = hn::Rebind<std::uint8_t, Pixel>;
constexpr std::size_t lanes = hn::MaxLanes(Pixel{});

void widen(const std::uint32_t* words, std::size_t count, std::uint32_t* codes) {
    const auto* const bytes = reinterpret_cast<const std::uint8_t*>(words);
    for (std::size_t i = 0; i < 4 * count; i += lanes)
        hn::Stream(hn::PromoteTo(Pixel{}, hn::LoadU(Bytes{}, bytes + i)), Pixel{}, codes + i);
}

}  // namespace
}  // namespace strata::pipeline::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include <bit>

#include "hwy/cache_control.h"
#include "rasterizer/base/simd_dispatch.h"

namespace strata::pipeline {
STRATA_EXPORT(widen);

void widen_words(const std::uint32_t* words, std::size_t count, std::uint32_t* codes) noexcept {
    // A non-temporal store needs an aligned address. The bytes of a packed texel are in channel order only on
    // little-endian computers.
    const bool is_aligned = reinterpret_cast<std::uintptr_t>(codes) % 16 == 0;
    if (simd_is_scalar() || !is_aligned || std::endian::native != std::endian::little)
        return scalar::widen_words(words, count, codes);
    kernel_of(HWY_DISPATCH_TABLE(widen))(words, count, codes);
}

void finish_words() noexcept { hwy::FlushStream(); }

}  // namespace strata::pipeline
#endif
