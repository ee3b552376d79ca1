// pipeline/stages/color_planes-inl.h - the colours of a triangle, eight pixels at a time, for passes without batches.
// For *_simd.cpp only: Highway compiles it once per instruction set, in each file that includes foreach_target.h.
//
// Rule     The colours of PlaneAttributes with ColorInterpolation::exact_plane.
// Tests    tests/peeling/execution/execution_test.cpp compares with literal execution.
#include <cmath>

#include "hwy/highway.h"
#include "rasterizer/walk/row_walk-inl.h"

#if defined(STRATA_PIPELINE_COLOR_PLANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef STRATA_PIPELINE_COLOR_PLANES_INL_H
#undef STRATA_PIPELINE_COLOR_PLANES_INL_H
#else
#define STRATA_PIPELINE_COLOR_PLANES_INL_H
#endif

HWY_BEFORE_NAMESPACE();
namespace strata::pipeline::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
namespace raster = rasterizer::HWY_NAMESPACE;
using raster::F32;
using raster::F64;
using raster::U32;
using raster::V32;
using rasterizer::DrawnTriangle;
using rasterizer::FilterPlane;
using rasterizer::RationalPlane;

// The colour of a triangle: planes before the division by that of 1 / w (a grey colour is evaluated once), and
// constants. Loops run over four channels without branches, so that they vectorize: most triangles have too few rows to
// amortize this set-up.
class ColorPlanes {
  public:
    HWY_INLINE explicit ColorPlanes(const DrawnTriangle& triangle)
        : geometry_{triangle.geometry}, index_{triangle.index} {
        for (std::size_t i = 0; i < 3; ++i) {
            const rasterizer::ClipVertex& v = geometry_.vertices[triangle.record.vertex[i]];
            value_[i] = triangle.record.front_facing ? v.front : v.back;
            w_[i] = geometry_.corners[triangle.record.vertex[i]].inverse_w;
        }
        // Bits are compared, not values: a channel is constant if it has the same bits at all corners; the colour is
        // grey if r, g and b have the same bits at each corner.
        std::uint32_t varying = 0, colorful = 0;
        for (std::size_t c = 0; c < 4; ++c) {
            varies_[c] = (bits(0, c) ^ bits(1, c)) | (bits(0, c) ^ bits(2, c));
            varying |= varies_[c];
        }
        for (const Channels& v : value_) colorful |= (bits_of(v[0]) ^ bits_of(v[1])) | (bits_of(v[0]) ^ bits_of(v[2]));
        is_flat_ = varying == 0;
        is_grey_ = colorful == 0;
        has_w_ = !is_flat_ && w_ != Corners{1.0f, 1.0f, 1.0f};
        find_planes(triangle.weights.filter_reach());
    }

    // True if the whole triangle has one colour, flat(c).
    [[nodiscard]] HWY_INLINE bool is_flat() const { return is_flat_; }
    [[nodiscard]] HWY_INLINE float flat(std::size_t c) const { return value_[0][c]; }

    // r g b a, after the division, for a row or for pixels.
    template <bool unsnapped, class Where>
    HWY_INLINE void at(const Where& where, const raster::Weights& b, V32 (&color)[4]) const {
        const V32 inverse_w = has_w_ ? rounded<unsnapped>(where, b, inverse_w_, w_) : hn::Set(F32{}, 1.0f);
        color[0] = channel<unsnapped>(0, where, b, inverse_w);
        color[1] = is_grey_ ? color[0] : channel<unsnapped>(1, where, b, inverse_w);
        color[2] = is_grey_ ? color[0] : channel<unsnapped>(2, where, b, inverse_w);
        color[3] = channel<unsnapped>(3, where, b, inverse_w);
    }

  private:
    using Corners = std::array<float, 3>;
    using Channels = std::array<float, 4>;

    HWY_INLINE static std::uint32_t bits_of(float v) { return std::bit_cast<std::uint32_t>(v); }
    HWY_INLINE std::uint32_t bits(std::size_t i, std::size_t c) const { return bits_of(value_[i][c]); }

    // The FilterPlane of each channel. Products with 1 / w are in binary32, as for every attribute
    // (rasterizer/reference/attributes.md 1.1); slopes and errors of all four channels are computed at once.
    HWY_INLINE void find_planes(double reach) {
        inverse_w_ = FilterPlane{plane_of(w_), reach};
        for (std::size_t i = 0; i < 3; ++i)
            for (std::size_t c = 0; c < 4; ++c) product_[i][c] = value_[i][c] * w_[i];
        for (std::size_t c = 0; c < 4; ++c) {
            const double w0 = product_[0][c], w1 = product_[1][c], w2 = product_[2][c];
            const auto greater = [](double a, double b) { return a < b ? b : a; };
            const double size = greater(greater(std::abs(w0), std::abs(w1)), std::abs(w2));
            w0_[c] = w0;
            d1_[c] = w1 - w0;
            d2_[c] = w2 - w0;
            error_[c] = reach * (0x1p-47 * size + 0x1p-1000);  // 0 without a filter
        }
    }

    HWY_INLINE static RationalPlane plane_of(const Corners& v) { return {{v[0], v[1], v[2]}}; }
    HWY_INLINE Corners corners(std::size_t c) const { return {product_[0][c], product_[1][c], product_[2][c]}; }

    template <bool unsnapped, class Where>
    HWY_INLINE V32 channel(std::size_t c, const Where& where, const raster::Weights& b, V32 inverse_w) const {
        if (varies_[c] == 0) return hn::Set(F32{}, value_[0][c]);
        FilterPlane plane;
        plane.w0 = w0_[c];
        plane.d1 = d1_[c];
        plane.d2 = d2_[c];
        plane.error = error_[c];
        const V32 u = rounded<unsnapped>(where, b, plane, corners(c));
        return has_w_ ? hn::Div(u, inverse_w) : u;
    }
    template <bool unsnapped, class Where>
    HWY_INLINE V32 rounded(const Where& where, const raster::Weights& b, const FilterPlane& plane,
                           const Corners& corners) const {
        return raster::rounded_plane<unsnapped>(plane, b, plane_of(corners), geometry_, index_, where);
    }

    const rasterizer::Geometry& geometry_;
    const std::uint32_t index_;
    Corners w_;
    std::array<Channels, 3> value_, product_;  // by corner
    std::array<std::uint32_t, 4> varies_;      // 0: the same bits at all corners
    std::array<double, 4> w0_, d1_, d2_, error_;
    FilterPlane inverse_w_;
    bool has_w_, is_flat_, is_grey_;
};

}  // namespace strata::pipeline::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
