#include "rasterizer/tile_rasterizer.h"

#include <algorithm>
#include <cassert>

#include "rasterizer/coverage.h"
#include "rasterizer/fragment_values.h"

namespace strata::rasterizer {
namespace {

alignas(64) constexpr auto counting = [] {
    Lanes<double> k{};
    for (std::size_t i = 0; i < k.size(); ++i) k[i] = static_cast<double>(i);
    return k;
}();

}  // namespace

// One call of draw: what is constant for it, and the batch being filled.
class TileRasterizer::Pass {
  public:
    Pass(TileRasterizer& owner, const Geometry& geometry, const DepthRequest& depth, const FragmentNeeds& needs,
         const BatchSink& sink)
        : owner_{owner},
          batch_{owner.batch_},
          sink_{sink},
          values_{geometry, depth, needs},
          subpixel_bits_{geometry.rules.subpixel_bits},
          tie_rule_{geometry.rules.tie_rule},
          clip_{intersection(owner.region_, geometry.state.viewport)} {
        if (geometry.state.scissor) clip_ = intersection(clip_, *geometry.state.scissor);
    }

    void draw(const SetupTriangle& triangle) {
        const Rect box = intersection(centre_box(triangle.p, subpixel_bits_), clip_);
        if (box.x0 >= box.x1 || box.y0 >= box.y1) return;
        if (triangle.material != batch_.material) {
            flush();
            batch_.material = triangle.material;
        }
        const TriangleEdges edges{triangle.p, tie_rule_};
        const Source source{triangle, edges, 1.0 / static_cast<double>(edges.area())};
        first_ = batch_.count;
        RowWalker row{edges, box, subpixel_bits_};
        constexpr int narrow = 8;
        if (box.width() <= narrow) {
            for (int y = box.y0; y < box.y1; ++y, row.next_row())
                row.for_each_covered([&](int x, std::int64_t e1, std::int64_t e2) { add_pixel(source, x, y, e1, e2); });
        } else {
            for (int y = box.y0; y < box.y1; ++y, row.next_row()) {
                const PixelSpan span = row.span();
                if (span.x0 < span.x1) add_span(source, span, row.step(), y);
            }
        }
        if (batch_.count > first_) fill(source);
    }

    void flush() {
        if (batch_.count > 0) sink_(batch_);
        batch_.count = 0;
        first_ = 0;
        if (++owner_.batch_number_ == 0) {  // after 2^32 batches the stamps start again
            std::ranges::fill(owner_.last_batch_, 0u);
            owner_.batch_number_ = 1;
        }
    }

  private:
    struct Source {
        const SetupTriangle& triangle;
        const TriangleEdges& edges;
        double inverse_area;
    };

    void fill(const Source& source) {
        owner_.exact_fallbacks_ +=
            static_cast<std::uint64_t>(values_.fill(source.triangle, source.edges, first_, batch_, owner_.weights_));
    }

    [[nodiscard]] std::uint32_t row_start(int y) const noexcept {
        return static_cast<std::uint32_t>(y - owner_.region_.y0) * static_cast<std::uint32_t>(owner_.region_.width());
    }

    void add_span(const Source& source, PixelSpan span, const EdgeValues& step, int y) {
        while (span.x0 < span.x1) {
            const std::uint32_t pixel = row_start(y) + static_cast<std::uint32_t>(span.x0 - owner_.region_.x0);
            const int count = std::min(span.x1 - span.x0, usable_capacity - batch_.count);
            if (count == 0 || !claim(pixel, count)) {
                if (batch_.count > first_) fill(source);
                flush();
                continue;
            }
            append(source, span, step, y, count, pixel);
            span.x0 += count;
            for (std::size_t i = 1; i < 3; ++i) span.e[i] += count * step[i];
        }
    }

    void add_pixel(const Source& source, int x, int y, std::int64_t e1, std::int64_t e2) {
        const std::uint32_t pixel = row_start(y) + static_cast<std::uint32_t>(x - owner_.region_.x0);
        if (batch_.count == usable_capacity || owner_.last_batch_[pixel] == owner_.batch_number_) {
            if (batch_.count > first_) fill(source);
            flush();
        }
        owner_.last_batch_[pixel] = owner_.batch_number_;
        const auto at = static_cast<std::size_t>(batch_.count++);
        owner_.weights_.b1[at] = static_cast<double>(e1) * source.inverse_area;
        owner_.weights_.b2[at] = static_cast<double>(e2) * source.inverse_area;
        batch_.pixel[at] = pixel;
        batch_.x[at] = static_cast<std::uint16_t>(x);
        batch_.y[at] = static_cast<std::uint16_t>(y);
    }

    // Stamps the pixels with this batch's number; false if the batch already holds one of them.
    [[nodiscard]] bool claim(std::uint32_t first_pixel, int count) noexcept {
        std::uint32_t* const stamp = &owner_.last_batch_[first_pixel];
        const std::uint32_t now = owner_.batch_number_;
        for (int i = 0; i < count; ++i) {
            if (stamp[i] == now) return false;
            stamp[i] = now;
        }
        return true;
    }

    // The span's first `count` pixels. Edge values are integers: exact in binary64 below 2^53, within the filter's
    // bound above.
    void append(const Source& source, const PixelSpan& span, const EdgeValues& step, int y, int count,
                std::uint32_t first_pixel) noexcept {
        const auto at = static_cast<std::size_t>(batch_.count);
        const auto e1 = static_cast<double>(span.e[1]), e2 = static_cast<double>(span.e[2]);
        const auto s1 = static_cast<double>(step[1]), s2 = static_cast<double>(step[2]);
        const double r = source.inverse_area;
        double* __restrict b1 = &owner_.weights_.b1[at];
        double* __restrict b2 = &owner_.weights_.b2[at];
        std::uint32_t* __restrict pixels = &batch_.pixel[at];
        std::uint16_t* __restrict xs = &batch_.x[at];
        std::uint16_t* __restrict ys = &batch_.y[at];
        for (int i = 0; i < padded(count); ++i) {
            const double k = counting[static_cast<std::size_t>(i)];
            b1[i] = (e1 + k * s1) * r;
            b2[i] = (e2 + k * s2) * r;
        }
        for (int i = 0; i < padded(count); ++i) pixels[i] = first_pixel + static_cast<std::uint32_t>(i);
        for (int i = 0; i < padded(count); ++i) xs[i] = static_cast<std::uint16_t>(span.x0 + i);
        for (int i = 0; i < padded(count); ++i) ys[i] = static_cast<std::uint16_t>(y);
        batch_.count += count;
    }

    TileRasterizer& owner_;
    FragmentBatch& batch_;
    const BatchSink& sink_;
    FragmentValues values_;
    int subpixel_bits_;
    TieRule tie_rule_;
    Rect clip_;
    int first_ = 0;  // the present triangle's first fragment in the batch
};

TileRasterizer::TileRasterizer(Rect region) : region_{region}, last_batch_(region.area(), 0u) {}

void TileRasterizer::draw(const Geometry& geometry, std::span<const std::uint32_t> triangles, const DepthRequest& depth,
                          const FragmentNeeds& needs, BatchSink sink) {
    Pass pass{*this, geometry, depth, needs, sink};
    pass.flush();  // the stamps of an earlier draw say nothing about this one
    for (const std::uint32_t i : triangles) pass.draw(geometry.triangle(i));
    pass.flush();
}

}  // namespace strata::rasterizer
