// pipeline/device/sample_points.h - the sample positions within a pixel.
//
// Source   pipeline/reference/fragment-stages.md 13.1.
// Tests    tests/pipeline/device/sample_points_test.cpp
#pragma once
#include <algorithm>
#include <array>
#include <span>

#include "pipeline/device/profile.h"
#include "rasterizer/rules/raster_state.h"

namespace strata::pipeline {

namespace sample_patterns {
using Point = rasterizer::SamplePoint;
inline constexpr std::array<Point, 2> two{{{12, 12}, {4, 4}}}, corner_and_centre{{{0, 0}, {8, 8}}};
inline constexpr std::array<Point, 4> four{{{6, 2}, {14, 6}, {2, 10}, {10, 14}}},
    square{{{4, 4}, {12, 4}, {4, 12}, {12, 12}}};
inline constexpr std::array<Point, 8> eight{{{9, 5}, {7, 11}, {13, 9}, {5, 3}, {3, 13}, {1, 7}, {11, 15}, {15, 1}}};
}  // namespace sample_patterns

// The positions in order of the sample index; empty if `samples` is not 2, 4 or 8, and for 8 samples of NV20.
[[nodiscard]] constexpr std::span<const rasterizer::SamplePoint> sample_points(SamplePositions positions,
                                                                               int samples) noexcept {
    using namespace sample_patterns;
    const bool is_standard = positions == SamplePositions::standard;
    if (samples == 2) return is_standard ? two : corner_and_centre;
    if (samples == 4) return is_standard ? four : square;
    if (samples == 8 && is_standard) return eight;
    return {};
}

// Makes the state that of sample `number` of a pixel, with values evaluated as it says. The profile has so many
// samples.
inline void set_sample(rasterizer::RasterState& state, SamplePositions positions, int samples, std::size_t number) {
    const auto points = sample_points(positions, samples);
    state.sample = points[number];
    const bool is_covered_apart = state.sample_coverage != rasterizer::SampleCoverage{};
    if (state.interpolation != rasterizer::Interpolation::centroid && !is_covered_apart) return;
    state.sample_count = samples;
    state.sample_number = static_cast<int>(number);
    std::copy(points.begin(), points.end(), state.samples.begin());
}

}  // namespace strata::pipeline
