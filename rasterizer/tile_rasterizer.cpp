#include "rasterizer/tile_rasterizer.h"

#include <algorithm>
#include <cassert>

#include "rasterizer/coverage.h"
#include "rasterizer/fragment_values.h"

namespace strata::rasterizer {
namespace {

constexpr auto counting = [] {
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
        for (int y = box.y0; y < box.y1; ++y, row.next_row()) {
            const PixelSpan span = row.span();
            if (span.x0 < span.x1) add_span(source, span, row.step(), y);
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

    void add_span(const Source& source, const PixelSpan& span, const EdgeValues& step, int y) {
        const auto row =
            static_cast<std::uint32_t>(y - owner_.region_.y0) * static_cast<std::uint32_t>(owner_.region_.width());
        const std::uint32_t pixel = row + static_cast<std::uint32_t>(span.x0 - owner_.region_.x0);
        const int width = span.x1 - span.x0;
        for (int done = 0; done < width;) {
            const int count = std::min(width - done, batch_capacity - batch_.count);
            const std::uint32_t first_pixel = pixel + static_cast<std::uint32_t>(done);
            if (count == 0 || is_taken(first_pixel, count)) {
                if (batch_.count > first_) fill(source);
                flush();
                continue;
            }
            append(source, span, step, y, done, count, first_pixel);
            done += count;
        }
    }

    [[nodiscard]] bool is_taken(std::uint32_t first_pixel, int count) const noexcept {
        const std::uint32_t* stamp = &owner_.last_batch_[first_pixel];
        bool taken = false;
        for (int i = 0; i < count; ++i) taken |= stamp[i] == owner_.batch_number_;
        return taken;
    }

    // Pixels [done, done + count) of the span. Edge values are integers: exact in binary64 below 2^53, within the
    // filter's bound above.
    void append(const Source& source, const PixelSpan& span, const EdgeValues& step, int y, int done, int count,
                std::uint32_t first_pixel) noexcept {
        const auto at = static_cast<std::size_t>(batch_.count);
        const auto e1 = static_cast<double>(span.e[1] + done * step[1]),
                   e2 = static_cast<double>(span.e[2] + done * step[2]);
        const auto s1 = static_cast<double>(step[1]), s2 = static_cast<double>(step[2]);
        const double r = source.inverse_area;
        double* __restrict b1 = &owner_.weights_.b1[at];
        double* __restrict b2 = &owner_.weights_.b2[at];
        for (int i = 0; i < count; ++i) {
            b1[i] = (e1 + counting[static_cast<std::size_t>(i)] * s1) * r;
            b2[i] = (e2 + counting[static_cast<std::size_t>(i)] * s2) * r;
        }
        std::uint32_t* stamp = &owner_.last_batch_[first_pixel];
        std::uint32_t* pixels = &batch_.pixel[at];
        std::uint16_t* xs = &batch_.x[at];
        std::uint16_t* ys = &batch_.y[at];
        for (int i = 0; i < count; ++i) {
            stamp[i] = owner_.batch_number_;
            pixels[i] = first_pixel + static_cast<std::uint32_t>(i);
            xs[i] = static_cast<std::uint16_t>(span.x0 + done + i);
            ys[i] = static_cast<std::uint16_t>(y);
        }
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
    for (const std::uint32_t i : triangles) pass.draw(geometry.triangles[i]);
    pass.flush();
}

}  // namespace strata::rasterizer
