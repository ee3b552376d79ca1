// rasterizer/walk/row_walk-inl.h - walks triangles as short rows of adjacent pixels, for passes that need no batch:
// each triangle is shaded completely, in submission order, so a pass can read, change and write the stored pixel
// directly. For *_simd.cpp only, like weights-inl.h.
//
// Rule     A pixel is visited as often, in the same order and with the same weights as TileRasterizer generates
//          fragments for it. `Shade` is a template over "planes are unsnapped": Shade<unsnapped>{state, triangle} is
//          constructed, called as (row, weights) for every row that has a covered pixel, and at last finish(number of
//          covered pixels). A Shade that also has (pixels, weights) gets the pixels of a small triangle this way,
//          several per call, and rows only for large triangles, covered from their first lane on. A Shade that
//          `takes_edges` gets the edge values of the snapped corners instead of weights, whatever the units of z.
// Numbers  Regions are at most max_row_pixels wide. Weights of Kind::snapped_wide do not occur with up to 8 subpixel
//          bits: the constants of an edge are below 2^50 then (row_walk_suits).
// Tests    tests/rasterizer/walk/rows_test.cpp
#include "hwy/highway.h"
#include "rasterizer/coverage/small_coverage-inl.h"
#include "rasterizer/values/triangle_fragments.h"
#include "rasterizer/values/weights-inl.h"
#include "rasterizer/walk/rows.h"

#if defined(STRATA_RASTERIZER_ROW_WALK_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef STRATA_RASTERIZER_ROW_WALK_INL_H
#undef STRATA_RASTERIZER_ROW_WALK_INL_H
#else
#define STRATA_RASTERIZER_ROW_WALK_INL_H
#endif

HWY_BEFORE_NAMESPACE();
namespace strata::rasterizer::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using RowMask = hn::Mask<F32>;
constexpr std::uint32_t row_lanes = hn::MaxLanes(F64{});

// Adjacent pixels (x, y), (x + 1, y) ... and which of them are covered; `pixel` is the index of the first in the
// region.
struct Row {
    std::size_t pixel;
    int x, y;
    RowMask covered;

    HWY_INLINE hn::Vec<I32> columns() const { return hn::Add(hn::Set(I32{}, x), hn::Iota(I32{}, 0)); }
    HWY_INLINE hn::Vec<I32> rows() const { return hn::Set(I32{}, y); }
};

// Pixels (x, y) at arbitrary positions: the covered ones come first, the other lanes are some pixel of the region.
struct Pixels {
    hn::Vec<U32> pixel;
    hn::Vec<I32> x, y;
    RowMask covered;

    HWY_INLINE hn::Vec<I32> columns() const { return x; }
    HWY_INLINE hn::Vec<I32> rows() const { return y; }
};

HWY_INLINE RowMask mask_of(std::uint32_t bits) {
    alignas(8) std::uint8_t bytes[8] = {static_cast<std::uint8_t>(bits)};
    return hn::LoadMaskBits(F32{}, bytes);
}
HWY_INLINE std::uint32_t bits_of(RowMask mask) {
    alignas(8) std::uint8_t bytes[8] = {};
    hn::StoreMaskBits(F32{}, mask, bytes);
    return bytes[0];
}

// The slow paths below take copies of the plane. By reference, the compiler would keep it in memory in the fast path
// too.
HWY_INLINE FilterPlane filter_of(const RationalPlane& plane, const DrawnTriangle& triangle) {
    if (HWY_UNLIKELY(plane.is_constant()))
        return constant_filter(RationalPlane{plane}, triangle.geometry, triangle.index);
    return FilterPlane{plane, triangle.weights.filter_reach()};
}

// Replaces the covered values that the filter could not decide by the exact ones.
template <class Where>
HWY_INLINE V32 decided(V32 z, hn::Vec<U32> unsure, const RationalPlane& plane, const Geometry& geometry,
                       std::uint32_t index, const Where& where) {
    const RowMask open = hn::And(where.covered, hn::RebindMask(F32{}, hn::Ne(unsure, hn::Zero(U32{}))));
    if (HWY_LIKELY(hn::AllFalse(F32{}, open))) return z;
    alignas(64) float values[row_lanes];
    alignas(64) std::int32_t x[row_lanes], y[row_lanes];
    hn::Store(z, F32{}, values);
    hn::Store(where.columns(), I32{}, x);
    hn::Store(where.rows(), I32{}, y);
    decide_lanes(RationalPlane{plane}, geometry, index, x, y, bits_of(open), values);
    return hn::Load(F32{}, values);
}

