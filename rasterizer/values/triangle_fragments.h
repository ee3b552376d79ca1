// rasterizer/values/triangle_fragments.h - a triangle that is drawn, and its fragments at the end of a batch.
#pragma once
#include <cstddef>
#include <cstdint>

#include "rasterizer/coverage/fragment_batch.h"
#include "rasterizer/set_up/geometry.h"
#include "rasterizer/values/pixel_weights.h"
#include "rasterizer/values/plane.h"
#include "rasterizer/values/weight_lanes.h"

namespace strata::rasterizer {
inline namespace strict {
struct LaneKernels;  // lane_kernels.h
}

// The triangle whose fragments are computed, with its edges or weights.
struct DrawnTriangle {
    const Geometry& geometry;
    std::uint32_t index;
    const TriangleRecord& record;
    PixelWeights weights;

    DrawnTriangle(const Geometry& g, std::uint32_t i) noexcept
        : geometry{g}, index{i}, record{g.triangles[i]}, weights{g, record} {}
    // Takes the edge planes from lane `k` of a group of small triangles, where they are already set up.
    DrawnTriangle(const Geometry& g, std::uint32_t i, const TriangleGroup& group, std::size_t k) noexcept
        : geometry{g}, index{i}, record{g.triangles[i]}, weights{g, record, group, k} {}
    // The same with edge values in place of weights.
    DrawnTriangle(PixelWeights::EdgesAlone edges, const Geometry& g, std::uint32_t i) noexcept
        : geometry{g}, index{i}, record{g.triangles[i]}, weights{edges, g, record} {}
    DrawnTriangle(PixelWeights::EdgesAlone edges, const Geometry& g, std::uint32_t i, const TriangleGroup& group,
                  std::size_t k) noexcept
        : geometry{g}, index{i}, record{g.triangles[i]}, weights{edges, group, k} {}
    [[nodiscard]] TriangleEdges edges() const noexcept { return geometry.edges(record); }
};

// The fragments of one triangle: those of the batch from `first` on. Their pixel, x, y and primitive are written.
struct TriangleFragments {
    const DrawnTriangle& triangle;
    std::size_t first;
    FragmentBatch& batch;
    WeightLanes& weights;

    [[nodiscard]] int count() const noexcept { return batch.count - static_cast<int>(first); }
    [[nodiscard]] const std::uint16_t* x() const noexcept { return &batch.x[first]; }
    [[nodiscard]] const std::uint16_t* y() const noexcept { return &batch.y[first]; }
    // Must not outlive `edges`.
    [[nodiscard]] TriangleLanes lanes(const TriangleEdges& edges) const noexcept {
        return {&edges,  triangle.geometry.rules.subpixel_bits, x(), y(), &weights.b1[first], &weights.b2[first],
                count(), triangle.weights.filter_reach()};
    }
};

// Writes the weights of the fragments.
void fill_weights(const LaneKernels& kernels, const TriangleFragments& fragments) noexcept;

}  // namespace strata::rasterizer
