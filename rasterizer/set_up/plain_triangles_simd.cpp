// rasterizer/set_up/plain_triangles_simd.cpp - plain_triangles.h for coverage by edge functions, compiled once per
// instruction set. How kernels are written: rasterizer/reference/kernels.md. Tests:
// tests/rasterizer/set_up/plain_triangles_test.cpp
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "rasterizer/set_up/plain_triangles_simd.cpp"
#include "hwy/foreach_target.h"  // compiles this file once per instruction set
#include "hwy/highway.h"
#include "rasterizer/set_up/plain_records-inl.h"

HWY_BEFORE_NAMESPACE();
namespace strata::rasterizer::HWY_NAMESPACE {
namespace {
namespace hn = hwy::HWY_NAMESPACE;

HWY_INLINE VI least(VI a, VI b, VI c) { return hn::Min(hn::Min(a, b), c); }
HWY_INLINE VI most(VI a, VI b, VI c) { return hn::Max(hn::Max(a, b), c); }
// v, or -v if `turned` is all ones.
HWY_INLINE VI turn(VI v, VI turned) { return hn::Sub(hn::Xor(v, turned), turned); }

// find_boxes, find_areas and find_edge of small_triangles.h, in registers.
struct TriangleBoxes {
    VI x0, y0, width, height, extent;
};
HWY_INLINE TriangleBoxes boxes_of(const GroupRules& rules, const VI (&x)[3], const VI (&y)[3]) {
    const VI half = set(1 << (rules.subpixel_bits - 1));
    const int bits = rules.subpixel_bits;
    const VI left = least(x[0], x[1], x[2]), right = most(x[0], x[1], x[2]);
    const VI top = least(y[0], y[1], y[2]), bottom = most(y[0], y[1], y[2]);
    const auto first = [&](VI c, int clip) HWY_ATTR {
        return hn::Max(hn::ShiftRightSame(hn::Sub(hn::Add(c, half), set(1)), bits), set(clip));
    };
    const auto count = [&](VI c, int clip, VI begin) HWY_ATTR {
        const VI end = hn::Add(hn::ShiftRightSame(hn::Sub(c, half), bits), set(1));
        return hn::Max(hn::Sub(hn::Min(end, set(clip)), begin), hn::Zero(I{}));
    };
    TriangleBoxes b;
    b.x0 = first(left, rules.clip.x0);
    b.y0 = first(top, rules.clip.y0);
    b.width = count(right, rules.clip.x1, b.x0);
    b.height = count(bottom, rules.clip.y1, b.y0);
    b.extent = hn::Max(hn::Sub(right, left), hn::Sub(bottom, top));
    return b;
}

// An edge value at the centre of the box's first pixel, minus its tie, and its changes per pixel.
struct EdgeLanes {
    VI value, step, down;
};
HWY_INLINE EdgeLanes edge_of(const GroupRules& rules, const TriangleBoxes& b, VI from_x, VI from_y, VI to_x, VI to_y,
                             VI turned) {
    const bool left = rules.tie_rule == TieRule::top_left || rules.tie_rule == TieRule::bottom_left;
    const bool top = rules.tie_rule == TieRule::top_left || rules.tie_rule == TieRule::top_right;
    const int bits = rules.subpixel_bits;
    const VI half = set(1 << (bits - 1));
    const VI dx = turn(hn::Sub(to_x, from_x), turned), dy = turn(hn::Sub(to_y, from_y), turned);
    const VI owner = hn::IfThenElse(hn::Eq(dy, hn::Zero(I{})), top ? dx : hn::Neg(dx), left ? hn::Neg(dy) : dy);
    const VI tie = hn::BitCast(I{}, hn::ShiftRight<31>(hn::BitCast(U{}, owner)));
    const auto centre = [&](VI pixel, VI from)
                            HWY_ATTR { return hn::Sub(hn::Add(hn::ShiftLeftSame(pixel, bits), half), from); };
    const VI value = hn::Sub(hn::Mul(dx, centre(b.y0, from_y)), hn::Mul(dy, centre(b.x0, from_x)));
    return {hn::Sub(value, tie), hn::ShiftLeftSame(hn::Neg(dy), bits), hn::ShiftLeftSame(dx, bits)};
}

// The covered pixels of boxes of tiny_size pixels; unspecified for larger ones.
HWY_INLINE VI coverage_of(const TriangleBoxes& b, const EdgeLanes (&edge)[3], Mask is_tiny) {
    VI covered = hn::Zero(I{});
    VI row[3] = {edge[0].value, edge[1].value, edge[2].value};
    for (int y = 0; y < tiny_size; ++y) {
        const Mask has_row = hn::And(is_tiny, hn::Gt(b.height, set(y)));
        if (hn::AllFalse(I{}, has_row)) break;
        VI at[3] = {row[0], row[1], row[2]};
        for (int x = 0; x < tiny_size; ++x) {
            const Mask has_pixel = hn::And(has_row, hn::Gt(b.width, set(x)));
            if (hn::AllFalse(I{}, has_pixel)) break;
            const VI outside = hn::BroadcastSignBit(hn::Or(hn::Or(at[0], at[1]), at[2]));
            const VI bit = hn::AndNot(outside, set(1 << (y * tiny_size + x)));
            covered = hn::Or(covered, hn::IfThenElseZero(has_pixel, bit));
            for (int i = 0; i < 3; ++i) at[i] = hn::Add(at[i], edge[i].step);
        }
        for (int i = 0; i < 3; ++i) row[i] = hn::Add(row[i], edge[i].down);
    }
    return covered;
}

// Returns false if one of the triangles is not small.
HWY_INLINE bool find_shapes(const PlainTriangleRules& rules, const std::uint32_t* indices, const WindowCorner* corners,
                            std::size_t first, PlainShapes& shapes) {
    VI x[3], y[3];
    for (int i = 0; i < 3; ++i) load_halves(corners, 0, indices + 3 * first + i, x[i], y[i]);
    const TriangleBoxes b = boxes_of(rules.group, x, y);
    const Mask is_large =
        hn::Or(hn::Or(hn::Gt(b.width, set(TriangleGroup::max_width)), hn::Gt(b.height, set(TriangleGroup::max_height))),
               hn::Gt(b.extent, set(TriangleGroup::max_extent)));
    if (!hn::AllFalse(I{}, is_large)) return false;
    const VI area =
        hn::Sub(hn::Mul(hn::Sub(x[1], x[0]), hn::Sub(y[2], y[0])), hn::Mul(hn::Sub(y[1], y[0]), hn::Sub(x[2], x[0])));
    const VI turned = hn::BroadcastSignBit(area);
    const Mask is_degenerate = hn::Eq(area, hn::Zero(I{}));
    EdgeLanes edge[3];
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t from = (i + 1) % 3, to = (i + 2) % 3;
        edge[i] = edge_of(rules.group, b, x[from], y[from], x[to], y[to], turned);
    }
    const Mask is_tiny = hn::AndNot(is_degenerate, hn::Lt(hn::Max(b.width, b.height), set(tiny_size + 1)));
    const VI covered = coverage_of(b, edge, is_tiny);
    const Mask is_uncovered = hn::And(is_tiny, hn::Eq(covered, hn::Zero(I{})));
    shapes = {is_degenerate, hn::MaskFromVec(turned), b.x0, b.y0, b.width, b.height, is_tiny, covered, is_uncovered};
    return true;
}

}  // namespace

