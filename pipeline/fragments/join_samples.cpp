// pipeline/fragments/join_samples.cpp - draws the triangles of every sample, as many at a time as have few pixels
// (join_samples.h).
#include "pipeline/fragments/join_samples.h"

#include <algorithm>
#include <array>
#include <vector>

#include "pipeline/stages/stage_lanes.h"
#include "rasterizer/walk/tile_rasterizer.h"

namespace strata::pipeline {

using rasterizer::Rect;

namespace {

constexpr std::uint64_t most_at_a_time = 1u << 14;  // pixels of triangles whose fragments are joined together

// The piece of a clipped triangle: its place in the fan, by the corners that it has beside the fan's first. The same
// for all samples; of a triangle that is not clipped any number.
std::uint32_t piece_of(const rasterizer::TriangleRecord& triangle) noexcept {
    const auto [least, greatest] = std::minmax_element(triangle.vertex.begin(), triangle.vertex.end());
    return std::min(*greatest - *least, PixelFragments::most_pieces - 1);
}

std::uint64_t shared_area(const rasterizer::PixelBox& box, const Rect& band) noexcept {
    // The boxes of the other samples are at most one pixel larger on every side.
    return rasterizer::intersection({box.x0 - 1, box.y0 - 1, box.x1 + 1, box.y1 + 1}, band).area();
}

// The triangles of one draw are of one piece, so that a batch tells nothing about pieces.
void join_sample(const SamplesToJoin& samples, const PrimitiveRange& range, std::size_t sample,
                 rasterizer::TileRasterizer& walk, PixelFragments& joined) {
    using rasterizer::Interpolation;
    const rasterizer::Geometry& geometry = samples.list.of_sample(sample);
    std::array<std::vector<std::uint32_t>, PixelFragments::most_pieces> pieces;
    for (const std::uint32_t triangle : triangles_in(geometry, samples.triangles(sample), range))
        pieces[piece_of(geometry.triangles[triangle])].push_back(triangle);
    const auto draw = [&](Interpolation at, std::uint32_t piece, bool again, const auto& add) {
        auto sink = [&](FragmentBatch& batch) { add(batch, samples.shade(batch, again)); };
        walk.draw_at(at, geometry, pieces[piece], samples.depth, samples.needs, rasterizer::BatchSink{sink});
    };
    const bool is_once = samples.colors == JoinedColors::once;
    for (std::uint32_t piece = 0; piece < pieces.size(); ++piece) {
        if (pieces[piece].empty()) continue;
        draw(is_once ? geometry.state.interpolation : Interpolation::centre, piece, false,
             [&](const FragmentBatch& batch, const Lanes<std::uint32_t>& kept) {
                 joined.add(batch, is_once ? kept : every_lane, kept, piece, sample);
             });
        if (is_once || !samples.needs.color) continue;
        draw(Interpolation::sample, piece, true, [&](const FragmentBatch& batch, const Lanes<std::uint32_t>& kept) {
            joined.add_colors(batch, kept, piece, sample);
        });
    }
}

}  // namespace

std::span<const std::uint32_t> triangles_in(const rasterizer::Geometry& geometry,
                                            std::span<const std::uint32_t> triangles,
                                            const PrimitiveRange& range) noexcept {
    const auto before = [&](std::uint32_t triangle, std::uint32_t primitive) {
        return geometry.triangles[triangle].primitive < primitive;
    };
    const auto first = std::lower_bound(triangles.begin(), triangles.end(), range.first, before);
    const auto last = std::lower_bound(first, triangles.end(), range.last, before);
    return triangles.subspan(static_cast<std::size_t>(first - triangles.begin()),
                             static_cast<std::size_t>(last - first));
}

// A range ends before a triangle that the first sample has; the last range has all that follow.
void join_samples(const SamplesToJoin& samples, const Rect& part, PixelFragments& joined,
                  const std::function<void(PixelBatch&)>& sink) {
    rasterizer::TileRasterizer walk{part};
    const std::span<const std::uint32_t> triangles = samples.triangles(0);
    std::size_t next = 0;
    for (PrimitiveRange range{0, 0}; range.last != ~0u; range.first = range.last) {
        std::uint64_t area = 0;
        for (range.last = ~0u; next < triangles.size(); ++next) {
            const rasterizer::TriangleRecord& triangle = samples.list.geometry.triangles[triangles[next]];
            if (area > most_at_a_time && triangle.primitive > range.first) {
                range.last = triangle.primitive;
                break;
            }
            area += shared_area(triangle.box, part);
        }
        for (std::size_t sample = 0; sample < samples.samples; ++sample)
            join_sample(samples, range, sample, walk, joined);
        joined.join(sink);
    }
}

}  // namespace strata::pipeline
