// pipeline/frame/effects.cpp - counts the fragments of tiles and of their deepest pixel (effects.h).
#include "pipeline/frame/effects.h"

#include <algorithm>
#include <numeric>

#include "rasterizer/base/float_environment.h"
#include "rasterizer/base/parallel.h"
#include "rasterizer/walk/tile_rasterizer.h"

namespace strata::pipeline {

namespace {

// Adds the fragments of one tile by material; returns the greatest number at one sample of a pixel.
std::uint32_t count_fragments(const PreparedDraw& list, std::size_t tile, std::vector<std::uint64_t>& by_material) {
    if (list.triangles_in(tile) == 0) return 0;
    const rasterizer::Rect rect = tile_rect(list.geometry, tile);
    rasterizer::TileRasterizer rasterizer{rect};
    std::uint32_t most = 0;
    for (std::size_t sample = 0; sample < list.samples(); ++sample) {
        std::vector<std::uint32_t> of_pixel(rect.area());
        auto sink = [&](const FragmentBatch& batch) {
            by_material[batch.material] += static_cast<std::uint64_t>(batch.count);
            for (std::size_t i = 0; i < static_cast<std::size_t>(batch.count); ++i) ++of_pixel[batch.pixel[i]];
        };
        constexpr rasterizer::FragmentNeeds coverage_alone{.shader_z = false, .code = false, .color = false};
        const rasterizer::Geometry& geometry = list.of_sample(sample);
        rasterizer.draw(geometry, geometry.bin(tile), {}, coverage_alone, rasterizer::BatchSink{sink});
        most = std::max(most, *std::ranges::max_element(of_pixel));
    }
    return most;
}

}  // namespace

void walk(const PreparedDraw& list, const rasterizer::DepthRequest& depth, const rasterizer::FragmentNeeds& needs,
          int threads) {
    const FloatEnvironment ours;
    parallel_for(list.geometry.bin_start.size() - 1, threads, [&](std::size_t tile) {
        auto nothing = [](const FragmentBatch&) {};
        rasterizer::TileRasterizer rasterizer{tile_rect(list.geometry, tile)};
        rasterizer.draw(list.geometry, list.geometry.bin(tile), depth, needs, rasterizer::BatchSink{nothing});
    });
}

std::uint32_t deepest_pixel(const PreparedDraw& list) {
    const FloatEnvironment ours;
    std::vector<std::uint64_t> by_material(list.materials.size());
    std::uint32_t most = 0;
    for (std::size_t tile = 0; tile + 1 < list.geometry.bin_start.size(); ++tile)
        most = std::max(most, count_fragments(list, tile, by_material));
    return most;
}

std::uint64_t fragment_count(const PreparedDraw& list) {
    const FloatEnvironment ours;
    std::vector<std::uint64_t> by_material(list.materials.size());
    for (std::size_t tile = 0; tile + 1 < list.geometry.bin_start.size(); ++tile)
        static_cast<void>(count_fragments(list, tile, by_material));
    return std::accumulate(by_material.begin(), by_material.end(), std::uint64_t{0});
}

TileCensus count_tiles(const PreparedDraw& transparent, const PreparedDraw& opaque) {
    const FloatEnvironment ours;
    TileCensus census;
    census.transparent_fragments.resize(transparent.materials.size());
    census.opaque_fragments.resize(opaque.materials.size());
    census.tiles = transparent.geometry.bin_start.size() - 1;
    for (std::size_t tile = 0; tile < census.tiles; ++tile) {
        const std::uint32_t most = count_fragments(transparent, tile, census.transparent_fragments);
        const bool has_opaque = count_fragments(opaque, tile, census.opaque_fragments) > 0;
        census.with_opaque += has_opaque ? 1 : 0;
        census.empty += most == 0 && !has_opaque ? 1 : 0;
        census.opaque_only += most == 0 && has_opaque ? 1 : 0;
        census.single += most == 1 ? 1 : 0;
        census.layered += most > 1 ? 1 : 0;
    }
    return census;
}

}  // namespace strata::pipeline
