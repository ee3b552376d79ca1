// rasterizer/bins.cpp - which tiles a set-up triangle may touch: its box of pixel centres, less the tiles wholly
// outside an edge; of a small triangle the box is enough. Two walks, one that counts and one that fills, so the lists have exactly the memory that they need.
// Chunks of triangles are walked in parallel: in a tile each chunk's place follows from the counts of those before it.
#include <algorithm>
#include <bit>
#include <cassert>
#include <span>
#include <stdexcept>

#include "rasterizer/coverage.h"
#include "rasterizer/geometry.h"
#include "rasterizer/parallel.h"
#include "rasterizer/small_triangles.h"

namespace strata::rasterizer {
namespace {

// The edge values at the pixel centre of `r` where they are largest decide: all three must reach a covered value.
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

// Visits the tiles of one size that a triangle may touch, in their order.
class TileWalk {
  public:
    explicit TileWalk(const Geometry& geometry)
        : geometry_{geometry}, shift_{std::countr_zero(static_cast<unsigned>(geometry.tile_size))} {}

    // The tiles of a box that is not empty.
    [[nodiscard]] Rect tiles_of(const Rect& box) const noexcept {
        const Rect& viewport = geometry_.state.viewport;
        return {(box.x0 - viewport.x0) >> shift_, (box.y0 - viewport.y0) >> shift_,
                ((box.x1 - 1 - viewport.x0) >> shift_) + 1, ((box.y1 - 1 - viewport.y0) >> shift_) + 1};
    }
    template <class Visit>
    void visit(const TriangleRecord& triangle, Visit&& visit) const {
        const int bits = geometry_.rules.subpixel_bits;
        const std::array p = geometry_.points(triangle);
        const Rect box = intersection(centre_box(p, bits), geometry_.state.viewport);
        if (box.area() == 0) return;
        const Rect tiles = tiles_of(box);
        const auto number = [&](int x, int y) {
            return static_cast<std::size_t>(y) * static_cast<std::size_t>(geometry_.tiles_x) +
                   static_cast<std::size_t>(x);
        };
        if (tiles.area() == 1) return visit(number(tiles.x0, tiles.y0));
        const TriangleEdges edges{p, geometry_.rules.tie_rule};
        for (int y = tiles.y0; y < tiles.y1; ++y)
            for (int x = tiles.x0; x < tiles.x1; ++x)
                if (may_cover(edges, rect_of(x, y, geometry_), bits)) visit(number(x, y));
    }

  private:
    const Geometry& geometry_;
    int shift_;
};

// The tiles of a triangle if they lie within 2 x 2, in 32 bits: there are at most 2^24 tiles.
class TileBlock {
  public:
    TileBlock() = default;
    // All tiles from the first to the last of a box.
    TileBlock(const Rect& tiles, std::uint32_t tiles_x) noexcept {
        const int columns = tiles.x1 - tiles.x0, rows = tiles.y1 - tiles.y0;
        if (columns > 2 || rows > 2) {
            bits_ = too_many;
            return;
        }
        const std::uint32_t row = columns == 2 ? 3 : 1;
        bits_ = static_cast<std::uint32_t>(tiles.y0) * tiles_x + static_cast<std::uint32_t>(tiles.x0);
        bits_ |= (rows == 2 ? row << 2 | row : row) << 24;
    }
    // Tiles come in ascending order.
    void add(std::uint32_t tile, std::uint32_t tiles_x) noexcept {
        if (bits_ == 0) bits_ = tile;
        const std::uint32_t distance = tile - (bits_ & tile_mask);
        const bool below = distance >= tiles_x;
        const std::uint32_t column = below ? distance - tiles_x : distance;
        bits_ |= column <= 1 ? 1u << (24 + (below ? 2 : 0) + column) : too_many;
    }
    [[nodiscard]] bool is_whole() const noexcept { return (bits_ & too_many) == 0; }
    template <class Visit>
    void visit(std::size_t tiles_x, Visit&& visit) const {
        const std::size_t first = bits_ & tile_mask;
        if (bits_ >> 24 == 1) return visit(first);  // as mostly
        for (const std::size_t corner : {0u, 1u, 2u, 3u})
            if ((bits_ >> (24 + corner) & 1u) != 0) visit(first + corner % 2 + corner / 2 * tiles_x);
    }

  private:
    static constexpr std::uint32_t tile_mask = (1u << 24) - 1, too_many = 1u << 31;
    std::uint32_t bits_ = 0;  // the first tile, four bits for it and its neighbours right and below, one for more
};

// The triangles in chunks and what each chunk has in each tile: first its count there, then where it writes next.
class ChunkedBins {
  public:
    ChunkedBins(std::size_t triangles, std::size_t tiles)
        : triangles_{triangles},
          tiles_{tiles},
          // Not so many that their counts outgrow the caches; no matter how many threads there are.
          chunks_{std::clamp<std::size_t>(std::min(triangles / 4096, (std::size_t{1} << 19) / tiles), 1, 64)},
          next_(chunks_ * tiles) {}

