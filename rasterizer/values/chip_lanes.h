// rasterizer/values/chip_lanes.h - what the kernels of NV2A's interpolators take of a triangle: numbers of binary64
// alone.
//
// Rule     window_z.h, color_weights.h and cut_coordinates.h are the definitions. The kernels know
//          WeightRule::cut_edges, edge values that binary64 adds up exactly, and corners whose differences are narrow;
//          all else goes by the definitions.
// Numbers  Area at most 2^52: where the triangle covers a pixel its edge values lie in 0..area, and so does every
//          partial sum of them.
// Tests    tests/rasterizer/values/chip_lanes_test.cpp, tests/rasterizer/walk/window_z_rows_test.cpp
#pragma once
#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>

#include "rasterizer/base/two_terms.h"
#include "rasterizer/chip/cut_weight.h"
#include "rasterizer/rules/depth_code.h"
#include "rasterizer/set_up/geometry.h"
#include "rasterizer/values/pixel_weights.h"

namespace strata::rasterizer {
inline namespace strict {

// What cut_reciprocal multiplies by, 1 - d 2^-32, and which bits it keeps.
[[nodiscard]] constexpr double reciprocal_factor(const DepthHypothesis& h) noexcept {
    return 1.0 - h.reciprocal_deficit * 0x1p-32;
}
[[nodiscard]] constexpr std::uint64_t reciprocal_mask(const DepthHypothesis& h) noexcept {
    return ~std::uint64_t{0} << (53 - h.reciprocal_bits);
}

// A triangle's edges and the rule of its weights: CutWeights, or PerspectiveWeights where w differs.
struct ChipTriangle {
    PixelWeights edges;           // of PixelWeights::EdgesAlone
    std::array<double, 3> q{};    // |1 / w| cut to 24 bits
    bool is_perspective = false;  // q counts
    double low = 1.0;             // reciprocal_factor
    std::uint64_t mask = 0;       // reciprocal_mask
    // r where it is the same at every pixel: the edge values have 24 bits, and nothing is cut off them. Else 0.
    double constant_r = 0.0;

    [[nodiscard]] static bool suits(const PixelWeights& edges, const TriangleRecord& record,
                                    const DepthHypothesis& h) noexcept {
        return h.weights == WeightRule::cut_edges && record.negative_w == 0 &&
               edges.kind == PixelWeights::Kind::snapped && edges.area <= 0x1p52;
    }
    ChipTriangle(const PixelWeights& weights, const DepthHypothesis& h) noexcept
        : edges{weights}, low{reciprocal_factor(h)}, mask{reciprocal_mask(h)} {
        edges.r = 1.0;
        if (edges.area < 0x1p24) constant_r = cut_reciprocal(edges.area, h);
    }
    // Of corners whose w differ; their weights are those of PerspectiveWeights.
    ChipTriangle(const PixelWeights& weights, const DepthHypothesis& h, const std::array<float, 3>& w) noexcept
        : ChipTriangle{weights, h} {
        is_perspective = true;
        constant_r = 0.0;
        for (std::size_t i = 0; i < 3; ++i) q[i] = cut_bits(1.0 / (w[i] < 0.0f ? -double{w[i]} : double{w[i]}), 24);
    }
};

// z of the corners and the offset that fragments add, as WindowZ24 takes them.
struct WindowZCorners {
    std::array<double, 3> z;
    double offset;
};
[[nodiscard]] WindowZCorners window_z_corners(const Geometry& geometry, std::size_t triangle,
                                              const PolygonOffset& offset) noexcept;

// The corners of WindowZ24 where every product of a weight and a difference is exact in binary64.
struct NarrowWindowZ {
    std::array<double, 3> z{};
    double d10 = 0.0, d20 = 0.0, d21 = 0.0;  // z1 - z0, z2 - z0, z2 - z1; 0 below the least depth
    double offset = 0.0;
    int sum_bits = 29;
    bool is_narrow = true;  // false: the values here mean nothing

    NarrowWindowZ(const WindowZCorners& corners, const DepthHypothesis& h) noexcept;
};

// How a value in the buffer's own units becomes its code: cut, between two limits. Fixed point: the limits are codes.
struct ChipConversion {
    CodeKind kind = CodeKind::fixed;  // fixed, d16f or d24f
    double least = 0.0, greatest = 0.0;
};

// What a pass of window_z asks of a triangle: its codes, and which of its fragments the depth range removes.
struct ChipDepth {
    ChipConversion to_code;
    PolygonOffset offset;            // that fragments add (OffsetRule::fragments)
    double least = 0, greatest = 0;  // the depth range in the buffer's own units
    double low = 0, high = 0;        // and in the units of vertex z
    bool clips = false;              // ZClip::per_fragment, and no depth clamp

    // A convex combination leaves the range only if a corner does; the products are exact.
    [[nodiscard]] bool may_leave_range(const std::array<double, 3>& z) const noexcept {
        const auto [nearest, farthest] = std::minmax({z[0], z[1], z[2]});
        return clips && (nearest < low || farthest > high);
    }
};

// A vertex colour's codes at the corners, and where its channel goes; null: it is written already.
struct ColorLanes {
    std::array<std::array<std::int32_t, 3>, color_channels> codes{};
    std::array<float*, color_channels> out{};
};

// A coordinate that changes over the triangle: CutSum's terms, and where it goes.
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
    // Codes of window_z at `count` pixels; `z` is narrow.
    void (*window_z)(const ChipTriangle& t, const NarrowWindowZ& z, const std::uint16_t* x, const std::uint16_t* y,
                     int count, const ChipConversion& to, std::uint32_t* codes) noexcept;
    // Colours by 8-bit weights.
    void (*colors)(const ChipTriangle& t, const ColorLanes& colors, const std::uint16_t* x, const std::uint16_t* y,
                   int count) noexcept;
    // Coordinates by cut weights; true if some lane is beyond what the kernel knows: then the definition must do it.
    bool (*coordinates)(const ChipTriangle& t, const CoordinateLanes& coordinates, const std::uint16_t* x,
                        const std::uint16_t* y, int count) noexcept;
};

// Null where the definitions run: on the scalar set.
[[nodiscard]] const ChipKernels* chip_kernels() noexcept;

// For the kernels. values[i] of WindowZ24 at (x[i], y[i]), for every bit i of `lanes`: corners that are not narrow.
void wide_window_z(const Geometry& geometry, std::uint32_t triangle, const PolygonOffset& offset, const std::int32_t* x,
                   const std::int32_t* y, std::uint32_t lanes, double* values) noexcept;

}  // namespace strict
}  // namespace strata::rasterizer
