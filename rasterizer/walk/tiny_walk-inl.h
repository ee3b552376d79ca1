// rasterizer/walk/tiny_walk-inl.h - tiny triangles side by side, one a lane of binary64, and their pixels side by side behind them: a
// triangle of a pixel or two does not pay for a row. So do those between them that lie in 8 by 8 pixels.
// For *_simd.cpp alone, as weights-inl.h.
//
// Rule     The pixels, weights and planes of RowWalk, in its order: triangle after triangle, row after row.
// Numbers  As of small triangles.
// Tests    tests/rasterizer/walk/rows_test.cpp

#include "hwy/highway.h"
#include "rasterizer/coverage/small_coverage-inl.h"
#include "rasterizer/values/fragment_values.h"
#include "rasterizer/values/weights-inl.h"
#include "rasterizer/walk/rows.h"

#if defined(STRATA_RASTERIZER_TINY_WALK_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef STRATA_RASTERIZER_TINY_WALK_INL_H
#undef STRATA_RASTERIZER_TINY_WALK_INL_H
#else
#define STRATA_RASTERIZER_TINY_WALK_INL_H
#endif

HWY_BEFORE_NAMESPACE();
namespace strata::rasterizer::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

constexpr std::uint32_t tiny_lanes = hn::MaxLanes(F64{});
using U64 = hn::Rebind<std::uint64_t, F64>;

HWY_INLINE V64 set64(double v) { return hn::Set(F64{}, v); }

// The four words at from(k), for every lane k: a vector a word. They go from register to register: through memory a wide load
// would wait for narrow stores.
template <class From>
HWY_INLINE void load_fours(const From& from, V32 (&word)[4]) {
    const F32 d;
    const hn::CappedTag<float, 4> four;
    const auto load = [&](std::uint32_t k)
                          HWY_ATTR { return hn::LoadU(four, reinterpret_cast<const float*>(from(k))); };
    const auto lanes = [&](std::uint32_t k) HWY_ATTR {
        if constexpr (tiny_lanes == 4)
            return load(k);
        else
            return hn::Combine(d, load(k + 4), load(k));
    };
    const V32 a = lanes(0), b = lanes(1), c = lanes(2), e = lanes(3);
    const V32 even = hn::InterleaveLower(d, a, c), odd = hn::InterleaveLower(d, b, e);
    const V32 later_even = hn::InterleaveUpper(d, a, c), later_odd = hn::InterleaveUpper(d, b, e);
    word[0] = hn::InterleaveLower(d, even, odd);
    word[1] = hn::InterleaveUpper(d, even, odd);
    word[2] = hn::InterleaveLower(d, later_even, later_odd);
    word[3] = hn::InterleaveUpper(d, later_even, later_odd);
}

// Pixels of several triangles: the covered ones come first, the other lanes are the region's first. `of` fetches a triangle's value for each of its pixels.
class TinyPixels {
  public:
    hn::Vec<U32> pixel, lane;  // number in the region; which triangle's
    hn::Vec<I32> x, y;
    std::uint32_t count;

    HWY_INLINE V64 of(V64 by_triangle) const {
        return hn::TableLookupLanes(by_triangle, hn::IndicesFromVec(F64{}, hn::PromoteTo(U64{}, lane)));
    }
    HWY_INLINE hn::Mask<F32> covered() const { return hn::FirstN(F32{}, count); }
};

// LESS of the pixels' codes, one after the other, for the same pixel may come again: how many passed. `spare` is a word of no pixel.
template <bool is_fixed>
HWY_INLINE std::size_t test_in_turn(const TinyPixels& pixels, hn::Vec<U32> code, std::uint32_t* codes,
                                    std::uint32_t spare) {
    const auto is_nearer = [](std::uint32_t one, std::uint32_t stored) {
        return is_fixed ? one < stored : std::bit_cast<float>(one) < std::bit_cast<float>(stored);
    };
    const auto covered = hn::RebindMask(U32{}, pixels.covered());
    alignas(64) std::uint32_t pixel[tiny_lanes], own[tiny_lanes];
    hn::Store(hn::IfThenElse(covered, pixels.pixel, hn::Set(U32{}, spare)), U32{}, pixel);
    hn::Store(code, U32{}, own);
    std::size_t passed = 0;
    for (std::uint32_t i = 0; i < tiny_lanes; ++i) {
        std::uint32_t& stored = codes[pixel[i]];
        const bool passes = is_nearer(own[i], stored) && i < pixels.count;
        stored = passes ? own[i] : stored;
        passed += passes ? 1 : 0;
    }
    return passed;
}

