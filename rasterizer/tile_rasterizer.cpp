#include "rasterizer/tile_rasterizer.h"

#include <algorithm>
#include <cassert>

#include "rasterizer/coverage.h"
#include "rasterizer/fragment_values.h"

namespace strata::rasterizer {
namespace {

// Whether every pixel of `box` is covered: the centres where the edge values are least decide.
[[nodiscard]] bool covers(const TriangleEdges& edges, const Rect& box, int subpixel_bits) noexcept {
    for (std::size_t i = 0; i < 3; ++i) {
        const Edge& edge = edges.edge(i);
        const int x = edge.step_x() > 0 ? box.x0 : box.x1 - 1;
        const int y = edge.step_y() > 0 ? box.y0 : box.y1 - 1;
        if (edge.at(pixel_centre(x, y, subpixel_bits)) < edges.tie(i)) return false;
    }
    return true;
}

[[nodiscard]] bool is_small(const std::array<SubpixelPoint, 3>& p, const Rect& box) noexcept {
    const auto [left, right] = std::minmax({p[0].x, p[1].x, p[2].x});
    const auto [top, bottom] = std::minmax({p[0].y, p[1].y, p[2].y});
    return box.width() <= SmallEdges::max_width && std::max(right - left, bottom - top) <= SmallEdges::max_extent;
}

[[nodiscard]] SmallEdges small_edges(const std::array<SubpixelPoint, 3>& p, TieRule rule, const Rect& box,
                                     int subpixel_bits) noexcept {
    SmallEdges small{{}, {}, {}, box.x0, box.width()};
    const SubpixelPoint first = pixel_centre(box.x0, box.y0, subpixel_bits);
    const std::int32_t area = (p[1].x - p[0].x) * (p[2].y - p[0].y) - (p[1].y - p[0].y) * (p[2].x - p[0].x);
    const std::int32_t turn = area > 0 ? 1 : -1;
    for (std::size_t i = 0; i < 3; ++i) {  // as Edge and TriangleEdges
        const SubpixelPoint from = p[(i + 1) % 3], to = p[(i + 2) % 3];
        const std::int32_t dx = turn * (to.x - from.x), dy = turn * (to.y - from.y);
        const std::int32_t tie = Edge::owns_ties(dx, dy, rule) ? 0 : 1;
        small.value[i] = dx * (first.y - from.y) - dy * (first.x - from.x) - tie;
        small.step[i] = -dy * (1 << subpixel_bits);
        small.down[i] = dx * (1 << subpixel_bits);
    }
    return small;
}

}  // namespace

// One call of draw: what is constant for it, and the batch being filled.
class TileRasterizer::Pass {
  public:
    Pass(TileRasterizer& owner, const Geometry& geometry, const DepthRequest& depth, const FragmentNeeds& needs,
         const BatchSink& sink)
        : owner_{owner},
          batch_{owner.batch_},
          geometry_{geometry},
          sink_{sink},
          kernels_{lane_kernels()},
          values_{geometry, depth, needs},
          subpixel_bits_{geometry.rules.subpixel_bits},
          clip_{intersection(owner.region_, geometry.state.viewport)} {
        if (geometry.state.scissor) clip_ = intersection(clip_, *geometry.state.scissor);
    }

    void draw(std::uint32_t index) {
        const TriangleRecord& record = geometry_.triangles[index];
        const std::array p = geometry_.points(record);
        const Rect box = intersection(centre_box(p, subpixel_bits_), clip_);
        if (box.x0 >= box.x1 || box.y0 >= box.y1) return;
        if (record.material != batch_.material) {
            flush();
            batch_.material = record.material;
        }
        const DrawnTriangle triangle{geometry_, index};
        const bool small = is_small(p, box);
        first_ = batch_.count;
        for (Rect rows = box; rows.y0 < box.y1; rows.y0 = rows.y1) {
            rows.y1 = std::min(box.y1, rows.y0 + max_span_rows);
            if (small)
                emit_small(triangle, rows);
            else
                emit(triangle, rows);
        }
        fill(triangle);
    }

    void flush() {
        if (batch_.count > 0) sink_(batch_);
        batch_.count = 0;
        first_ = 0;
        owner_.claims_.next_batch();
    }

  private:
    void find_spans(const TriangleEdges& edges, const Rect& rows) noexcept {
        RowSpan* const end = &spans_[static_cast<std::size_t>(rows.height())];
        if (covers(edges, rows, subpixel_bits_)) return std::fill(spans_.data(), end, RowSpan{rows.x0, rows.x1});
        RowWalker walker{edges, rows, subpixel_bits_};
        for (RowSpan* row = spans_.data(); row != end; ++row, walker.next_row()) {
            const PixelSpan span = walker.span();
            *row = {span.x0, span.x1};
        }
    }

    [[nodiscard]] RowRun row_run(const DrawnTriangle& triangle, const Rect& rows) const noexcept {
        const Rect& region = owner_.region_;
        return {0, rows.height(), 0, rows.y0, region.x0, region.y0, region.width(), triangle.record.primitive};
    }

    void emit(const DrawnTriangle& triangle, const Rect& rows) {
        find_spans(triangle.edges(), rows);
        RowRun run = row_run(triangle, rows);
        while (!kernels_.emit(spans_.data(), run, owner_.claims_, batch_)) fill_and_flush(triangle);
    }

    void emit_small(const DrawnTriangle& triangle, const Rect& rows) {
        const SmallEdges small =
            small_edges(geometry_.points(triangle.record), geometry_.rules.tie_rule, rows, subpixel_bits_);
        RowRun run = row_run(triangle, rows);
        while (!kernels_.emit_small(small, run, owner_.claims_, batch_)) fill_and_flush(triangle);
    }

    void fill_and_flush(const DrawnTriangle& triangle) {
        fill(triangle);
        flush();
    }

    void fill(const DrawnTriangle& triangle) {
        if (batch_.count == first_) return;
        owner_.exact_fallbacks_ += static_cast<std::uint64_t>(values_.fill(triangle, first_, batch_, owner_.weights_));
        first_ = batch_.count;
    }

    TileRasterizer& owner_;
    FragmentBatch& batch_;
    const Geometry& geometry_;
    const BatchSink& sink_;
    const LaneKernels& kernels_;
    FragmentValues values_;
    int subpixel_bits_;
    Rect clip_;
    int first_ = 0;  // the present triangle's first fragment in the batch that has no values yet
    std::array<RowSpan, max_span_rows + 1> spans_;
};

TileRasterizer::TileRasterizer(Rect region) : region_{region}, claims_{region} {}

void TileRasterizer::draw(const Geometry& geometry, std::span<const std::uint32_t> triangles, const DepthRequest& depth,
                          const FragmentNeeds& needs, BatchSink sink) {
    Pass pass{*this, geometry, depth, needs, sink};
    pass.flush();  // the claims of an earlier draw say nothing about this one
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        constexpr std::size_t far = 12, near = 6;  // what the coming triangles need is on its way
        if (i + far < triangles.size()) __builtin_prefetch(&geometry.triangles[triangles[i + far]]);
        if (i + near < triangles.size())
            for (const std::uint32_t v : geometry.triangles[triangles[i + near]].vertex)
                __builtin_prefetch(&geometry.corners[v]);
        pass.draw(triangles[i]);
    }
    pass.flush();
}

}  // namespace strata::rasterizer
