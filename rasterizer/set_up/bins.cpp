// rasterizer/set_up/bins.cpp - which tiles a triangle may touch: those of its box of pixel centres, minus the tiles
// completely outside one edge; for a small triangle the box is used alone. There are two passes, one that counts and
// one that fills, so that the lists have exactly the required memory. Chunks of triangles run in parallel: where a
// chunk writes in a tile's list follows from the counts of the chunks before it.
#include <algorithm>
#include <bit>
#include <span>
#include <stdexcept>

#include "rasterizer/base/parallel.h"
#include "rasterizer/base/require.h"
#include "rasterizer/coverage/coverage.h"
#include "rasterizer/coverage/small_triangles.h"
#include "rasterizer/set_up/geometry.h"
#include "rasterizer/set_up/triangle_walk.h"

namespace strata::rasterizer {
namespace {

// True if each edge covers the pixel centre of `r` at which its value is largest.
[[nodiscard]] bool may_cover(const TriangleEdges& edges, const Rect& r, int subpixel_bits) {
    for (std::size_t i = 0; i < 3; ++i) {
        const Edge& edge = edges.edge(i);
        const int x = edge.step_x() > 0 ? r.x1 - 1 : r.x0;
        const int y = edge.step_y() > 0 ? r.y1 - 1 : r.y0;
        if (edge.at(pixel_centre(x, y, subpixel_bits)) < edges.tie(i)) return false;
    }
    return true;
}

[[nodiscard]] Rect rect_of(int column, int row, const Geometry& geometry) noexcept {
    const Rect& viewport = geometry.state.viewport;
    const int x = viewport.x0 + column * geometry.tile_size, y = viewport.y0 + row * geometry.tile_size;
    return intersection({x, y, x + geometry.tile_size, y + geometry.tile_size}, viewport);
}

// Visits the tiles that a triangle may touch, in order of their numbers.
class TileWalk {
  public:
    explicit TileWalk(const Geometry& geometry)
        : geometry_{geometry}, shift_{std::countr_zero(static_cast<unsigned>(geometry.tile_size))} {}

    template <class Visit>
    void visit(const TriangleRecord& triangle, Visit&& visit) const {
        const int x0 = triangle.box.x0 >> shift_, x1 = (triangle.box.x1 - 1) >> shift_;
        const int y0 = triangle.box.y0 >> shift_, y1 = (triangle.box.y1 - 1) >> shift_;
        if (x0 == x1 && y0 == y1) return visit(number(x0, y0));  // the most common case
        if (is_small(triangle.box) || geometry_.rules.coverage == CoverageRule::float_spans) {
            for (int y = y0; y <= y1; ++y)
                for (int x = x0; x <= x1; ++x) visit(number(x, y));
            return;
        }
        const int bits = geometry_.rules.subpixel_bits;
        if (triangle.shape() != Shape::triangle) return visit_shape(triangle, {x0, y0, x1 + 1, y1 + 1}, visit);
        const TriangleEdges edges{geometry_.points(triangle), geometry_.rules.tie_rule};
        for (int y = y0; y <= y1; ++y)
            for (int x = x0; x <= x1; ++x)
                if (may_cover(edges, rect_of(x, y, geometry_), bits)) visit(number(x, y));
    }

  private:
    // The tiles of a shape's box that none of its sides excludes.
    template <class Visit>
    void visit_shape(const TriangleRecord& record, const Rect& tiles, Visit&& visit) const {
        const ShapeCoverage shape = shape_coverage(geometry_, record);
        const int margin = is_smooth(geometry_, record.shape()) ? 1 : 0;  // samples beside the centres
        for (int y = tiles.y0; y < tiles.y1; ++y)
            for (int x = tiles.x0; x < tiles.x1; ++x) {
                const Rect r = rect_of(x, y, geometry_);
                const Rect reached{r.x0 - margin, r.y0 - margin, r.x1 + margin, r.y1 + margin};
                if (may_cover(shape, reached, geometry_.rules.subpixel_bits)) visit(number(x, y));
            }
    }
    [[nodiscard]] static bool is_small(const PixelBox& box) noexcept {
        return box.x1 - box.x0 <= TriangleGroup::max_width && box.y1 - box.y0 <= TriangleGroup::max_height;
    }
    [[nodiscard]] std::size_t number(int x, int y) const noexcept {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(geometry_.tiles_x) + static_cast<std::size_t>(x);
    }

    const Geometry& geometry_;
    int shift_;
};

// Counts the triangles of each tile. Consecutive triangles mostly have the same tile, whose count is cached.
class TileCounter {
  public:
    explicit TileCounter(std::uint32_t* counts) : counts_{counts}, count_{counts[0]} {}
    ~TileCounter() { counts_[tile_] = count_; }
    TileCounter(const TileCounter&) = delete;
    TileCounter& operator=(const TileCounter&) = delete;

