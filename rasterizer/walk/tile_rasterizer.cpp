// rasterizer/walk/tile_rasterizer.cpp - TileRasterizer::draw (tile_rasterizer.h): triangles to batches of fragments, by
// one of three walks: small triangles as bit masks, large ones by spans, float spans.
#include "rasterizer/walk/tile_rasterizer.h"

#include <memory>
#include <optional>

#include "rasterizer/coverage/float_spans.h"
#include "rasterizer/coverage/line_stipple.h"
#include "rasterizer/set_up/triangle_walk.h"
#include "rasterizer/values/fragment_values.h"
#include "rasterizer/values/lane_kernels.h"
#include "rasterizer/walk/pixel_shading.h"

namespace strata::rasterizer {

// One call of draw: its constants, and the batch being filled.
class TileRasterizer::Pass {
  public:
    Pass(TileRasterizer& owner, Interpolation at, const Geometry& geometry, const DepthRequest& depth,
         const FragmentNeeds& needs, const BatchSink& sink)
        : owner_{owner},
          batch_{owner.batch_},
          geometry_{geometry},
          sink_{sink},
          kernels_{lane_kernels()},
          small_{small_kernels()},
          values_{geometry, depth, PixelShading::is_used(at, needs) ? PixelShading::of_sample(needs) : needs},
          has_colors_{needs.color},
          rules_{group_rules(geometry, owner.region_)} {
        if (PixelShading::is_used(at, needs)) shading_ = std::make_unique<PixelShading>(at, geometry, depth, needs);
    }

    void draw(std::span<const std::uint32_t> triangles) {
        flush();  // the claims of an earlier draw do not apply to this one
        const bool by_spans = geometry_.rules.coverage == CoverageRule::float_spans;
        const auto draw_part = [&](auto group) {
            if (by_spans) {
                for (const std::uint32_t t : group) draw_by_spans(t);
            } else {
                set_up_group(geometry_, rules_, small_, group, group_);
                draw_group(group);
            }
        };
        for_each_group(geometry_, triangles, draw_part, has_colors_);
        flush();
    }

    void flush() {
        if (batch_.count > 0) sink_(batch_);
        batch_.count = 0;
        first_ = 0;
        owner_.claims_.next_batch();
    }

  private:
    void draw_group(std::span<const std::uint32_t> triangles) {
        for (std::size_t k = 0; k < triangles.size(); ++k) {
            const TriangleRecord& record = geometry_.triangles[triangles[k]];
            if (group_.reached[k] == 0 && record.special == 0) continue;
            use_material(record.material);
            if (group_.small[k] != 0 && record.special == 0)
                draw_small(triangles[k], k);
            else
                draw_large(triangles[k]);
        }
    }

    // A batch has one material, so its shading is chosen once for all its fragments.
    void use_material(std::uint32_t material) {
        if (material != batch_.material) flush();
        batch_.material = material;
    }

    void draw_by_spans(std::uint32_t index) {
        const TriangleRecord& record = geometry_.triangles[index];
        if (record.shape() == Shape::triangle) return draw_float_spans(index);
        use_material(record.material);
        draw_large(index);
    }

    // Consecutive rows are emitted together. If the upper and the lower part of a triangle share a row, the rows of the
    // second part are emitted separately.
    void draw_float_spans(std::uint32_t index) {
        const FloatSpans spans{geometry_.positions(geometry_.triangles[index])};
        if (!spans.is_drawn()) return;
        int first_y = 0, rows = 0;
        std::optional<DrawnTriangle> triangle;  // constructed on demand, because most triangles have no pixel in a
                                                // region
        const auto emit_rows = [&] {
            if (!triangle) use_material(triangle.emplace(geometry_, index).record.material);
            RowRun run = row_run(*triangle, {0, first_y, 0, first_y + rows});
            while (!kernels_.emit(spans_.data(), run, owner_.claims_, batch_)) fill_and_flush(*triangle);
        };
        spans.visit(rules_.clip, [&](int y, int x0, int x1) {
            if (rows > 0 && (y != first_y + rows || rows == max_span_rows)) {
                emit_rows();
                rows = 0;
            }
            if (rows == 0) first_y = y;
            spans_[static_cast<std::size_t>(rows++)] = {x0, x1};
        });
        if (rows == 0) return;
        emit_rows();
        fill(*triangle);
    }

    void draw_small(std::uint32_t index, std::size_t k) {
        const TriangleRecord& record = geometry_.triangles[index];
        const Rect& region = owner_.region_;
        const RegionOrigin origin{group_.x0[k] - static_cast<std::uint32_t>(region.x0),
                                  group_.y0[k] - static_cast<std::uint32_t>(region.y0),
                                  static_cast<std::uint32_t>(region.width()), record.primitive};
        // emit fails if the batch already contains one of the triangle's pixels or has too little room: the batch is
        // flushed. An empty batch has room for any small triangle.
        if (!small_.emit(group_, k, origin, owner_.claims_, batch_)) {
            flush();
            static_cast<void>(small_.emit(group_, k, origin, owner_.claims_, batch_));
        }
        if (batch_.count > first_) fill({geometry_, index, group_, k});
    }

    void draw_large(std::uint32_t index) {
        const DrawnTriangle triangle{geometry_, index};
        const Rect box = drawn_box(triangle.record);
        if (triangle.record.shape() != Shape::triangle) shape_ = shape_coverage(geometry_, triangle.record);
        for (Rect rows = box; rows.y0 < box.y1; rows.y0 = rows.y1) {
            rows.y1 = std::min(box.y1, rows.y0 + max_span_rows);
            emit(triangle, rows);
        }
        fill(triangle);
    }

