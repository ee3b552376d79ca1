// rasterizer/set_up/plain_vertices_simd.cpp - plain_vertices.h for every instruction set.
// How kernels are written: kernels.md. Tests: tests/rasterizer/set_up/setup_test.cpp
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "rasterizer/set_up/plain_vertices_simd.cpp"
#include <algorithm>
#include <cstring>

#include "hwy/foreach_target.h"  // compiles this file once a target
#include "hwy/highway.h"
#include "rasterizer/set_up/clip.h"
#include "rasterizer/set_up/plain_vertices.h"

HWY_BEFORE_NAMESPACE();
namespace strata::rasterizer::HWY_NAMESPACE {
namespace {
namespace hn = hwy::HWY_NAMESPACE;

using F = hn::CappedTag<float, plain_vertex_count>;
using I = hn::RebindToSigned<F>;
using VF = hn::Vec<F>;
constexpr std::size_t lanes = hn::MaxLanes(F{});

// A vertex is 14 floats: x y z w, then what is interpolated.
constexpr std::size_t components = sizeof(ClipVertex) / sizeof(float), first_attribute = 4;

// The greatest magnitude yet, as bits: infinities and NaN are the greatest.
template <class D>
class Magnitude {
  public:
    HWY_INLINE Magnitude() : greatest_{hn::Zero(Integers{})} {}
    HWY_INLINE void add(hn::Vec<D> v) { greatest_ = hn::Max(greatest_, hn::BitCast(Integers{}, hn::Abs(v))); }
    HWY_INLINE hn::Mask<D> is_finite() const {
        return hn::RebindMask(D{}, hn::Lt(greatest_, hn::Set(Integers{}, 0x7f800000)));
    }

  private:
    using Integers = hn::RebindToSigned<D>;
    hn::Vec<Integers> greatest_;
};

// Whether the attributes of `lanes` vertices are finite, and what they are over w: all of them together, for they nearly always are.
HWY_INLINE bool attributes_are_finite(const float* vertices, const float* inverse_w) {
    using D = hn::CappedTag<float, 8>;
    constexpr std::size_t step = hn::MaxLanes(D{});
    Magnitude<D> magnitude;
    for (std::size_t k = 0; k < lanes; ++k) {
        const float* const vertex = vertices + k * components;
        const auto factor = hn::Set(D{}, inverse_w[k]);
        for (std::size_t c = first_attribute; c < components; c += step) {
            const auto value = hn::LoadU(D{}, vertex + std::min(c, components - step));
            magnitude.add(value);
            magnitude.add(hn::Mul(value, factor));
        }
    }
    return hn::AllTrue(D{}, magnitude.is_finite());
}

HWY_INLINE hn::Mask<F> within(VF low, VF c, VF high) { return hn::And(hn::Ge(c, low), hn::Le(c, high)); }

// As within_viewport of clip.h, and somewhat further: inside all planes.
HWY_INLINE hn::Mask<F> within_planes(const VF (&p)[4], const PlainVertexRules& r) {
    const VF w = p[3], least_z = r.symmetric ? hn::Neg(w) : hn::Zero(F{});
    const VF x = hn::Mul(hn::Set(F{}, r.reach[0]), w), y = hn::Mul(hn::Set(F{}, r.reach[1]), w);
    return hn::And(hn::And(within(hn::Neg(x), p[0], x), within(hn::Neg(y), p[1], y)),
                   hn::And(within(least_z, p[2], w), hn::Ge(w, hn::Set(F{}, least_w))));
}

HWY_INLINE VF map(const PlainVertexRules& r, std::size_t axis, VF c, VF w, VF inverse_w) {
    const VF divided = r.divides ? hn::Div(c, w) : hn::Mul(c, inverse_w);
    return hn::Add(hn::Mul(hn::Set(F{}, r.scale[axis]), divided), hn::Set(F{}, r.offset[axis]));
}

// Snapping multiplies a binary32 by a power of two, which is exact (window.h).
HWY_INLINE hn::Vec<I> snapped(const PlainVertexRules& r, VF c) {
    const VF scaled = hn::Mul(c, hn::Set(F{}, r.subpixels));
    return r.rounds ? hn::NearestInt(scaled) : hn::ConvertTo(I{}, scaled);
}

struct CornerLanes {
    alignas(64) std::int32_t x[lanes], y[lanes];
    alignas(64) float unsnapped_x[lanes], unsnapped_y[lanes], z[lanes], inverse_w[lanes];
};

// The corners of `lanes` vertices, and which of them are plain.
// The others may hold anything: set_up_vertex writes them anew.
HWY_INLINE hn::Mask<F> set_up_lanes(const PlainVertexRules& r, const float* vertices, CornerLanes& out) {
    const F d;
    alignas(64) float positions[4 * lanes];
    for (std::size_t k = 0; k < lanes; ++k)
        std::memcpy(positions + 4 * k, vertices + k * components, 4 * sizeof(float));
    VF p[4];
    hn::LoadInterleaved4(d, positions, p[0], p[1], p[2], p[3]);
    const VF inverse_w = hn::Div(hn::Set(d, 1.0f), p[3]), guard = hn::Set(d, r.guard);
    Magnitude<F> magnitude;
    const VF x = map(r, 0, p[0], p[3], inverse_w), y = map(r, 1, p[1], p[3], inverse_w);
    const VF z = map(r, 2, p[2], p[3], inverse_w);
    for (const VF v : {p[0], p[1], p[2], p[3], inverse_w, x, y, z}) magnitude.add(v);
    const VF guarded_x = hn::Clamp(x, hn::Neg(guard), guard), guarded_y = hn::Clamp(y, hn::Neg(guard), guard);
    hn::Store(guarded_x, d, out.unsnapped_x);
    hn::Store(guarded_y, d, out.unsnapped_y);
    hn::Store(snapped(r, guarded_x), I{}, out.x);
    hn::Store(snapped(r, guarded_y), I{}, out.y);
    hn::Store(z, d, out.z);
    hn::Store(inverse_w, d, out.inverse_w);
    if (HWY_UNLIKELY(!attributes_are_finite(vertices, out.inverse_w))) return hn::Lt(guard, guard);
    return hn::And(magnitude.is_finite(), within_planes(p, r));
}

std::uint32_t set_up(const PlainVertexRules& rules, const ClipVertex* vertices, WindowCorner* corners) {
    std::uint32_t plain = 0;
    for (std::size_t first = 0; first < plain_vertex_count; first += lanes) {
        CornerLanes own;
        alignas(8) std::uint8_t bits[8] = {};
        hn::StoreMaskBits(F{}, set_up_lanes(rules, &vertices[first].x, own), bits);
        plain |= (static_cast<std::uint32_t>(bits[1]) << 8 | bits[0]) << first;
        for (std::size_t i = 0; i < lanes; ++i)
            corners[first + i] = {
                {own.x[i], own.y[i]}, {own.unsnapped_x[i], own.unsnapped_y[i]}, own.z[i], own.inverse_w[i]};
    }
    return plain;
}

}  // namespace

SetUpPlain plain_table() { return set_up; }

}  // namespace strata::rasterizer::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "rasterizer/base/simd_dispatch.h"

namespace strata::rasterizer {
HWY_EXPORT(plain_table);

SetUpPlain set_up_plain() noexcept { return simd_is_scalar() ? nullptr : kernel_of(HWY_DISPATCH_TABLE(plain_table))(); }

}  // namespace strata::rasterizer
#endif