SetUpPlainTriangles plain_triangles_table() { return set_up_plain_group<find_shapes>; }

}  // namespace strata::rasterizer::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "rasterizer/base/simd_dispatch.h"

namespace strata::rasterizer {
STRATA_EXPORT(plain_triangles_table);

SetUpPlainTriangles set_up_plain_triangles() noexcept {
    if (simd_is_scalar() || std::endian::native != std::endian::little) return nullptr;
    return kernel_of(HWY_DISPATCH_TABLE(plain_triangles_table))();
}

bool find_tiny(const std::array<SubpixelPoint, 3>& p, const Rect& box, const RasterRules& rules,
               TriangleRecord& record) noexcept {
    const auto [left, right] = std::minmax({p[0].x, p[1].x, p[2].x});
    const auto [top, bottom] = std::minmax({p[0].y, p[1].y, p[2].y});
    record.is_tiny = std::max(box.width(), box.height()) <= tiny_size &&
                     std::max(right - left, bottom - top) <= TriangleGroup::max_extent;
    if (!record.is_tiny) return true;
    const TriangleEdges edges{p, rules.tie_rule};
    for (int y = box.y0; y < box.y1; ++y)
        for (int x = box.x0; x < box.x1; ++x) {
            const EdgeValues e = edges.at(pixel_centre(x, y, rules.subpixel_bits));
            const bool is_covered = e[0] >= edges.tie(0) && e[1] >= edges.tie(1) && e[2] >= edges.tie(2);
            const int bit = (y - box.y0) * tiny_size + (x - box.x0);
            record.covered |= static_cast<std::uint16_t>((is_covered ? 1u : 0u) << bit);
        }
    return record.covered != 0;
}

}  // namespace strata::rasterizer
#endif
