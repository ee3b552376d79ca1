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

// Entries of the sorted lists: each element of a block has as many as its longest list.
std::uint64_t sorted_words(std::size_t elements, const FragmentTotals& of) {
    const std::uint64_t blocks = (elements + block_lanes - 1) / block_lanes;
    return block_lanes * std::min(of.all, blocks * of.deepest);
}

bool fits(const Replay& replay, std::size_t elements, const FragmentTotals& of) {
    return of.all * replay.bytes_per_fragment + sorted_words(elements, of) * sizeof(std::uint64_t) <= replay.bytes;
}

// A triangle has at most one fragment per pixel of its box and sample. The boxes are rarely needed: most tiles would
// fit if every element had as many fragments as there are triangles.
FragmentTotals bounds_of(const PreparedDraw& list, std::size_t tile, const Replay& replay) {
    const Rect rect = tile_rect(list.geometry, tile), viewport = list.geometry.state.viewport;
    FragmentTotals everywhere, most;
    for (std::size_t sample = 0; sample < list.samples(); ++sample) {
        const std::uint64_t triangles = list.of_sample(sample).bin(tile).size();
        everywhere.all += triangles * rect.area();
        everywhere.deepest = most.deepest = std::max(most.deepest, triangles);
    }
    if (fits(replay, rect.area() * list.samples(), everywhere)) return everywhere;
    for (std::size_t sample = 0; sample < list.samples(); ++sample)
        for (const std::uint32_t number : list.of_sample(sample).bin(tile)) {
            const auto [x0, y0, x1, y1] = list.of_sample(sample).triangles[number].box;
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
          samples_{frame.repeated()->samples()},
          fragments_(samples_ * rect_.area()) {
        constexpr rasterizer::FragmentNeeds nothing{false, false, false, false, false, false};
        rasterizer::TileRasterizer rasterizer{rect_};
        for (std::size_t sample = 0; sample < samples_; ++sample) {
            auto add = [&, first = sample * rect_.area()](FragmentBatch& batch) {
                for (std::size_t i = 0; i < static_cast<std::size_t>(batch.count); ++i)
                    ++fragments_[first + batch.pixel[i]];
            };
            const Geometry& geometry = frame.repeated()->of_sample(sample);
            rasterizer.draw(geometry, geometry.bin(tile), frame.key_request(), nothing, rasterizer::BatchSink{add});
        }
    }
    void cut(std::vector<RegionArea>& parts) const { cut(rect_, parts); }

  private:
    void cut(const Rect& part, std::vector<RegionArea>& parts) const {
        if (part.area() == 1 || fits(replay_, part.area() * samples_, depths_of(part)))
            return parts.push_back({part, tile_, Extent::tile});
        for (const Rect& half : halves(part)) cut(half, parts);
    }
    [[nodiscard]] FragmentTotals depths_of(const Rect& part) const {
        const auto width = static_cast<std::size_t>(rect_.width());
        FragmentTotals found;
        for (std::size_t sample = 0; sample < samples_; ++sample)
            for (int y = part.y0; y < part.y1; ++y)
                for (int x = part.x0; x < part.x1; ++x) {
                    const std::uint64_t own =
                        fragments_[sample * rect_.area() + static_cast<std::size_t>(y - rect_.y0) * width +
                                   static_cast<std::size_t>(x - rect_.x0)];
                    found.all += own;
                    found.deepest = std::max(found.deepest, own);
                }
        return found;
    }

    std::size_t tile_;
    Rect rect_;
    Replay replay_;
    std::size_t samples_;
    std::vector<std::uint32_t> fragments_;  // by element
};

}  // namespace

std::vector<RegionArea> tile_parts(const Frame& frame, int threads) {
    const PreparedDraw& list = *frame.repeated();
    const Geometry& geometry = list.geometry;
    const std::size_t tiles = static_cast<std::size_t>(geometry.tiles_x) * static_cast<std::size_t>(geometry.tiles_y);
    const bool cuts = frame.replay.bytes >= least_memory && frame.replay.bytes_per_fragment > 0;
    std::vector<std::vector<RegionArea>> parts(tiles);
    parallel_for(tiles, threads, [&](std::size_t tile) {
        const Rect rect = tile_rect(geometry, tile);
        if (cuts && !fits(frame.replay, rect.area() * list.samples(), bounds_of(list, tile, frame.replay)))
            CutTile{frame, tile}.cut(parts[tile]);
        else
            parts[tile].push_back({rect, tile, Extent::tile});
    });
    std::vector<RegionArea> all;
    for (const auto& of_tile : parts) all.insert(all.end(), of_tile.begin(), of_tile.end());
    return all;
}

}  // namespace strata::pipeline
