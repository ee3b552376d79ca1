// rasterizer/set_up/plain_spans_simd.cpp - plain_triangles.h for coverage by float spans, compiled once per instruction
// set.
//
// Rule     FloatSpans and covered_box of float_spans.h, one triangle per lane: the same binary32 operations in the same
//          order.
// Numbers  Positions are finite, and so are x and slopes of the lanes that are used (find_shapes): MIN and MAX get no
//          NaN, and 0 of either sign converts to the same integer.
// How kernels are written: rasterizer/reference/kernels.md. Tests: tests/rasterizer/set_up/plain_triangles_test.cpp
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "rasterizer/set_up/plain_spans_simd.cpp"
#include <limits>

#include "hwy/foreach_target.h"  // compiles this file once per instruction set
#include "hwy/highway.h"
#include "rasterizer/set_up/plain_records-inl.h"

HWY_BEFORE_NAMESPACE();
namespace strata::rasterizer::HWY_NAMESPACE {
namespace {
namespace hn = hwy::HWY_NAMESPACE;

using F = hn::Rebind<float, U>;
using VF = hn::Vec<F>;
using FloatMask = hn::Mask<F>;

HWY_INLINE VF set_float(float v) { return hn::Set(F{}, v); }
HWY_INLINE Mask for_integers(FloatMask mask) { return hn::RebindMask(I{}, mask); }

struct SpanPoint {
    VF x, y;
};
HWY_INLINE SpanPoint chosen(FloatMask is_first, const SpanPoint& a, const SpanPoint& b) {
    return {hn::IfThenElse(is_first, a.x, b.x), hn::IfThenElse(is_first, a.y, b.y)};
}

// by_height in vectors.
struct Heights {
    SpanPoint least, middle, greatest;

    HWY_INLINE explicit Heights(const SpanPoint (&p)[3]) {
        const FloatMask rises = hn::Le(p[0].y, p[1].y);
        const FloatMask rises_on = hn::Le(p[1].y, p[2].y), last_is_least = hn::Le(p[2].y, p[0].y);
        const FloatMask first_is_middle = hn::Le(p[0].y, p[2].y), last_is_low = hn::Le(p[2].y, p[1].y);
        // rises: the order is 0 1 2, 2 0 1 or 0 2 1; otherwise 1 0 2, 2 1 0 or 1 2 0.
        const FloatMask falls_last = hn::And(hn::Not(rises_on), last_is_least);
        const FloatMask falls_all = hn::And(hn::Not(first_is_middle), last_is_low);
        least = chosen(rises, chosen(falls_last, p[2], p[0]), chosen(falls_all, p[2], p[1]));
        middle = chosen(rises, chosen(rises_on, p[1], chosen(last_is_least, p[0], p[2])),
                        chosen(first_is_middle, p[0], chosen(last_is_low, p[1], p[2])));
        greatest = chosen(rises, chosen(rises_on, p[2], p[1]), chosen(first_is_middle, p[2], p[0]));
    }
};

// FloatSpans::Side in vectors.
struct SpanSide {
    VF dx, dy, slope, x, y;
    VI rows;