    // Calls body(first triangle, end, row of the chunk) for every chunk.
    template <class Body>
    void for_chunks(int threads, const Body& body) {
        parallel_for(chunks_, threads, [&](std::size_t c) {
            body(triangles_ * c / chunks_, triangles_ * (c + 1) / chunks_, &next_[c * tiles_]);
        });
    }

    // Counts become offsets, tile by tile and in a tile chunk by chunk, and `start` the offsets of the tiles.
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

// A triangle walked tile by tile.
[[nodiscard]] TileBlock counted(const TileWalk& walk, const TriangleRecord& triangle, std::uint32_t tiles_x,
                                std::uint32_t* count) {
    TileBlock block;
    walk.visit(triangle, [&](std::size_t tile) {
        ++count[tile];
        block.add(static_cast<std::uint32_t>(tile), tiles_x);
    });
    return block;
}

// Counts the triangles from `first` on in their tiles. Most lie in few tiles, which are remembered; the others are walked
// twice.
void find_homes(const Geometry& geometry, const TileWalk& walk, std::size_t first, std::span<TileBlock> home,
                std::uint32_t* count) {
    const auto tiles_x = static_cast<std::uint32_t>(geometry.tiles_x);
    const GroupRules rules{geometry.state.viewport, geometry.rules.subpixel_bits, geometry.rules.tie_rule};
    const SmallKernels& kernels = small_kernels();
    TriangleGroup group;
    for (std::size_t at = 0; at < home.size(); at += TriangleGroup::size) {
        const std::size_t triangles = std::min<std::size_t>(TriangleGroup::size, home.size() - at);
        const TriangleRecord* const record = &geometry.triangles[first + at];
        load_corners(
            geometry.corners, triangles, [&](std::size_t k) -> const auto& { return record[k].vertex; }, group);
        kernels.set_up_boxes(rules, group);
        for (std::size_t k = 0; k < triangles; ++k) {
            TileBlock block;
            const Rect box = group.box(k);
            if (group.small[k] != 0) {
                if (box.area() == 0) continue;
                block = {walk.tiles_of(box), tiles_x};
            }
            if (group.small[k] != 0 && block.is_whole())
                block.visit(tiles_x, [&](std::size_t tile) { ++count[tile]; });
            else
                block = counted(walk, geometry.triangles[first + at + k], tiles_x, count);
            home[at + k] = block;
        }
    }
}

}  // namespace

Rect tile_rect(const Geometry& geometry, std::size_t tile) {
    const auto columns = static_cast<std::size_t>(geometry.tiles_x);
    return rect_of(static_cast<int>(tile % columns), static_cast<int>(tile / columns), geometry);
}

void bin_triangles(Geometry& geometry, int tile_size, int threads) {
    assert(tile_size > 0 && std::has_single_bit(static_cast<unsigned>(tile_size)) && "tiles are powers of two");
    geometry.tile_size = tile_size;
    geometry.tiles_x = (geometry.state.viewport.width() + tile_size - 1) / tile_size;
    geometry.tiles_y = (geometry.state.viewport.height() + tile_size - 1) / tile_size;
    const std::size_t tiles = static_cast<std::size_t>(geometry.tiles_x) * static_cast<std::size_t>(geometry.tiles_y);
    geometry.bin_triangles.clear();
    geometry.bin_start.assign(tiles + 1, 0);
    if (tiles == 0) return;

    std::vector<TileBlock> home(geometry.triangles.size());
    const TileWalk walk{geometry};
    ChunkedBins bins{geometry.triangles.size(), tiles};
    bins.for_chunks(threads, [&](std::size_t begin, std::size_t end, std::uint32_t* count) {
        find_homes(geometry, walk, begin, std::span{home}.subspan(begin, end - begin), count);
    });
    bins.to_offsets(geometry.bin_start);
    geometry.bin_triangles.resize(geometry.bin_start[tiles]);
    bins.for_chunks(threads, [&](std::size_t begin, std::size_t end, std::uint32_t* next) {
        for (std::size_t i = begin; i < end; ++i) {
            const auto put = [&](std::size_t tile) {
                geometry.bin_triangles[next[tile]++] = static_cast<std::uint32_t>(i);
            };
            if (home[i].is_whole())
                home[i].visit(static_cast<std::size_t>(geometry.tiles_x), put);
            else
                walk.visit(geometry.triangles[i], put);
        }
    });
}

}  // namespace strata::rasterizer