    // The box of a line or point is in the record. With a negative w the triangle extends beyond its corners.
    [[nodiscard]] Rect drawn_box(const TriangleRecord& record) const noexcept {
        if (record.special == 0)
            return intersection(centre_box(geometry_.points(record), rules_.subpixel_bits), rules_.clip);
        if (record.shape() == Shape::triangle) return rules_.clip;
        const Rect& viewport = geometry_.state.viewport;
        const PixelBox& box = record.box;
        return intersection({viewport.x0 + box.x0, viewport.y0 + box.y0, viewport.x0 + box.x1, viewport.y0 + box.y1},
                            rules_.clip);
    }

    // The covered span of each of `rows`.
    void find_spans_of(const TriangleRecord& record, const Rect& rows) noexcept {
        if (record.shape() == Shape::triangle)
            return find_spans(TriangleEdges{geometry_.points(record), geometry_.rules.tie_rule, record.negative_w()},
                              rows, rules_.subpixel_bits, spans_.data());
        for (int y = rows.y0; y < rows.y1; ++y)
            spans_[static_cast<std::size_t>(y - rows.y0)] =
                is_smooth(geometry_, record.shape())
                    ? touched_span(shape_, {rows.x0, rows.x1}, y, rules_.subpixel_bits)
                    : covered_span(shape_, {rows.x0, rows.x1}, y, rules_.subpixel_bits);
    }

    [[nodiscard]] RowRun row_run(const DrawnTriangle& triangle, const Rect& rows) const noexcept {
        const Rect& region = owner_.region_;
        return {0, rows.height(), 0, rows.y0, region.x0, region.y0, region.width(), triangle.record.primitive};
    }

    // The kernel stops if the batch is full or contains the next pixel, and continues with an empty one.
    void emit(const DrawnTriangle& triangle, const Rect& rows) {
        find_spans_of(triangle.record, rows);
        RowRun run = row_run(triangle, rows);
        while (!kernels_.emit(spans_.data(), run, owner_.claims_, batch_)) fill_and_flush(triangle);
    }

    void fill_and_flush(const DrawnTriangle& triangle) {
        fill(triangle);
        flush();
    }

    void fill(const DrawnTriangle& triangle) {
        const Shape shape = triangle.record.shape();
        const bool has_samples = is_smooth(geometry_, shape);
        if (geometry_.state.polygon_stipple && is_polygon(shape))
            keep([pattern = *geometry_.state.polygon_stipple](std::uint32_t x, std::uint32_t y) {
                return (pattern[y % 32] << (x % 32) & 0x80000000u) != 0;
            });
        if (geometry_.state.line_stipple && shape == Shape::line) keep_stippled(triangle);
        if (has_samples) keep([this](int x, int y) { return samples_at(x, y) > 0; });
        if (batch_.count == first_) return;
        int fallbacks = values_.fill(triangle, first_, batch_, owner_.weights_);
        if (shading_ != nullptr && batch_.count > first_)
            fallbacks += shading_->fill(triangle.index, first_, batch_, owner_.weights_);
        if (has_colors_ && has_samples)
            for (auto i = static_cast<std::size_t>(first_); i < static_cast<std::size_t>(batch_.count); ++i)
                batch_.color[3][i] *= smooth_alpha(samples_at(batch_.x[i], batch_.y[i]));
        owner_.exact_fallbacks_ += static_cast<std::uint64_t>(fallbacks);
        first_ = batch_.count;
    }

    void keep_stippled(const DrawnTriangle& line) noexcept {
        const auto [first, a, b] = geometry_.points(line.record);
        const StippleRun run = stipple_run(a, b, geometry_.state.viewport, rules_.subpixel_bits);
        const std::int64_t start = geometry_.stipple_start[line.index];
        keep([&](int x, int y) { return is_kept(*geometry_.state.line_stipple, start + run.number(x, y)); });
    }

    [[nodiscard]] int samples_at(int x, int y) const noexcept {
        return covered_samples(shape_, x, y, rules_.subpixel_bits);
    }

    // Drops the fragments since first_ at which `is_kept` does not hold; their values are not computed yet.
    template <class IsKept>
    void keep(const IsKept& is_kept) noexcept {
        auto kept = static_cast<std::size_t>(first_);
        for (auto i = kept; i < static_cast<std::size_t>(batch_.count); ++i)
            if (is_kept(batch_.x[i], batch_.y[i])) move_lane(i, kept++, batch_, owner_.weights_);
        batch_.count = static_cast<int>(kept);
    }

    TileRasterizer& owner_;
    FragmentBatch& batch_;
    const Geometry& geometry_;
    const BatchSink& sink_;
    const LaneKernels& kernels_;
    const SmallKernels& small_;
    FragmentValues values_;
    std::unique_ptr<PixelShading> shading_;  // null: all values are those of the sample
    bool has_colors_;
    GroupRules rules_;
    TriangleGroup group_;
    ShapeCoverage shape_;  // of the current shape that is not a triangle
    // The current triangle's first fragment in the batch without values; between triangles all fragments have values.
    int first_ = 0;
    std::array<RowSpan, max_span_rows + 1> spans_;
};

TileRasterizer::TileRasterizer(Rect region) : region_{region}, claims_{region} {}

void TileRasterizer::draw_at(Interpolation at, const Geometry& geometry, std::span<const std::uint32_t> triangles,
                             const DepthRequest& depth, const FragmentNeeds& needs, BatchSink sink) {
    Pass pass{*this, at, geometry, depth, needs, sink};
    pass.draw(triangles);
}

}  // namespace strata::rasterizer
