// rasterizer/values/chip_lanes.h - the inputs of the kernels for NV2A's interpolators: binary64 values per triangle.
//
// Rule     window_z.h, color_weights.h and truncated_coordinates.h are the definitions. The kernels implement
//          WeightRule::cut_edges, edge values whose sum is exact in binary64, and corners whose depth differences are
//          narrow; everything else runs the definitions.
// Numbers  The area is at most 2^52: at a covered pixel each edge value and each partial sum of them is in 0..area.
// Tests    tests/rasterizer/values/chip_lanes_test.cpp, tests/rasterizer/walk/window_z_rows_test.cpp
#pragma once
#include <array>
#include <bit>
#include <cstdint>

#include "rasterizer/base/two_terms.h"
#include "rasterizer/chip/truncated_weights.h"
#include "rasterizer/rules/depth_code.h"
#include "rasterizer/set_up/geometry.h"
#include "rasterizer/values/depth/depth_scale.h"
#include "rasterizer/values/pixel_weights.h"

namespace strata::rasterizer {
inline namespace strict {

// The factor 1 - d 2^-32 of truncated_reciprocal, and the mask of the bits that it keeps.
[[nodiscard]] constexpr double reciprocal_factor(const DepthHypothesis& h) noexcept {
    return 1.0 - h.reciprocal_deficit * 0x1p-32;
}
[[nodiscard]] constexpr std::uint64_t reciprocal_mask(const DepthHypothesis& h) noexcept {
    return ~std::uint64_t{0} << (53 - h.reciprocal_bits);
}

// A triangle's edges and the rule of its weights: TruncatedWeights, or PerspectiveWeights if w differs between the
// corners.
struct ChipTriangle {
    PixelWeights edges;           // constructed with PixelWeights::EdgesAlone
    std::array<double, 3> q{};    // |1 / w| truncated to 24 bits
    bool is_perspective = false;  // q is used
    double low = 1.0;             // reciprocal_factor
    std::uint64_t mask = 0;       // reciprocal_mask
    // r if it is the same at every pixel: the edge values have at most 24 bits, so truncation does not change them.
    // Otherwise 0.
    double constant_r = 0.0;

    [[nodiscard]] static bool suits(const PixelWeights& edges, const TriangleRecord& record,
                                    const DepthHypothesis& h) noexcept {
        return h.weights == WeightRule::cut_edges && record.negative_w() == 0 && edges.reach <= 1.0 &&
               edges.kind == PixelWeights::Kind::snapped && edges.area <= 0x1p52;
    }
    ChipTriangle(const PixelWeights& weights, const DepthHypothesis& h) noexcept
        : edges{weights}, low{reciprocal_factor(h)}, mask{reciprocal_mask(h)} {
        edges.r = 1.0;
        if (edges.area < 0x1p24) constant_r = truncated_reciprocal(edges.area, h);
    }
    // For corners whose w differ; their weights are those of PerspectiveWeights.
    ChipTriangle(const PixelWeights& weights, const DepthHypothesis& h, const std::array<float, 3>& w) noexcept
        : ChipTriangle{weights, h} {
        is_perspective = true;
        constant_r = 0.0;
        for (std::size_t i = 0; i < 3; ++i)
            q[i] = truncate_bits(1.0 / (w[i] < 0.0f ? -double{w[i]} : double{w[i]}), 24);
    }
};

// z of the corners and the polygon offset added per fragment, as WindowZ24 takes them.
struct WindowZCorners {
    std::array<double, 3> z;
    double offset;
};
[[nodiscard]] WindowZCorners window_z_corners(const Geometry& geometry, std::size_t triangle,
                                              const PolygonOffset& offset) noexcept;

// The corners of WindowZ24 if every product of a weight and a difference is exact in binary64.
struct NarrowWindowZ {
    std::array<double, 3> z{};
    double d10 = 0.0, d20 = 0.0, d21 = 0.0;  // z1 - z0, z2 - z0, z2 - z1; 0 if below the least depth
    double offset = 0.0;
    int sum_bits = 29;
    bool is_narrow = true;  // false: the other fields are not valid

    NarrowWindowZ(const WindowZCorners& corners, const DepthHypothesis& h) noexcept;
};

// A vertex colour's codes at the corners, and the output array of each channel; null if that channel is already
// written.
struct ColorLanes {
    std::array<std::array<std::int32_t, 3>, color_channels> codes{};
    std::array<float*, color_channels> out{};
};

// A coordinate that varies over the triangle: the terms of TruncatedSum, and the output array.
struct CoordinateLanes {
    static constexpr std::size_t most = 4;
    struct Term {
        double middle, first, last;
        float* out;
    };
    std::array<Term, most> term{};
    std::size_t count = 0;
};

struct ChipKernels {
    // Codes of window_z at `count` pixels; `z` must be narrow.
    void (*window_z)(const ChipTriangle& t, const NarrowWindowZ& z, const std::uint16_t* x, const std::uint16_t* y,
                     int count, const ChipConversion& to, std::uint32_t* codes) noexcept;
    // Colours by 8-bit weights.
    void (*colors)(const ChipTriangle& t, const ColorLanes& colors, const std::uint16_t* x, const std::uint16_t* y,
                   int count) noexcept;
    // Coordinates by truncated weights; true if a lane is outside the kernel's range, in which case the definition must
    // be run.
    bool (*coordinates)(const ChipTriangle& t, const CoordinateLanes& coordinates, const std::uint16_t* x,
                        const std::uint16_t* y, int count) noexcept;
};

// Null if the scalar reference is selected: the definitions run.
[[nodiscard]] const ChipKernels* chip_kernels() noexcept;

// For the kernels: sets values[i] of WindowZ24 at (x[i], y[i]) for every set bit i of `lanes`, for corners that are not
// narrow.
void wide_window_z(const Geometry& geometry, std::uint32_t triangle, const PolygonOffset& offset, const std::int32_t* x,
                   const std::int32_t* y, std::uint32_t lanes, double* values) noexcept;

}  // namespace strict
}  // namespace strata::rasterizer