    HWY_INLINE SpanSide(const SpanPoint& from, const SpanPoint& to)
        : dx{hn::Sub(to.x, from.x)}, dy{hn::Sub(to.y, from.y)} {
        slope = hn::IfThenZeroElse(hn::Eq(dy, hn::Zero(F{})), hn::Div(dx, dy));
        const VF half = set_float(0.5f), first = hn::Sub(from.y, half), end = hn::Sub(to.y, half);
        y = hn::Ceil(first);
        rows = hn::ConvertTo(I{}, hn::Ceil(hn::Sub(end, y)));
        x = hn::Add(hn::Add(from.x, half), hn::Mul(hn::Sub(y, first), slope));
    }
    HWY_INLINE void advance(VI by) {
        x = hn::Add(x, hn::Mul(hn::ConvertTo(F{}, by), slope));
        y = hn::Add(y, hn::ConvertTo(F{}, by));
    }
    // x in row k, clamped to the columns [low, high] and truncated to an integer.
    HWY_INLINE VI column(VF k, VF low, VF high) const {
        return hn::ConvertTo(I{}, hn::Min(hn::Max(hn::Add(x, hn::Mul(k, slope)), low), high));
    }
    // Selects one of two sides per lane, with only the values that are still needed.
    HWY_INLINE SpanSide(FloatMask is_first, const SpanSide& a, const SpanSide& b)
        : dx{a.dx},
          dy{a.dy},
          slope{hn::IfThenElse(is_first, a.slope, b.slope)},
          x{hn::IfThenElse(is_first, a.x, b.x)},
          y{hn::IfThenElse(is_first, a.y, b.y)},
          rows{a.rows} {}
};

// Boxes of pixels [x0, x1) x [y0, y1).
struct SpanBoxes {
    VI x0, y0, x1, y1;
};

// FloatSpans::part: extends `covered` by the pixels of the rows within `box`, for the triangles in `seen`.
HWY_INLINE void see_part(const SpanSide& left, const SpanSide& right, VI rows, const SpanBoxes& box, Mask seen,
                         SpanBoxes& covered) {
    const VF low = hn::ConvertTo(F{}, box.x0), high = hn::ConvertTo(F{}, box.x1);
    const VI y = hn::ConvertTo(I{}, left.y), end = hn::Min(rows, hn::Sub(box.y1, y));
    VI k = hn::Max(hn::Zero(I{}), hn::Sub(box.y0, y));
    for (;; k = hn::Add(k, set(1))) {
        const Mask has_row = hn::And(seen, hn::Lt(k, end));
        if (hn::AllFalse(I{}, has_row)) return;
        const VF row = hn::ConvertTo(F{}, k);
        const VI x0 = left.column(row, low, high), x1 = right.column(row, low, high), at = hn::Add(y, k);
        const Mask is_drawn = hn::And(has_row, hn::Lt(x0, x1));
        covered = {hn::IfThenElse(is_drawn, hn::Min(covered.x0, x0), covered.x0),
                   hn::IfThenElse(is_drawn, hn::Min(covered.y0, at), covered.y0),
                   hn::IfThenElse(is_drawn, hn::Max(covered.x1, x1), covered.x1),
                   hn::IfThenElse(is_drawn, hn::Max(covered.y1, hn::Add(at, set(1))), covered.y1)};
    }
}

// float_box within the viewport.
HWY_INLINE SpanBoxes boxes_of(const Rect& viewport, const SpanPoint (&p)[3]) {
    const auto least = [](VF a, VF b, VF c) HWY_ATTR { return hn::ConvertTo(I{}, hn::Min(hn::Min(a, b), c)); };
    const auto most = [](VF a, VF b, VF c) HWY_ATTR { return hn::ConvertTo(I{}, hn::Max(hn::Max(a, b), c)); };
    return {hn::Max(hn::Sub(least(p[0].x, p[1].x, p[2].x), set(2)), set(viewport.x0)),
            hn::Max(hn::Sub(least(p[0].y, p[1].y, p[2].y), set(2)), set(viewport.y0)),
            hn::Min(hn::Add(most(p[0].x, p[1].x, p[2].x), set(3)), set(viewport.x1)),
            hn::Min(hn::Add(most(p[0].y, p[1].y, p[2].y), set(3)), set(viewport.y1))};
}

HWY_INLINE VF float_area(const SpanPoint (&p)[3]) {
    const VF ex = hn::Sub(p[0].x, p[2].x), ey = hn::Sub(p[0].y, p[2].y);
    const VF fx = hn::Sub(p[1].x, p[2].x), fy = hn::Sub(p[1].y, p[2].y);
    return hn::Sub(hn::Mul(ex, fy), hn::Mul(ey, fx));
}

// Returns false if a side is so flat that its x might not be finite.
HWY_INLINE bool find_shapes(const PlainTriangleRules& rules, const std::uint32_t* indices, const WindowCorner* corners,
                            std::size_t first, PlainShapes& shapes) {
    SpanPoint p[3];
    for (int i = 0; i < 3; ++i) {
        VI x, y;
        load_halves(corners, 1, indices + 3 * first + i, x, y);
        p[i] = {hn::BitCast(F{}, x), hn::BitCast(F{}, y)};
    }
    const Heights heights{p};
    SpanSide bottom{heights.least, heights.middle}, longest{heights.least, heights.greatest},
        top{heights.middle, heights.greatest};
    const VF steepest = hn::Max(hn::Max(hn::Abs(bottom.slope), hn::Abs(longest.slope)), hn::Abs(top.slope));
    if (!hn::AllTrue(F{}, hn::Lt(steepest, set_float(0x1p64f)))) return false;
    const VF area = hn::Sub(hn::Mul(longest.dx, bottom.dy), hn::Mul(bottom.dx, longest.dy));
    const VF infinity = set_float(std::numeric_limits<float>::infinity());
    const Mask is_drawn = for_integers(hn::Lt(hn::Abs(hn::Div(set_float(1.0f), area)), infinity));
    const Mask is_positive = for_integers(hn::Gt(float_area(p), hn::Zero(F{})));

    const SpanBoxes box = boxes_of(rules.group.clip, p);
    const VI zero = hn::Zero(I{});
    const VI width = hn::Max(hn::Sub(box.x1, box.x0), zero), height = hn::Max(hn::Sub(box.y1, box.y0), zero);
    const Mask is_large = hn::Gt(hn::Max(width, height), set(seen_size));
    const Mask has_box = hn::And(hn::Gt(width, zero), hn::Gt(height, zero));
    const Mask seen = hn::And(is_drawn, hn::AndNot(is_large, has_box));
    SpanBoxes covered{box.x1, box.y1, box.x0, box.y0};
    const FloatMask is_negative = hn::Lt(area, hn::Zero(F{}));
    see_part({is_negative, longest, bottom}, {is_negative, bottom, longest}, bottom.rows, box, seen, covered);
    const VI rows = bottom.rows, rest = top.rows;
    longest.advance(rows);
    see_part({is_negative, longest, top}, {is_negative, top, longest}, rest, box, seen, covered);

    const Mask is_covered = hn::And(seen, hn::Lt(covered.x0, covered.x1));
    const auto seen_or = [&](VI own, VI all) HWY_ATTR { return hn::IfThenElse(is_covered, own, all); };
    const Mask none = hn::MaskFromVec(zero);
    shapes = {hn::Not(is_drawn),
              hn::Not(is_positive),
              seen_or(covered.x0, box.x0),
              seen_or(covered.y0, box.y0),
              seen_or(hn::Sub(covered.x1, covered.x0), width),
              seen_or(hn::Sub(covered.y1, covered.y0), height),
              none,
              zero,
              hn::AndNot(is_covered, seen)};
    return true;
}

}  // namespace

SetUpPlainTriangles plain_spans_table() { return set_up_plain_group<find_shapes>; }

}  // namespace strata::rasterizer::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "rasterizer/base/simd_dispatch.h"

namespace strata::rasterizer {
STRATA_EXPORT(plain_spans_table);

SetUpPlainTriangles set_up_plain_spans() noexcept {
    if (simd_is_scalar() || std::endian::native != std::endian::little) return nullptr;
    return kernel_of(HWY_DISPATCH_TABLE(plain_spans_table))();
}

}  // namespace strata::rasterizer
#endif
