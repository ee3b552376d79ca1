// rasterizer/set_up/plain_vertices_simd.cpp - Highway kernel for plain_vertices.h: sets up vertices that need neither
// clipping nor special cases, compiled once per instruction set. How kernels are written:
// rasterizer/reference/kernels.md. Tests: tests/rasterizer/set_up/setup_test.cpp
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "rasterizer/set_up/plain_vertices_simd.cpp"
#include <bit>
#include <cstddef>
#include <cstring>

#include "hwy/foreach_target.h"  // compiles this file once per instruction set
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

// ClipVertex: 14 floats, x y z w and then the attributes. WindowCorner: three pairs of 32-bit words.
constexpr std::size_t components = sizeof(ClipVertex) / sizeof(float);

// Running maximum of |v|, compared as integer bits so that infinity and NaN exceed every finite value.
class Magnitude {
  public:
    HWY_INLINE Magnitude() : greatest_{hn::Zero(I{})} {}
    HWY_INLINE void add(VF v) { greatest_ = hn::Max(greatest_, hn::BitCast(I{}, hn::Abs(v))); }
    HWY_INLINE hn::Mask<F> is_finite() const {
        return hn::RebindMask(F{}, hn::Lt(greatest_, hn::Set(I{}, 0x7f800000)));
    }
    // Maximum over all lanes, broadcast.
    HWY_INLINE VF greatest() const { return hn::BitCast(F{}, hn::MaxOfLanes(I{}, greatest_)); }

  private:
    hn::Vec<I> greatest_;
};

// Conservative test that all attributes of `lanes` vertices, and the attributes divided by w, are finite: the largest
// magnitude times the largest |1 / w| must be finite. False negatives are rare.
HWY_INLINE bool attributes_are_finite(const float* vertices, VF inverse_w) {
    Magnitude values, factors, products;
    for (std::size_t i = 0; i < lanes * components; i += lanes) values.add(hn::LoadU(F{}, vertices + i));
    factors.add(inverse_w);
    products.add(values.greatest());
    products.add(hn::Mul(values.greatest(), factors.greatest()));
    return hn::AllTrue(F{}, products.is_finite());
}

HWY_INLINE hn::Mask<F> within(VF low, VF c, VF high) { return hn::And(hn::Ge(c, low), hn::Le(c, high)); }

// Like within_viewport in clip.h, but x and y may reach r.reach * w: still inside all clip planes.
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

// Stores `lanes` WindowCorners. Two 32-bit values are packed into one 64-bit word; a corner is three such words,
// interleaved.
static_assert(sizeof(WindowCorner) == 3 * sizeof(std::uint64_t) && offsetof(WindowCorner, p) == 0 &&
              offsetof(WindowCorner, unsnapped) == 8 && offsetof(WindowCorner, z) == 16);
template <class V>
HWY_INLINE auto paired(V low, V high) {
    using Wide = hn::Rebind<std::uint64_t, hn::Half<F>>;
    const auto wide = [](auto v)
                          HWY_ATTR { return hn::PromoteTo(Wide{}, hn::BitCast(hn::Rebind<std::uint32_t, Wide>{}, v)); };
    return hn::Or(wide(low), hn::ShiftLeft<32>(wide(high)));
}
HWY_INLINE void store_corners(hn::Vec<I> x, hn::Vec<I> y, const VF (&value)[4], WindowCorner* corners) {
    using Wide = hn::Rebind<std::uint64_t, hn::Half<F>>;
    auto* const words = reinterpret_cast<std::uint64_t*>(corners);
    const auto store = [&](auto half_of, std::uint64_t* to) HWY_ATTR {
        hn::StoreInterleaved3(paired(half_of(x), half_of(y)), paired(half_of(value[0]), half_of(value[1])),
                              paired(half_of(value[2]), half_of(value[3])), Wide{}, to);
    };
    store([](auto v) HWY_ATTR { return hn::LowerHalf(v); }, words);
    store([](auto v) HWY_ATTR { return hn::UpperHalf(hn::Half<hn::DFromV<decltype(v)>>{}, v); }, words + 3 * lanes / 2);
}

// Returns a mask of the plain vertices (plain_vertices.h). The other corners are unspecified; set_up_vertex overwrites
// them.
HWY_INLINE hn::Mask<F> set_up_lanes(const PlainVertexRules& r, const float* vertices, WindowCorner* corners) {
    const F d;
    alignas(64) float positions[4 * lanes];
    for (std::size_t k = 0; k < lanes; ++k)
        std::memcpy(positions + 4 * k, vertices + k * components, 4 * sizeof(float));
    VF p[4];
    hn::LoadInterleaved4(d, positions, p[0], p[1], p[2], p[3]);
    const VF inverse_w = hn::Div(hn::Set(d, 1.0f), p[3]), guard = hn::Set(d, r.guard);
    Magnitude magnitude;
    const VF x = map(r, 0, p[0], p[3], inverse_w), y = map(r, 1, p[1], p[3], inverse_w);
    const VF z = map(r, 2, p[2], p[3], inverse_w);
    for (const VF v : {p[0], p[1], p[2], p[3], inverse_w, x, y, z}) magnitude.add(v);
    const VF guarded_x = hn::Clamp(x, hn::Neg(guard), guard), guarded_y = hn::Clamp(y, hn::Neg(guard), guard);
    store_corners(snapped(r, guarded_x), snapped(r, guarded_y), {guarded_x, guarded_y, z, inverse_w}, corners);
    if (HWY_UNLIKELY(!attributes_are_finite(vertices, inverse_w))) return hn::Lt(guard, guard);
    return hn::And(magnitude.is_finite(), within_planes(p, r));
}

std::uint32_t set_up(const PlainVertexRules& rules, const ClipVertex* vertices, WindowCorner* corners) {
    std::uint32_t plain = 0;
    for (std::size_t first = 0; first < plain_vertex_count; first += lanes) {
        alignas(8) std::uint8_t bits[8] = {};
        hn::StoreMaskBits(F{}, set_up_lanes(rules, &vertices[first].x, corners + first), bits);
        plain |= (static_cast<std::uint32_t>(bits[1]) << 8 | bits[0]) << first;
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
STRATA_EXPORT(plain_table);

SetUpPlain set_up_plain() noexcept {
    if (simd_is_scalar() || std::endian::native != std::endian::little) return nullptr;
    return kernel_of(HWY_DISPATCH_TABLE(plain_table))();
}

}  // namespace strata::rasterizer
#endif