    // Returns the tile's count before this triangle.
    std::uint32_t add(std::size_t tile) noexcept {
        if (tile != tile_) {
            counts_[tile_] = count_;
            tile_ = tile;
            count_ = counts_[tile];
        }
        return count_++;
    }

  private:
    std::uint32_t* const counts_;
    std::size_t tile_ = 0;
    std::uint32_t count_;
};

// The triangles in chunks and, per chunk and tile, first the chunk's count and then its next write position.
class ChunkedBins {
  public:
    ChunkedBins(std::size_t triangles, std::size_t tiles)
        : triangles_{triangles},
          tiles_{tiles},
          // The number of chunks does not depend on the number of threads; it is limited so that the counts fit in the
          // caches.
          chunks_{std::clamp<std::size_t>(std::min(triangles / 4096, (std::size_t{1} << 19) / tiles), 1, 64)},
          next_(chunks_ * tiles) {}

    // Calls body(first triangle, end, the chunk's counts by tile) for every chunk.
    template <class Body>
    void for_chunks(int threads, const Body& body) {
        parallel_for(chunks_, threads, [&](std::size_t c) {
            body(triangles_ * c / chunks_, triangles_ * (c + 1) / chunks_, &next_[c * tiles_]);
        });
    }

    // Turns the counts into offsets, tile by tile and within a tile chunk by chunk; `start` receives the offsets of the
    // tiles.
    void to_offsets(std::vector<std::uint32_t>& start) {
        start.resize(tiles_ + 1);
        std::uint64_t sum = 0;
        for (std::size_t t = 0; t < tiles_; ++t) {
            start[t] = static_cast<std::uint32_t>(sum);
            for (std::size_t at = t; at < next_.size(); at += tiles_) {
                const std::uint32_t count = next_[at];
                next_[at] = static_cast<std::uint32_t>(sum);
                sum += count;
            }
            if (sum > 0xffffffffu)
                throw std::length_error("more than 2^32 triangles in the bins of a frame: take larger tiles");
        }
        start[tiles_] = static_cast<std::uint32_t>(sum);
    }

  private:
    std::size_t triangles_, tiles_, chunks_;
    std::vector<std::uint32_t> next_;
};

}  // namespace

Rect tile_rect(const Geometry& geometry, std::size_t tile) {
    const auto columns = static_cast<std::size_t>(geometry.tiles_x);
    return rect_of(static_cast<int>(tile % columns), static_cast<int>(tile / columns), geometry);
}

void bin_triangles(Geometry& geometry, int tile_size, int threads) {
    if (tile_size < 8 || tile_size > 128 || !std::has_single_bit(static_cast<unsigned>(tile_size)))
        Requirements{"bins"}.fail(FieldName{"tile_size"}, "8, 16, 32, 64 or 128", tile_size);
    geometry.tile_size = tile_size;
    geometry.tiles_x = (geometry.state.viewport.width() + tile_size - 1) / tile_size;
    geometry.tiles_y = (geometry.state.viewport.height() + tile_size - 1) / tile_size;
    const std::size_t tiles = static_cast<std::size_t>(geometry.tiles_x) * static_cast<std::size_t>(geometry.tiles_y);
    geometry.bin_triangles.clear();
    geometry.bin_start.assign(tiles + 1, 0);
    if (tiles == 0) return;

    const TileWalk walk{geometry};
    ChunkedBins bins{geometry.triangles.size(), tiles};
    // The only tile of each triangle, for the second pass; `several` also means none.
    constexpr std::uint32_t several = ~0u;
    UninitializedVector<std::uint32_t> only_tile(geometry.triangles.size());
    bins.for_chunks(threads, [&](std::size_t begin, std::size_t end, std::uint32_t* counts) {
        TileCounter count{counts};
        for (std::size_t i = begin; i < end; ++i) {
            std::uint32_t visits = 0;
            walk.visit(geometry.triangles[i], [&](std::size_t tile) {
                count.add(tile);
                only_tile[i] = ++visits == 1 ? static_cast<std::uint32_t>(tile) : several;
            });
            if (visits == 0) only_tile[i] = several;
        }
    });
    bins.to_offsets(geometry.bin_start);
    geometry.bin_triangles.resize(geometry.bin_start[tiles]);
    bins.for_chunks(threads, [&](std::size_t begin, std::size_t end, std::uint32_t* places) {
        TileCounter next{places};
        const auto put = [&](std::size_t tile, std::size_t i) {
            geometry.bin_triangles[next.add(tile)] = static_cast<std::uint32_t>(i);
        };
        for (std::size_t i = begin; i < end; ++i)
            if (only_tile[i] != several)
                put(only_tile[i], i);
            else
                walk.visit(geometry.triangles[i], [&](std::size_t tile) { put(tile, i); });
    });
}

}  // namespace strata::rasterizer
