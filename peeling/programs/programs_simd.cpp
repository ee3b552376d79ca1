// peeling/programs/programs_simd.cpp - the lane loops of programs.h and min_max.h, inlined (flatten) and compiled once
// per instruction set, over whole vectors: the arrays of a batch are padded for them. How kernels are written:
// rasterizer/reference/kernels.md. Tests: tests/peeling/programs/programs_test.cpp
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "peeling/programs/programs_simd.cpp"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"
#include "peeling/programs/average-inl.h"
#include "peeling/programs/average.h"
#include "peeling/programs/min_max.h"
#include "peeling/programs/programs.h"

HWY_BEFORE_NAMESPACE();
namespace strata::peeling::HWY_NAMESPACE {
namespace {

using pipeline::ColorLanes;
using MaskLanes = pipeline::Lanes<std::uint32_t>;
using FloatLanes = pipeline::Lanes<float>;

// The count rounded up to whole vectors of the widest set, sixteen lanes; lanes beyond the count are scratch.
constexpr std::size_t padded(std::size_t count) { return (count + 15) & ~std::size_t{15}; }

[[gnu::flatten]] void premultiply_lanes(const ColorLanes& color, ColorLanes& out, std::size_t count) {
    scalar::premultiply(color, out, padded(count));
}

[[gnu::flatten]] void discard_lanes(const MaskLanes& code, const MaskLanes& peeled, MaskLanes& alive,
                                    std::size_t count) {
    scalar::discard_peeled(code, peeled, alive, padded(count));
}

[[gnu::flatten]] void classify_lanes(const FloatLanes& z, const ColorLanes& min_max, const MaskLanes& opaque,
                                     PeelLanes& side, std::size_t count) {
    scalar::classify(z, min_max, opaque, side, padded(count));
}

[[gnu::flatten]] void min_max_lanes(const FloatLanes& z, const MaskLanes& chosen, ColorLanes& out, std::size_t count) {
    scalar::write_min_max(z, chosen, out, padded(count));
}

[[gnu::flatten]] void layer_lanes(const ColorLanes& color, const ColorLanes& front, const PeelLanes& side,
                                  ColorLanes& next_front, ColorLanes& back, std::size_t count) {
    scalar::write_layers(color, front, side, next_front, back, padded(count));
}

// Written with explicit vectors: the compiler does not vectorize the loop over the bits of n.
void average_lanes(const ColorLanes& sums, const FloatLanes& n, const ColorLanes& background, ColorLanes& out,
                   std::size_t count) {
    namespace hn = hwy::HWY_NAMESPACE;
    const average::Floats d;
    constexpr average::AverageLanes lanes;
    for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
        const auto a = hn::LoadU(d, &sums[3][i]), number = hn::LoadU(d, &n[i]);
        const auto has = average::has_average(a, number);
        const auto t = average::transmittance(lanes, a, number);
        for (std::size_t c = 0; c < 3; ++c) {
            const auto behind = hn::LoadU(d, &background[c][i]);
            const auto color = average::average_over(lanes, hn::LoadU(d, &sums[c][i]), a, t, behind);
            hn::StoreU(hn::IfThenElse(has, color, behind), d, &out[c][i]);
        }
        const auto one = hn::Set(d, 1.0f), behind = hn::LoadU(d, &background[3][i]);
        const auto alpha = hn::Sub(one, hn::Mul(t, hn::Sub(one, behind)));
        hn::StoreU(hn::IfThenElse(hn::AndNot(hn::Eq(behind, one), has), alpha, behind), d, &out[3][i]);
    }
}

}  // namespace
}  // namespace strata::peeling::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "rasterizer/base/simd_dispatch.h"

namespace strata::peeling {

STRATA_EXPORT(premultiply_lanes);
STRATA_EXPORT(discard_lanes);
STRATA_EXPORT(classify_lanes);
STRATA_EXPORT(min_max_lanes);
STRATA_EXPORT(layer_lanes);
STRATA_EXPORT(average_lanes);

inline namespace strict {

void premultiply(const pipeline::ColorLanes& color, pipeline::ColorLanes& out, std::size_t count) noexcept {
    if (simd_is_scalar()) return scalar::premultiply(color, out, count);
    kernel_of(HWY_DISPATCH_TABLE(premultiply_lanes))(color, out, count);
}

void discard_peeled(const pipeline::FragmentBatch& in, const pipeline::Lanes<std::uint32_t>& peeled,
                    pipeline::Outputs& out) noexcept {
    if (simd_is_scalar()) return scalar::discard_peeled(in.code, peeled, out.alive, lanes(in));
    kernel_of(HWY_DISPATCH_TABLE(discard_lanes))(in.code, peeled, out.alive, lanes(in));
}

void classify(const pipeline::FragmentBatch& in, const pipeline::ColorLanes& min_max,
              const pipeline::Lanes<std::uint32_t>& opaque, PeelLanes& side) noexcept {
    if (simd_is_scalar()) return scalar::classify(in.shader_z, min_max, opaque, side, lanes(in));
    kernel_of(HWY_DISPATCH_TABLE(classify_lanes))(in.shader_z, min_max, opaque, side, lanes(in));
}

void write_min_max(const pipeline::FragmentBatch& in, const pipeline::Lanes<std::uint32_t>& mask,
                   pipeline::ColorLanes& out) noexcept {
    if (simd_is_scalar()) return scalar::write_min_max(in.shader_z, mask, out, lanes(in));
    kernel_of(HWY_DISPATCH_TABLE(min_max_lanes))(in.shader_z, mask, out, lanes(in));
}

void write_layers(const pipeline::FragmentBatch& in, const pipeline::ColorLanes& front, const PeelLanes& side,
                  pipeline::ColorLanes& next_front, pipeline::ColorLanes& back) noexcept {
    if (simd_is_scalar()) return scalar::write_layers(in.color, front, side, next_front, back, lanes(in));
    kernel_of(HWY_DISPATCH_TABLE(layer_lanes))(in.color, front, side, next_front, back, lanes(in));
}

void resolve_average(const pipeline::ColorLanes& sums, const pipeline::Lanes<float>& n,
                     const pipeline::ColorLanes& background, pipeline::ColorLanes& out, std::size_t count) noexcept {
    if (simd_is_scalar()) return scalar::resolve_average(sums, n, background, out, count);
    kernel_of(HWY_DISPATCH_TABLE(average_lanes))(sums, n, background, out, count);
}

}  // namespace strict
}  // namespace strata::peeling
#endif
