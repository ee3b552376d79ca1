// pipeline/fragments/tile_parts.cpp - splits the tiles of a frame until their fragments fit into memory (tile_parts.h).
#include "pipeline/fragments/tile_parts.h"

#include <algorithm>

#include "pipeline/fragments/sort_levels.h"
#include "pipeline/frame/frame.h"
#include "pipeline/frame/pass.h"
#include "pipeline/vertices/prepare.h"
#include "rasterizer/base/parallel.h"
#include "rasterizer/walk/tile_rasterizer.h"

namespace strata::pipeline {

using rasterizer::Geometry;
using rasterizer::Rect;

namespace {

// The number of fragments of a region and of its deepest pixel, or upper bounds of both.
struct FragmentTotals {
    std::uint64_t all = 0, deepest = 0;
};

// With less memory, splitting costs more than it saves.
constexpr std::uint64_t least_memory = std::uint64_t{512} << 10;

// Entries of the sorted lists: each pixel of a block has as many as its longest list.
std::uint64_t sorted_words(const Rect& rect, const FragmentTotals& of) {
    const std::uint64_t blocks = (rect.area() + block_lanes - 1) / block_lanes;
    return block_lanes * std::min(of.all, blocks * of.deepest);
}

bool fits(const Replay& replay, const Rect& rect, const FragmentTotals& of) {
    return of.all * replay.bytes_per_fragment + sorted_words(rect, of) * sizeof(std::uint64_t) <= replay.bytes;
}

// A triangle has at most one fragment per pixel of its box. The boxes are rarely needed: most tiles would fit if every
// pixel had as many fragments as there are triangles.
FragmentTotals bounds_of(const Geometry& geometry, std::size_t tile, const Replay& replay) {
    const Rect rect = tile_rect(geometry, tile), viewport = geometry.state.viewport;
    const std::uint64_t triangles = geometry.bin(tile).size();
    if (const FragmentTotals everywhere{triangles * rect.area(), triangles}; fits(replay, rect, everywhere))
        return everywhere;
    FragmentTotals most{0, triangles};
    for (const std::uint32_t number : geometry.bin(tile)) {
        const auto [x0, y0, x1, y1] = geometry.triangles[number].box;
        const Rect box{viewport.x0 + x0, viewport.y0 + y0, viewport.x0 + x1, viewport.y0 + y1};
        most.all += intersection(rect, box).area();
    }
    return most;
}

class CutTile {
  public:
    CutTile(const Frame& frame, std::size_t tile)
        : tile_{tile},
          rect_{tile_rect(frame.repeated()->geometry, tile)},
          replay_{frame.replay},
          fragments_(rect_.area()) {
        constexpr rasterizer::FragmentNeeds nothing{false, false, false, false, false, false};
        auto add = [&](FragmentBatch& batch) {
            for (std::size_t i = 0; i < static_cast<std::size_t>(batch.count); ++i) ++fragments_[batch.pixel[i]];
        };
        const Geometry& geometry = frame.repeated()->geometry;
        rasterizer::TileRasterizer{rect_}.draw(geometry, geometry.bin(tile), frame.key_request(), nothing,
                                               rasterizer::BatchSink{add});
    }
    void cut(std::vector<RegionArea>& parts) const { cut(rect_, parts); }

  private:
    void cut(const Rect& part, std::vector<RegionArea>& parts) const {
        if (part.area() == 1 || fits(replay_, part, depths_of(part)))
            return parts.push_back({part, tile_, Extent::tile});
        for (const Rect& half : halves(part)) cut(half, parts);
    }
    [[nodiscard]] FragmentTotals depths_of(const Rect& part) const {
        const auto width = static_cast<std::size_t>(rect_.width());
        FragmentTotals found;
        for (int y = part.y0; y < part.y1; ++y)
            for (int x = part.x0; x < part.x1; ++x) {
                const std::uint64_t own =
                    fragments_[static_cast<std::size_t>(y - rect_.y0) * width + static_cast<std::size_t>(x - rect_.x0)];
                found.all += own;
                found.deepest = std::max(found.deepest, own);
            }
        return found;
    }

    std::size_t tile_;
    Rect rect_;
    Replay replay_;
    std::vector<std::uint32_t> fragments_;  // by pixel
};

}  // namespace

std::vector<RegionArea> tile_parts(const Frame& frame, int threads) {
    const Geometry& geometry = frame.repeated()->geometry;
    const std::size_t tiles = static_cast<std::size_t>(geometry.tiles_x) * static_cast<std::size_t>(geometry.tiles_y);
    const bool cuts = frame.replay.bytes >= least_memory && frame.replay.bytes_per_fragment > 0;
    std::vector<std::vector<RegionArea>> parts(tiles);
    parallel_for(tiles, threads, [&](std::size_t tile) {
        const Rect rect = tile_rect(geometry, tile);
        if (cuts && !fits(frame.replay, rect, bounds_of(geometry, tile, frame.replay)))
            CutTile{frame, tile}.cut(parts[tile]);
        else
            parts[tile].push_back({rect, tile, Extent::tile});
    });
    std::vector<RegionArea> all;
    for (const auto& of_tile : parts) all.insert(all.end(), of_tile.begin(), of_tile.end());
    return all;
}

}  // namespace strata::pipeline