// The corners' values of a plane, a triangle a lane, and the plane as the filter sees it (FilterPlane).
template <bool unsnapped>
class TinyPlane {
  public:
    HWY_INLINE TinyPlane(V64 v0, V64 v1, V64 v2) : v_{v0, v1, v2}, d1_{hn::Sub(v1, v0)}, d2_{hn::Sub(v2, v0)} {
        if constexpr (unsnapped) return;
        const V64 size = hn::Max(hn::Max(hn::Abs(v0), hn::Abs(v1)), hn::Abs(v2));
        error_ = hn::Add(hn::Mul(set64(0x1p-47), size), set64(0x1p-1000));
    }
    // At each pixel, rounded once.
    HWY_INLINE V32 at(const TinyPixels& pixels, const Weights& b, const Geometry& geometry,
                      const std::uint32_t* triangles) const {
        const V64 v = hn::Add(pixels.of(v_[0]), hn::Add(hn::Mul(b.b1, pixels.of(d1_)), hn::Mul(b.b2, pixels.of(d2_))));
        if constexpr (unsnapped) return hn::DemoteTo(F32{}, v);
        auto unsure = hn::Zero(U32{});
        const V32 low = rounded(v, pixels.of(error_), unsure);
        const auto open = hn::And(pixels.covered(), hn::RebindMask(F32{}, hn::Ne(unsure, hn::Zero(U32{}))));
        return HWY_LIKELY(hn::AllFalse(F32{}, open)) ? low : decided(low, open, pixels, geometry, triangles);
    }

  private:
    // The lanes of `open` by the exact sum.
    HWY_NOINLINE V32 decided(V32 z, hn::Mask<F32> open, const TinyPixels& pixels, const Geometry& geometry,
                             const std::uint32_t* triangles) const {
        alignas(64) float values[tiny_lanes];
        alignas(64) double v[3][tiny_lanes];
        alignas(64) std::int32_t x[tiny_lanes], y[tiny_lanes];
        alignas(64) std::uint32_t lane[tiny_lanes];
        alignas(8) std::uint8_t bits[8] = {};
        hn::Store(z, F32{}, values);
        for (std::size_t i = 0; i < 3; ++i) hn::Store(v_[i], F64{}, v[i]);
        hn::Store(pixels.x, I32{}, x);
        hn::Store(pixels.y, I32{}, y);
        hn::Store(pixels.lane, U32{}, lane);
        hn::StoreMaskBits(F32{}, open, bits);
        for (std::uint32_t i = 0; i < tiny_lanes; ++i) {
            if ((bits[0] >> i & 1) == 0) continue;
            const std::uint32_t k = lane[i];
            decide_lanes({{v[0][k], v[1][k], v[2][k]}}, geometry, triangles[k], x, y, 1u << i, values);
        }
        return hn::Load(F32{}, values);
    }

    V64 v_[3], d1_, d2_, error_ = hn::Zero(F64{});
};

// As many triangles as there are lanes.
template <bool unsnapped>
class TinyTriangles {
  public:
    // `triangles`: numbers in geometry.triangles. All are tiny; or they stand in `group` from triangle `at` on, in boxes of at most 8
    // by 8 pixels.
    HWY_INLINE TinyTriangles(const Geometry& geometry, const std::uint32_t* triangles, const Rect& clip,
                             const Rect& region, const TriangleGroup* group, std::size_t at)
        : geometry_{geometry},
          triangles_{triangles},
          width_{hn::Set(U32{}, static_cast<std::uint32_t>(region.width()))} {
        find_pixels(clip, region, group, at);
        area_ = set_up_weights();
        has_weights_ = hn::AllTrue(F64{}, hn::Ne(area_, hn::Zero(F64{})));
        r_ = hn::Div(set64(1.0), area_);
    }

