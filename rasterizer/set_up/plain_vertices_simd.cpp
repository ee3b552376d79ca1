// rasterizer/set_up/plain_vertices_simd.cpp - plain_vertices.h for every instruction set.
// How kernels are written: kernels.md. Tests: tests/rasterizer/set_up/setup_test.cpp
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "rasterizer/set_up/plain_vertices_simd.cpp"
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
// component_of[i] is the distance in floats from vertex 0 to vertex i.
constexpr int components = sizeof(ClipVertex) / sizeof(float), first_attribute = 4;
alignas(64) constexpr std::int32_t component_of[plain_vertex_count] = {0,   14,  28,  42,  56,  70,  84,  98,
                                                                       112, 126, 140, 154, 168, 182, 196, 210};
static_assert(component_of[1] == components);

// The greatest magnitude yet, as bits: infinities and NaN are the greatest.
class Magnitude {
  public:
    HWY_INLINE Magnitude() : greatest_{hn::Zero(I{})} {}
    HWY_INLINE void add(VF v) { greatest_ = hn::Max(greatest_, hn::BitCast(I{}, hn::Abs(v))); }
    HWY_INLINE hn::Mask<F> is_finite() const {
        return hn::RebindMask(F{}, hn::Lt(greatest_, hn::Set(I{}, 0x7f800000)));
    }

  private:
    hn::Vec<I> greatest_;
};

HWY_INLINE hn::Mask<F> within(VF low, VF c, VF high) { return hn::And(hn::Ge(c, low), hn::Le(c, high)); }

// As within_viewport of clip.h.
HWY_INLINE hn::Mask<F> in_view(const VF (&p)[4], bool symmetric) {
    const VF w = p[3], minus_w = hn::Neg(w), least_z = symmetric ? minus_w : hn::Zero(F{});
    return hn::And(hn::And(within(minus_w, p[0], w), within(minus_w, p[1], w)),
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
    const auto component = [&](int c)
                               HWY_ATTR { return hn::GatherIndex(d, vertices + c, hn::Load(I{}, component_of)); };
    const VF p[4] = {component(0), component(1), component(2), component(3)};
    const VF inverse_w = hn::Div(hn::Set(d, 1.0f), p[3]), guard = hn::Set(d, r.guard);
    Magnitude magnitude;
    for (int c = first_attribute; c < components; ++c) {
        const VF value = component(c);
        magnitude.add(value);
        magnitude.add(hn::Mul(value, inverse_w));
    }
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
    return hn::And(magnitude.is_finite(), in_view(p, r.symmetric));
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