// A plane at each pixel, rounded once: the filter gives the rounding of nearly every lane, and the exact sum decides
// the others. Planes from unsnapped corners have no exact fallback: binary64 is the definition there.
template <bool unsnapped, class Where>
HWY_INLINE V32 rounded_plane(const FilterPlane& filter, const Weights& b, const RationalPlane& plane,
                             const Geometry& geometry, std::uint32_t index, const Where& where) {
    const V64 v = plane_at(filter, b);
    if constexpr (unsnapped) return hn::DemoteTo(F32{}, v);
    auto unsure = hn::Zero(U32{});
    const V32 low = rounded(v, hn::Set(F64{}, filter.error), unsure);
    return decided(low, unsure, plane, geometry, index, where);
}

// LESS of stored codes. D32F codes are compared as floats, because a clear may have stored any float.
HWY_INLINE RowMask nearer(hn::Vec<U32> code, hn::Vec<U32> stored, bool is_fixed) {
    return is_fixed ? hn::RebindMask(F32{}, hn::Lt(code, stored))
                    : hn::Lt(hn::BitCast(F32{}, code), hn::BitCast(F32{}, stored));
}

// The terms of weights that depend only on the column, or only on the row, for up to `count` pixels: `from` returns
// those of row_lanes adjacent pixels, `of` those of one pixel in all lanes.
template <int count>
class TermTable {
  public:
    HWY_INLINE void set(std::uint32_t i, const Weights& terms) {
        hn::Store(terms.b1, F64{}, b1_ + i);
        hn::Store(terms.b2, F64{}, b2_ + i);
    }
    HWY_INLINE Weights from(std::uint32_t i) const { return {hn::LoadU(F64{}, b1_ + i), hn::LoadU(F64{}, b2_ + i)}; }
    HWY_INLINE Weights of(std::uint32_t i) const { return {hn::Set(F64{}, b1_[i]), hn::Set(F64{}, b2_[i])}; }

  private:
    alignas(64) double b1_[count + row_lanes], b2_[count + row_lanes];
};

template <class Shade>
concept takes_pixels = requires(Shade shade, const Pixels& at, const Weights& b) {
    shade(at, b);
};

template <class Shade>
concept takes_edges = Shade::takes_edges;

// Draws a list of triangles in a region. `State` is the state of the pass. A Shade is constructed for each triangle (or
// for each max_span_rows rows of a large one) and destroyed after its finish().
template <template <bool> class Shade, class State>
class RowWalk {
  public:
    HWY_INLINE RowWalk(State& state, const Geometry& geometry, const Rect& region)
        : state_{state},
          geometry_{geometry},
          region_{region},
          rules_{group_rules(geometry, region)},
          kernels_{small_kernels()} {}

    void draw(std::span<const std::uint32_t> triangles) {
        if constexpr (row_lanes >= row_walk_lanes)
            draw_groups(triangles);  // not compiled for narrower instruction
                                     // sets
    }

  private:
    void draw_groups(std::span<const std::uint32_t> triangles) {
        for_each_group(geometry_, triangles, [&](std::span<const std::uint32_t> group) HWY_ATTR {
            set_up_group(geometry_, rules_, kernels_, group, group_);
            draw_group(group);
        });
    }

    [[gnu::flatten]] HWY_NOINLINE void draw_group(std::span<const std::uint32_t> triangles) {
        for (std::size_t k = 0; k < triangles.size(); ++k) {
            if (group_.reached[k] == 0) continue;
            if (group_.small[k] == 0)
                draw_large(triangles[k]);
            else if (group_.width[k] <= 8 && group_.height[k] <= 8)
                draw_small<8>(triangles[k], k, coverage_of(triangles[k], k));
            else
                draw_small<16>(triangles[k], k, SmallCoverage<false>{group_, k});
        }
    }

