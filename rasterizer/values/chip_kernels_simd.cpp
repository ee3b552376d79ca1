// rasterizer/values/chip_kernels_simd.cpp - the kernels of chip_lanes.h, compiled once per instruction set. How kernels
// are written: rasterizer/reference/kernels.md. Tests: tests/rasterizer/values/chip_lanes_test.cpp
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "rasterizer/values/chip_kernels_simd.cpp"
#include "hwy/foreach_target.h"  // compiles this file once per instruction set
#include "hwy/highway.h"
#include "rasterizer/values/chip_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace strata::rasterizer::HWY_NAMESPACE {
namespace {
namespace hn = hwy::HWY_NAMESPACE;

constexpr int step = static_cast<int>(hn::MaxLanes(F64{}));

template <CodeKind kind>
HWY_INLINE void window_z_of(const ChipTriangle& t, const NarrowWindowZ& z, const std::uint16_t* x,
                            const std::uint16_t* y, int count, const ChipConversion& to, std::uint32_t* out) {
    const WeightsAt<false> edges{t.edges};
    const TruncatedWeightsAt weights{t};
    const WindowZAt depth{z};
    const ChipConversion conversion = to;
    const double area = t.edges.area;
    for (int i = 0; i < count; i += step) {
        const Corners e = edge_values(edges.lanes(x + i, y + i), all(area));
        hn::StoreU(chip_codes<kind>(depth.value(e, weights.at(e)), conversion), U32{}, out + i);
    }
}

void window_z(const ChipTriangle& t, const NarrowWindowZ& z, const std::uint16_t* x, const std::uint16_t* y, int count,
              const ChipConversion& to, std::uint32_t* out) noexcept {
    switch (to.kind) {
        case CodeKind::d16f: return window_z_of<CodeKind::d16f>(t, z, x, y, count, to, out);
        case CodeKind::d24f: return window_z_of<CodeKind::d24f>(t, z, x, y, count, to, out);
        case CodeKind::fixed:
        case CodeKind::fixed_product:
        case CodeKind::fixed_truncated_product:
        case CodeKind::binary32: break;
    }
    window_z_of<CodeKind::fixed>(t, z, x, y, count, to, out);
}

// The weights of corners 0 and 2 in units of 1/256; corner 1 has the rest.
struct OuterParts {
    hn::Vec<I32> w0, w2;
};
HWY_INLINE OuterParts outer_parts(const Corners& b) {
    const Remainder rest{b};
    const V64 scale = all(256.0);
    // floor(256 (1 - x)), where x is the exact sum of the other two weights, as in ColorWeights.
    const TwoLanes x = two_sum_lanes(b.c1, hn::IfThenElse(rest.is0, b.c2, b.c0));
    const V64 scaled = hn::Mul(scale, x.high), down = hn::Trunc(scaled);
    const Mask64 is_above = hn::Or(hn::Lt(down, scaled), hn::Gt(x.low, hn::Zero(F64{})));
    const V64 remaining = hn::Sub(hn::Sub(scale, down), hn::IfThenElseZero(is_above, all(1.0)));
    const V64 w0 = hn::IfThenElse(rest.is0, remaining, hn::Mul(scale, b.c0));
    const V64 w2 = hn::IfThenElse(rest.is2, remaining, hn::Mul(scale, b.c2));
    return {hn::DemoteTo(I32{}, w0), hn::DemoteTo(I32{}, w2)};
}

void colors(const ChipTriangle& t, const ColorLanes& colors, const std::uint16_t* x, const std::uint16_t* y,
            int count) noexcept {
    const WeightsAt<false> edges{t.edges};
    const TruncatedWeightsAt weights{t};
    const double area = t.edges.area;
    const I32 d;
    for (int i = 0; i < count; i += step) {
        const Corners e = edge_values(edges.lanes(x + i, y + i), all(area));
        const OuterParts w = outer_parts(weights.at(e));
        const auto w1 = hn::Sub(hn::Sub(hn::Set(d, 256), w.w0), w.w2);
        for (std::size_t c = 0; c < color_channels; ++c) {
            const std::array<std::int32_t, 3>& code = colors.codes[c];
            if (colors.out[c] == nullptr) continue;
            const auto sum = hn::Add(hn::Add(hn::Mul(w.w0, hn::Set(d, code[0])), hn::Mul(w1, hn::Set(d, code[1]))),
                                     hn::Add(hn::Mul(w.w2, hn::Set(d, code[2])), hn::Set(d, 128)));
            const V32 channel = hn::ConvertTo(F32{}, hn::ShiftRight<8>(sum));
            hn::StoreU(hn::Div(channel, hn::Set(F32{}, 255.0f)), F32{}, colors.out[c] + i);
        }
    }
}

// TruncatedSum::at, truncated to binary32. Between these two powers every intermediate is a normal number of binary32.
constexpr double least_power = 0x1p-100, greatest_power = 0x1p100;

bool coordinates(const ChipTriangle& t, const CoordinateLanes& coordinates, const std::uint16_t* x,
                 const std::uint16_t* y, int count) noexcept {
    const F64 d;
    const WeightsAt<false> edges{t.edges};
    const TruncatedWeightsAt weights{t};
    const double area = t.edges.area;
    Mask64 is_unknown = hn::MaskFromVec(hn::Zero(d));
    for (int i = 0; i < count; i += step) {
        const Corners b = weights.at(edge_values(edges.lanes(x + i, y + i), all(area)));
        const Remainder rest{b};
        const V64 remaining = hn::Sub(all(1.0), hn::Add(b.c1, hn::IfThenElse(rest.is0, b.c2, b.c0)));
        const V64 b0 = hn::IfThenElse(rest.is0, remaining, b.c0), b2 = hn::IfThenElse(rest.is2, remaining, b.c2);
        const V64 power0 = leading_power(b0), power2 = leading_power(b2);
        for (std::size_t k = 0; k < coordinates.count; ++k) {
            const CoordinateLanes::Term& u = coordinates.term[k];
            const V64 largest = hn::Max(
                leading_power(all(u.middle)),
                hn::Max(hn::Mul(power0, leading_power(all(u.first))), hn::Mul(power2, leading_power(all(u.last)))));
            const Mask64 is_known = hn::And(hn::Ge(largest, all(least_power)), hn::Le(largest, all(greatest_power)));
            is_unknown = hn::Or(is_unknown, hn::AndNot(is_known, hn::FirstN(d, static_cast<std::size_t>(count - i))));
            const V64 unit = hn::Mul(largest, all(0x1p-23)), units = inverse_power(unit);
            const auto truncated = [&](V64 v) HWY_ATTR { return hn::Trunc(hn::Mul(v, units)); };
            const V64 sum = hn::Add(hn::Add(truncated(all(u.middle)), truncated(hn::Mul(b0, all(u.first)))),
                                    truncated(hn::Mul(b2, all(u.last))));
            // Adding 0 turns -0 into +0: the definition sums integers, which have no -0.
            const V64 v = truncate_24(hn::Mul(hn::Add(sum, hn::Zero(d)), unit));
            hn::StoreU(hn::DemoteTo(F32{}, v), F32{}, u.out + i);
        }
    }
    return !hn::AllFalse(d, is_unknown);
}

const ChipKernels* table() {
    static constexpr ChipKernels kernels{window_z, colors, coordinates};
    return &kernels;
}

}  // namespace
}  // namespace strata::rasterizer::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "rasterizer/base/simd_dispatch.h"

namespace strata::rasterizer {
STRATA_EXPORT(table);

inline namespace strict {

const ChipKernels* chip_kernels() noexcept {
    return simd_is_scalar() ? nullptr : kernel_of(HWY_DISPATCH_TABLE(table))();
}

}  // namespace strict
}  // namespace strata::rasterizer
#endif
