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

[[nodiscard]] std::span<const std::uint32_t> first_of(std::span<const std::uint32_t> list, std::size_t count) noexcept {
    return list.first(std::min(count, list.size()));
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
          small_{small_kernels()},
          values_{geometry, depth, needs},
          rules_{intersection(owner.region_, geometry.state.viewport), geometry.rules.subpixel_bits,
                 geometry.rules.tie_rule} {
        if (geometry.state.scissor) rules_.clip = intersection(rules_.clip, *geometry.state.scissor);
    }

    // At most TriangleGroup::size triangles.
    void draw(std::span<const std::uint32_t> triangles) {
        const auto vertices = [&](std::size_t k) -> const auto& { return geometry_.triangles[triangles[k]].vertex; };
        load_corners(geometry_.corners, triangles.size(), vertices, group_);
        small_.set_up(rules_, group_);
        for (std::size_t k = 0; k < triangles.size(); ++k) {
            if (group_.box(k).area() == 0) continue;
            const TriangleRecord& record = geometry_.triangles[triangles[k]];
            if (record.material != batch_.material) {
                flush();
                batch_.material = record.material;
            }
            if (group_.small[k] != 0)
                draw_small(triangles[k], k);
            else
                draw_large(triangles[k]);
        }
    }

    void flush() {
        if (batch_.count > 0) sink_(batch_);
        batch_.count = 0;
        first_ = 0;
        owner_.claims_.next_batch();
    }

  private:
    void draw_small(std::uint32_t index, std::size_t k) {
        const TriangleRecord& record = geometry_.triangles[index];
        const Rect& region = owner_.region_;
        const RegionPlace place{group_.x0[k] - static_cast<std::uint32_t>(region.x0),
                                group_.y0[k] - static_cast<std::uint32_t>(region.y0),
                                static_cast<std::uint32_t>(region.width()), record.primitive};
        first_ = batch_.count;
        if (!small_.emit(group_, k, place, owner_.claims_, batch_)) {
            flush();
            static_cast<void>(small_.emit(group_, k, place, owner_.claims_, batch_));
        }
        if (batch_.count > first_) fill({geometry_, index, group_, k});
    }

    void draw_large(std::uint32_t index) {
        const DrawnTriangle triangle{geometry_, index};
        const Rect box = intersection(centre_box(geometry_.points(triangle.record), rules_.subpixel_bits), rules_.clip);
        first_ = batch_.count;
        for (Rect rows = box; rows.y0 < box.y1; rows.y0 = rows.y1) {
            rows.y1 = std::min(box.y1, rows.y0 + max_span_rows);
            emit(triangle, rows);
        }
        fill(triangle);
    }

    void find_spans(const TriangleEdges& edges, const Rect& rows) noexcept {
        RowSpan* const end = &spans_[static_cast<std::size_t>(rows.height())];
        if (covers(edges, rows, rules_.subpixel_bits)) return std::fill(spans_.data(), end, RowSpan{rows.x0, rows.x1});
        RowWalker walker{edges, rows, rules_.subpixel_bits};
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
    const SmallKernels& small_;
    FragmentValues values_;
    GroupRules rules_;
    TriangleGroup group_;
    int first_ = 0;  // the present triangle's first fragment in the batch that has no values yet
    std::array<RowSpan, max_span_rows + 1> spans_;
};

TileRasterizer::TileRasterizer(Rect region) : region_{region}, claims_{region} {}

void TileRasterizer::draw(const Geometry& geometry, std::span<const std::uint32_t> triangles, const DepthRequest& depth,
                          const FragmentNeeds& needs, BatchSink sink) {
    Pass pass{*this, geometry, depth, needs, sink};
    pass.flush();  // the claims of an earlier draw say nothing about this one
    constexpr std::size_t group = TriangleGroup::size;
    for (std::size_t at = 0; at < triangles.size(); at += group) {
        const auto coming = [&](std::size_t i) { return triangles.subspan(std::min(i, triangles.size())); };
        for (const std::uint32_t t : first_of(coming(at + 2 * group), group))  // what they need is on its way
            __builtin_prefetch(&geometry.triangles[t]);
        for (const std::uint32_t t : first_of(coming(at + group), group))
            for (const std::uint32_t v : geometry.triangles[t].vertex) __builtin_prefetch(&geometry.corners[v]);
        pass.draw(first_of(coming(at), group));
    }
    pass.flush();
}

}  // namespace strata::rasterizer
