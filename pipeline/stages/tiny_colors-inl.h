// pipeline/stages/tiny_colors-inl.h - the colours of tiny triangles side by side. For *_simd.cpp alone: Highway compiles it once a set,
// wherever foreach_target.h asks.
//
// Rule     ColorPlanes of each pixel's own triangle.
// Tests    tests/peeling/dense_meshes_test.cpp: against literal execution
#include <cstddef>
#include <limits>

#include "hwy/highway.h"
#include "rasterizer/walk/tiny_walk-inl.h"

#if defined(STRATA_PIPELINE_TINY_COLORS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef STRATA_PIPELINE_TINY_COLORS_INL_H
#undef STRATA_PIPELINE_TINY_COLORS_INL_H
#else
#define STRATA_PIPELINE_TINY_COLORS_INL_H
#endif

HWY_BEFORE_NAMESPACE();
namespace strata::pipeline::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
namespace raster = rasterizer::HWY_NAMESPACE;

// One value of the colour: its plane before the division by the one of 1 / w, and the value itself where it is constant.
template <bool unsnapped>
class TinyChannel {
  public:
    using F32 = raster::F32;
    using F64 = raster::F64;
    using V32 = raster::V32;

    HWY_INLINE TinyChannel(const V32 (&value)[3], const V32 (&w)[3])
        : plane_{product(value[0], w[0]), product(value[1], w[1]), product(value[2], w[2])} {
        const raster::U32 d;
        const auto bits = [&](std::size_t i) HWY_ATTR { return hn::BitCast(d, value[i]); };
        const auto differs = hn::Or(hn::Xor(bits(0), bits(1)), hn::Xor(bits(0), bits(2)));
        const auto is_constant = hn::RebindMask(F32{}, hn::Eq(differs, hn::Zero(d)));
        all_constant_ = hn::AllTrue(F32{}, is_constant);
        none_constant_ = hn::AllFalse(F32{}, is_constant);
        // A colour that is drawn is finite: NaN stands for one that varies.
        const V32 varies = hn::Set(F32{}, std::numeric_limits<float>::quiet_NaN());
        constant_ = hn::PromoteTo(F64{}, hn::IfThenElse(is_constant, value[0], varies));
        is_constant_ = is_constant;
    }
    HWY_INLINE hn::Mask<F32> is_constant() const { return is_constant_; }

    HWY_INLINE V32 at(const raster::TinyPixels& pixels, const raster::Weights& b, V32 inverse_w,
                      const raster::TinyTriangles<unsnapped>& triangles) const {
        const V32 constant = hn::DemoteTo(F32{}, pixels.of(constant_));
        if (all_constant_) return constant;
        const V32 value = hn::Div(plane_.at(pixels, b, triangles.geometry(), triangles.triangles()), inverse_w);
        return none_constant_ ? value : hn::IfThenElse(hn::Eq(constant, constant), constant, value);
    }

  private:
    // In binary32, as every attribute's.
    HWY_INLINE static raster::V64 product(V32 value, V32 w) { return hn::PromoteTo(F64{}, hn::Mul(value, w)); }

    raster::TinyPlane<unsnapped> plane_;
    raster::V64 constant_;
    hn::Mask<F32> is_constant_;
    bool all_constant_, none_constant_;
};

template <bool unsnapped>
class TinyColors {
  public:
    using F32 = raster::F32;
    using V32 = raster::V32;

    HWY_INLINE explicit TinyColors(const raster::TinyTriangles<unsnapped>& triangles)
        : TinyColors{triangles, Corners{triangles}} {}

    // A triangle has one colour.
    [[nodiscard]] HWY_INLINE bool has_flat() const { return has_flat_; }

    // r g b a, divided.
    HWY_INLINE void at(const raster::TinyPixels& pixels, const raster::Weights& b, V32 (&color)[4]) const {
        const V32 inverse_w = inverse_w_.at(pixels, b, triangles_.geometry(), triangles_.triangles());
        color[0] = red_.at(pixels, b, inverse_w, triangles_);
        color[1] = green_.at(pixels, b, inverse_w, triangles_);
        color[2] = blue_.at(pixels, b, inverse_w, triangles_);
        color[3] = alpha_.at(pixels, b, inverse_w, triangles_);
    }

  private:
    // r g b a of the shown side, a triangle a lane, by corner.
    static_assert(offsetof(rasterizer::ClipVertex, back) ==
                  offsetof(rasterizer::ClipVertex, front) + 4 * sizeof(float));
    struct Corners {
        HWY_INLINE explicit Corners(const raster::TinyTriangles<unsnapped>& triangles) {
            const rasterizer::Geometry& g = triangles.geometry();
            for (std::size_t i = 0; i < 3; ++i) {
                V32 color[4];
                raster::load_fours(
                    [&](std::uint32_t k) {
                        const rasterizer::TriangleRecord& t = g.triangles[triangles.triangles()[k]];
                        const rasterizer::ClipVertex& v = g.vertices[t.vertex[i]];
                        // Counted, not chosen: a branch could not be guessed where both sides show.
                        return &v.front + (t.front_facing ? 0 : 1);
                    },
                    color);
                for (std::size_t c = 0; c < 4; ++c) channel[c][i] = color[c];
                w[i] = triangles.inverse_w(i);
                wide_w[i] = hn::PromoteTo(raster::F64{}, w[i]);
            }
        }
        V32 channel[4][3], w[3];
        raster::V64 wide_w[3];
    };
    HWY_INLINE TinyColors(const raster::TinyTriangles<unsnapped>& triangles, const Corners& c)
        : triangles_{triangles},
          inverse_w_{c.wide_w[0], c.wide_w[1], c.wide_w[2]},
          red_{c.channel[0], c.w},
          green_{c.channel[1], c.w},
          blue_{c.channel[2], c.w},
          alpha_{c.channel[3], c.w},
          has_flat_{!hn::AllFalse(F32{}, hn::And(hn::And(red_.is_constant(), green_.is_constant()),
                                                 hn::And(blue_.is_constant(), alpha_.is_constant())))} {}

    const raster::TinyTriangles<unsnapped>& triangles_;
    const raster::TinyPlane<unsnapped> inverse_w_;
    const TinyChannel<unsnapped> red_, green_, blue_, alpha_;
    const bool has_flat_;
};

}  // namespace strata::pipeline::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