    // False if unsnapped corners lie on a line: their plane is another one (PixelWeights).
    [[nodiscard]] HWY_INLINE bool has_weights() const { return has_weights_; }
    [[nodiscard]] HWY_INLINE std::uint32_t count() const { return count_; }
    [[nodiscard]] HWY_INLINE const Geometry& geometry() const { return geometry_; }
    [[nodiscard]] HWY_INLINE const std::uint32_t* triangles() const { return triangles_; }
    // Window z and 1 / w of corner i.
    [[nodiscard]] HWY_INLINE V32 z(std::size_t i) const { return z_[i]; }
    [[nodiscard]] HWY_INLINE V32 inverse_w(std::size_t i) const { return inverse_w_[i]; }

    // Those from number `first` of all covered pixels on.
    HWY_INLINE TinyPixels pixels(std::uint32_t first) const {
        const U32 d;
        const I32 di;
        TinyPixels p;
        p.count = count_ - first < tiny_lanes ? count_ - first : tiny_lanes;
        const auto is_covered = hn::FirstN(d, p.count);
        const auto number = hn::IfThenElseZero(is_covered, hn::LoadU(d, numbers_ + first));
        const auto column = hn::And(number, hn::Set(d, 7)), row = hn::And(hn::ShiftRight<3>(number), hn::Set(d, 7));
        p.lane = hn::ShiftRight<6>(number);
        const auto lane = hn::IndicesFromVec(d, p.lane);
        p.x = hn::BitCast(di, hn::Add(hn::TableLookupLanes(x_, lane), column));
        p.y = hn::BitCast(di, hn::Add(hn::TableLookupLanes(y_, lane), row));
        const auto within = hn::Add(column, hn::Mul(row, width_));
        p.pixel = hn::IfThenElseZero(is_covered, hn::Add(hn::TableLookupLanes(first_pixel_, lane), within));
        return p;
    }
    // WeightsAt of each pixel's own triangle.
    HWY_INLINE Weights weights(const TinyPixels& p) const {
        const V64 x = hn::PromoteTo(F64{}, p.x), y = hn::PromoteTo(F64{}, p.y), r = p.of(r_);
        if constexpr (unsnapped) {
            const V64 dx = hn::Sub(hn::Add(x, set64(0.5)), p.of(a_[0])),
                      dy = hn::Sub(hn::Add(y, set64(0.5)), p.of(b_[0]));
            const V64 x1 = p.of(a_[1]), y1 = p.of(b_[1]), x2 = p.of(a_[2]), y2 = p.of(b_[2]);
            return {hn::Mul(hn::Sub(hn::Mul(dx, y2), hn::Mul(dy, x2)), r),
                    hn::Mul(hn::Sub(hn::Mul(dy, x1), hn::Mul(dx, y1)), r)};
        } else {
            const Weights e = edges_at(p, x, y);
            return {hn::Mul(e.b1, r), hn::Mul(e.b2, r)};
        }
    }
    // The values of edges 1 and 2 in their place, of snapped corners.
    HWY_INLINE Weights edges(const TinyPixels& p) const {
        static_assert(!unsnapped);
        return edges_at(p, hn::PromoteTo(F64{}, p.x), hn::PromoteTo(F64{}, p.y));
    }
    // Of all triangles, and 1 by it.
    [[nodiscard]] HWY_INLINE V64 area() const { return area_; }
    [[nodiscard]] HWY_INLINE V64 inverse_area() const { return r_; }

  private:
    // Numbers of pixels: triangle above, row and column below, eight of each.
    static_assert(tiny_size == 4);

    [[nodiscard]] HWY_INLINE const TriangleRecord& record(std::uint32_t k) const {
        return geometry_.triangles[triangles_[k]];
    }
    // Of corner `i` of all triangles.
    template <class Member>
    HWY_INLINE void load_corners(std::size_t i, Member member, V32 (&word)[4]) const {
        const WindowCorner* const corners = geometry_.corners.data();
        load_fours([&](std::uint32_t k) { return &(corners[record(k).vertex[i]].*member); }, word);
    }

    HWY_INLINE Weights edges_at(const TinyPixels& p, V64 x, V64 y) const {
        const auto edge = [&](std::size_t i) HWY_ATTR {
            return hn::Add(hn::Add(hn::Mul(x, p.of(a_[i])), hn::Mul(y, p.of(b_[i]))), p.of(constant_[i]));
        };
        return {edge(1), edge(2)};
    }