    // A tiny triangle's coverage was computed with its box.
    [[nodiscard]] HWY_INLINE SmallCoverage<true> coverage_of(std::uint32_t index, std::size_t k) const {
        const TriangleRecord& t = geometry_.triangles[index];
        const bool is_whole = group_.width[k] + t.box.x0 == t.box.x1 && group_.height[k] + t.box.y0 == t.box.y1;
        if (t.is_tiny && is_whole) return SmallCoverage<true>{t.covered};
        return SmallCoverage<true>{group_, k};
    }

    [[nodiscard]] HWY_INLINE std::size_t pixel(int x, int y) const {
        return static_cast<std::size_t>(y - region_.y0) * static_cast<std::size_t>(region_.width()) +
               static_cast<std::size_t>(x - region_.x0);
    }

    // `of_group`: empty, or the group and the triangle's lane in it.
    template <class... OfGroup>
    [[nodiscard]] HWY_INLINE DrawnTriangle drawn(std::uint32_t index, const OfGroup&... of_group) const {
        if constexpr (takes_edges<Shade<true>>)
            return {PixelWeights::EdgesAlone{}, geometry_, index, of_group...};
        else
            return {geometry_, index, of_group...};
    }

    template <int widest>
    HWY_INLINE void draw_small(std::uint32_t index, std::size_t k, const SmallCoverage<widest == 8>& coverage) {
        if (coverage.pixels() == 0) return;
        const DrawnTriangle triangle = drawn(index, group_, k);
        const bool unsnapped = triangle.weights.kind == PixelWeights::Kind::unsnapped;
        if constexpr (takes_pixels<Shade<true>>) {
            if (unsnapped)
                draw_pixels<true>(coverage, triangle, k);
            else
                draw_pixels<false>(coverage, triangle, k);
        } else {
            if (unsnapped)
                draw_bits<true, widest>(coverage, triangle, k);
            else
                draw_bits<false, widest>(coverage, triangle, k);
        }
    }

    // Draws a small triangle's covered pixels packed into vectors, row after row.
    template <bool unsnapped, bool within_8>
    HWY_INLINE void draw_pixels(const SmallCoverage<within_8>& coverage, const DrawnTriangle& triangle, std::size_t k) {
        const U32 d;
        const I32 di;
        alignas(64) std::uint32_t numbers[(within_8 ? 64 : 256) + block_part];
        coverage.write_numbers(numbers);
        const int x0 = static_cast<int>(group_.x0[k]), y0 = static_cast<int>(group_.y0[k]);
        const auto first = hn::Set(d, static_cast<std::uint32_t>(pixel(x0, y0)));
        const auto width = hn::Set(d, static_cast<std::uint32_t>(region_.width()));
        const WeightsAt<unsnapped> weights{triangle.weights};
        Shade<unsnapped> shade{state_, triangle};
        const auto count = static_cast<std::uint32_t>(coverage.pixels());
        for (std::uint32_t i = 0; i < count; i += row_lanes) {
            const auto covered = hn::FirstN(d, count - i);
            const auto number = hn::IfThenElseZero(covered, hn::Load(d, numbers + i));
            const auto column = coverage.column(number), row = coverage.row(number);
            const Pixels at{hn::Add(first, hn::Add(column, hn::Mul(row, width))),
                            hn::Add(hn::BitCast(di, column), hn::Set(di, x0)),
                            hn::Add(hn::BitCast(di, row), hn::Set(di, y0)), hn::RebindMask(F32{}, covered)};
            shade(at, weights.at(weights.column_terms(hn::PromoteTo(F64{}, at.x)),
                                 weights.row_terms(hn::PromoteTo(F64{}, at.y))));
        }
        shade.finish(count);
    }

    template <bool unsnapped, int widest>
    HWY_INLINE void draw_bits(const SmallCoverage<widest == 8>& coverage, const DrawnTriangle& triangle,
                              std::size_t k) {
        constexpr std::uint32_t parts = widest / row_lanes;
        const int x0 = static_cast<int>(group_.x0[k]), y0 = static_cast<int>(group_.y0[k]);
        const WeightsAt<unsnapped> at{triangle.weights};
        Shade<unsnapped> shade{state_, triangle};
        Weights columns[parts];
        TermTable<widest> row_terms;
        for (std::uint32_t part = 0; part < parts; ++part) {
            columns[part] = at.column_terms(numbers_from(x0 + static_cast<int>(part * row_lanes)));
            row_terms.set(part * row_lanes, at.row_terms(numbers_from(y0 + static_cast<int>(part * row_lanes))));
        }
        // The compiler must assume that a store to a target changes any member, so the loop's inputs are read before
        // it.
        const auto width = static_cast<std::size_t>(region_.width());
        const std::uint32_t first_row = coverage.first_row(), end_row = coverage.end_row(group_.height[k]);
        std::size_t first = pixel(x0, y0) + first_row * width;
        for (std::uint32_t row = first_row; row < end_row; ++row, first += width) {
            const std::uint32_t bits = coverage.row(row);
            const int y = y0 + static_cast<int>(row);
            const Weights terms = row_terms.of(row);
            for (std::uint32_t part = 0; part < parts; ++part) {
                const std::uint32_t own = bits >> (part * row_lanes) & ((1u << row_lanes) - 1);
                if (own == 0) continue;
                const int x = x0 + static_cast<int>(part * row_lanes);
                shade(Row{first + part * row_lanes, x, y, mask_of(own)}, at.at(columns[part], terms));
            }
        }
        shade.finish(static_cast<std::uint64_t>(coverage.pixels()));
    }

    void draw_large(std::uint32_t index) {
        const DrawnTriangle triangle = drawn(index);
        const Rect box = intersection(centre_box(geometry_.points(triangle.record), rules_.subpixel_bits), rules_.clip);
        for (Rect rows = box; rows.y0 < box.y1; rows.y0 = rows.y1) {
            rows.y1 = std::min(box.y1, rows.y0 + max_span_rows);
            find_spans(triangle.edges(), rows, rules_.subpixel_bits, spans_.data());
            if (triangle.weights.kind == PixelWeights::Kind::unsnapped)
                draw_spans<true>(triangle, rows);
            else
                draw_spans<false>(triangle, rows);
        }
    }

    // Draws a triangle by covered spans. The column terms are computed once for all rows.
    template <bool unsnapped>
    HWY_INLINE void draw_spans(const DrawnTriangle& triangle, const Rect& rows) {
        const WeightsAt<unsnapped> at{triangle.weights};
        TermTable<max_row_pixels> columns, row_terms;
        for (int i = 0; i < rows.width(); i += static_cast<int>(row_lanes))
            columns.set(static_cast<std::uint32_t>(i), at.column_terms(numbers_from(rows.x0 + i)));
        for (int i = 0; i < rows.height(); i += static_cast<int>(row_lanes))
            row_terms.set(static_cast<std::uint32_t>(i), at.row_terms(numbers_from(rows.y0 + i)));
        Shade<unsnapped> shade{state_, triangle};
        std::uint64_t pixels = 0;
        const auto width = static_cast<std::size_t>(region_.width());
        std::size_t first = pixel(rows.x0, rows.y0);
        for (int y = rows.y0; y < rows.y1; ++y, first += width) {
            const RowSpan span = spans_[static_cast<std::size_t>(y - rows.y0)];
            const Weights terms = row_terms.of(static_cast<std::uint32_t>(y - rows.y0));
            pixels += static_cast<std::uint64_t>(std::max(span.x1 - span.x0, 0));
            for (int x = span.x0; x < span.x1; x += static_cast<int>(row_lanes)) {
                const RowMask covered = hn::FirstN(F32{}, static_cast<std::size_t>(span.x1 - x));
                const Weights column = columns.from(static_cast<std::uint32_t>(x - rows.x0));
                shade(Row{first + static_cast<std::size_t>(x - rows.x0), x, y, covered}, at.at(column, terms));
            }
        }
        shade.finish(pixels);
    }

    State& state_;
    const Geometry& geometry_;
    Rect region_;
    GroupRules rules_;
    const SmallKernels& kernels_;
    TriangleGroup group_;
    std::array<RowSpan, max_span_rows + 1> spans_;
};

}  // namespace strata::rasterizer::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