    // What of PixelWeights is not a pixel's. Returns the areas.
    HWY_INLINE V64 set_up_weights() {
        V32 x[3], y[3];
        for (std::size_t i = 0; i < 3; ++i) {
            static_assert(offsetof(WindowCorner, inverse_w) == offsetof(WindowCorner, unsnapped) + 3 * sizeof(float));
            V32 word[4];
            load_corners(i, &WindowCorner::unsnapped, word);
            x[i] = word[0], y[i] = word[1], z_[i] = word[2], inverse_w_[i] = word[3];
        }
        if constexpr (unsnapped) {
            for (std::size_t i = 0; i < 3; ++i) {
                a_[i] = hn::PromoteTo(F64{}, x[i]);
                b_[i] = hn::PromoteTo(F64{}, y[i]);
            }
            for (std::size_t i = 1; i < 3; ++i) {
                a_[i] = hn::Sub(a_[i], a_[0]);
                b_[i] = hn::Sub(b_[i], b_[0]);
            }
            return hn::Sub(hn::Mul(a_[1], b_[2]), hn::Mul(a_[2], b_[1]));
        } else {
            return set_up_edges();
        }
    }
    // Integers below 2^53 all the way.
    HWY_INLINE V64 set_up_edges() {
        V64 x[3], y[3];
        for (std::size_t i = 0; i < 3; ++i) {
            V32 word[4];
            load_corners(i, &WindowCorner::p, word);
            x[i] = hn::PromoteTo(F64{}, hn::BitCast(I32{}, word[0]));
            y[i] = hn::PromoteTo(F64{}, hn::BitCast(I32{}, word[1]));
        }
        const V64 area = hn::Sub(hn::Mul(hn::Sub(x[1], x[0]), hn::Sub(y[2], y[0])),
                                 hn::Mul(hn::Sub(y[1], y[0]), hn::Sub(x[2], x[0])));
        const V64 sign = hn::CopySign(set64(1.0), area);
        const V64 unit = set64(1 << geometry_.rules.subpixel_bits), half = hn::Mul(unit, set64(0.5));
        for (std::size_t i = 1; i < 3; ++i) {
            const std::size_t from = (i + 1) % 3, to = (i + 2) % 3;
            const V64 dx = hn::Mul(sign, hn::Sub(x[to], x[from])), dy = hn::Mul(sign, hn::Sub(y[to], y[from]));
            constant_[i] = hn::Sub(hn::Mul(dx, hn::Sub(half, y[from])), hn::Mul(dy, hn::Sub(half, x[from])));
            a_[i] = hn::Mul(hn::Sub(hn::Zero(F64{}), dy), unit);
            b_[i] = hn::Mul(dx, unit);
        }
        return hn::Abs(area);
    }

    // The covered pixels of all triangles, less those outside `clip`, as numbers.
    HWY_INLINE void find_pixels(const Rect& clip, const Rect& region, const TriangleGroup* group, std::size_t at) {
        static_assert(offsetof(TriangleRecord, box) == offsetof(TriangleRecord, material) + 4 &&
                      offsetof(TriangleRecord, covered) == offsetof(TriangleRecord, material) + 14);
        const U32 d;
        V32 word[4];
        load_fours([&](std::uint32_t k) { return &record(k).material; }, word);
        const auto box = hn::BitCast(d, word[1]), own = hn::ShiftRight<16>(hn::BitCast(d, word[3]));
        const auto place = [&](auto corner, int origin)
                               HWY_ATTR { return hn::Add(corner, hn::Set(d, static_cast<std::uint32_t>(origin))); };
        x_ = place(hn::And(box, hn::Set(d, 0xffff)), geometry_.state.viewport.x0);
        y_ = place(hn::ShiftRight<16>(box), geometry_.state.viewport.y0);
        const auto is_tiny = hn::Ne(own, hn::Zero(d));  // others hold no pixels
        if (group != nullptr) {
            x_ = hn::IfThenElse(is_tiny, x_, hn::LoadU(d, group->x0.data() + at));
            y_ = hn::IfThenElse(is_tiny, y_, hn::LoadU(d, group->y0.data() + at));
        }
        first_pixel_ = hn::Add(hn::Mul(hn::Sub(y_, hn::Set(d, static_cast<std::uint32_t>(region.y0))), width_),
                               hn::Sub(x_, hn::Set(d, static_cast<std::uint32_t>(region.x0))));
        const auto columns = hn::Mul(bits_within(x_, clip.x0, clip.x1), hn::Set(d, 0x1111));
        const auto rows = hn::Mul(spread(bits_within(y_, clip.y0, clip.y1)), hn::Set(d, 0xf));
        alignas(64) std::uint32_t held[tiny_lanes], covered[tiny_lanes];
        hn::Store(own, d, held);
        hn::Store(hn::And(hn::And(own, columns), rows), d, covered);
        for (std::uint32_t k = 0; k < tiny_lanes; ++k)
            if (HWY_LIKELY(held[k] != 0))
                add_tiny(k, covered[k]);
            else if (group->reached[at + k] != 0)
                add_larger(k, SmallCoverage<true>{*group, at + k});
    }
    HWY_INLINE void add_tiny(std::uint32_t k, std::uint32_t covered) {
        const Block32 d;
        for (std::uint32_t part = 0; part < 16; part += block_part) {
            const std::uint64_t own = covered >> part & ((1u << block_part) - 1);
            const auto number = hn::Add(hn::Load(d, pixel_numbers + part), hn::Set(d, 64 * k));
            const auto mask = hn::LoadMaskBits(d, reinterpret_cast<const std::uint8_t*>(&own));
            hn::StoreU(hn::Compress(number, mask), d, numbers_ + count_);
            count_ += static_cast<std::uint32_t>(std::popcount(own));
        }
    }
    HWY_INLINE void add_larger(std::uint32_t k, const SmallCoverage<true>& coverage) {
        coverage.write_numbers(numbers_ + count_, 64 * k);
        count_ += static_cast<std::uint32_t>(coverage.pixels());
    }
    // Bit i: place + i lies in [begin, end), of tiny_size places; none if a scissor beside the region leaves an end before its beginning.
    HWY_INLINE static hn::Vec<U32> bits_within(hn::Vec<U32> place, int begin, int end) {
        const I32 di;
        const auto power = [&](int limit) HWY_ATTR {
            const auto distance = hn::Sub(hn::Set(di, limit), hn::BitCast(di, place));
            const auto near = hn::Min(hn::Max(distance, hn::Zero(di)), hn::Set(di, tiny_size));
            return hn::Shl(hn::Set(U32{}, 1), hn::BitCast(U32{}, near));
        };
        const auto bits = hn::BitCast(di, hn::Sub(power(end), power(begin)));
        return hn::BitCast(U32{}, hn::Max(bits, hn::Zero(di)));
    }
    // Bit i to bit 4 i.
    HWY_INLINE static hn::Vec<U32> spread(hn::Vec<U32> bits) {
        const U32 d;
        const auto at = [&](auto shifted, std::uint32_t bit) HWY_ATTR { return hn::And(shifted, hn::Set(d, bit)); };
        return hn::Or(hn::Or(at(bits, 1), at(hn::ShiftLeft<3>(bits), 1u << 4)),
                      hn::Or(at(hn::ShiftLeft<6>(bits), 1u << 8), at(hn::ShiftLeft<9>(bits), 1u << 12)));
    }
    alignas(64) static constexpr std::uint32_t pixel_numbers[16] = {0,  1,  2,  3,  8,  9,  10, 11,
                                                                    16, 17, 18, 19, 24, 25, 26, 27};

    const Geometry& geometry_;
    const std::uint32_t* triangles_;
    const hn::Vec<U32> width_;
    hn::Vec<U32> x_, y_, first_pixel_;  // of the box's first pixel
    V32 z_[3], inverse_w_[3];
    V64 a_[3], b_[3], constant_[3];  // unsnapped: corner 0, and 1 and 2 seen from it; snapped: steps of edges 1 and 2
    V64 area_, r_;
    std::uint32_t count_ = 0;
    bool has_weights_;
    alignas(64) std::uint32_t numbers_[64 * tiny_lanes + 16];
};

}  // namespace strata::rasterizer::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
