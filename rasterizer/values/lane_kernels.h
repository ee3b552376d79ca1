// rasterizer/values/lane_kernels.h - the inner loops of rasterization as a table of functions, one table per
// instruction set, and their scalar reference.
//
// Rule     The scalar reference below is the definition; every instruction set gives the same bits (simd.h). `depth`
//          has no scalar reference of its own: its meaning is DepthSteps::fill, which runs if `depth` is null or a
//          lane is not certain.
// Numbers  Loops run over whole blocks of lanes and may write up to 15 lanes past the count: usable_capacity.
// Tests    tests/rasterizer/walk/tile_rasterizer_test.cpp runs every available set against the scalar reference.
#pragma once
#include <algorithm>
#include <cstdint>

#include "rasterizer/coverage/pixel_claims.h"
#include "rasterizer/set_up/triangle_walk.h"
#include "rasterizer/values/float_planes.h"
#include "rasterizer/values/pixel_weights.h"
#include "rasterizer/values/plane.h"

namespace strata::rasterizer {
inline namespace strict {

// The rows of one triangle that are still to be appended to a batch: `row` is the next one of `rows`, and its pixels
// [..., taken) are already in the batch. y0 is the surface row of row 0.
struct RowRun {
    int row, rows;
    int taken;
    int y0;
    int region_x0, region_y0, region_width;
    std::uint32_t primitive;
};

// The arrays that the kernel `depth` fills from a plane of depth: binary32 values and their codes.
struct DepthLanes {
    DepthConversion<float> to_code;  // fixed point or D32F
    float* shader_z;                 // null: not requested
    std::uint32_t* code;             // null: not requested
    double* b1;                      // null: the weights are not needed
    double* b2;
};

// Attributes that vary over the triangle, before the division by the plane of 1 / w, and constant ones.
struct AttributeLanes {
    struct Constant {
        float value;
        float* out;
    };
    std::size_t count = 0, constant_count = 0;
    std::array<Constant, attribute_count> constant;
    std::array<RationalPlane, attribute_count> plane;
    std::array<float*, attribute_count> out;
    RationalPlane inverse_w;
    bool has_w = false;

    void add(const RationalPlane& p, float* lanes) noexcept {
        plane[count] = p;
        out[count++] = lanes;
    }
    // Returns the vertex values for the caller to fill in place: copying a whole plane would stall on its own stores.
    [[nodiscard]] std::array<double, 3>& add(float* lanes) noexcept {
        out[count] = lanes;
        return plane[count++].v;
    }
    void add(float value, float* lanes) noexcept { constant[constant_count++] = {value, lanes}; }
};

// Attributes by planes stepped in binary32 (float_planes.h), divided by the plane of 1 / w or multiplied by its
// reciprocal.
struct FloatAttributeLanes {
    PlaneRule rule;
    PerspectiveDivide perspective;
    FloatPlane inverse_w;
    std::size_t count = 0;
    std::array<FloatPlane, attribute_count> plane{};
    std::array<float*, attribute_count> out{};

    void add(const FloatPlane& p, float* lanes) noexcept {
        plane[count] = p;
        out[count++] = lanes;
    }
};

struct LaneKernels {
    // Appends the pixels of the spans until the rows are done (true), or the batch is full or already contains the next
    // pixel (false).
    bool (*emit)(const RowSpan* spans, RowRun& run, PixelClaims& claims, FragmentBatch& batch) noexcept;
    // b1 and b2 at `count` pixels; not for Kind::snapped_wide.
    void (*weights)(const PixelWeights& w, const std::uint16_t* x, const std::uint16_t* y, int count, double* b1,
                    double* b2) noexcept;
    // Every plane rounded to binary32 and divided by the rounded plane of 1 / w, and the constants; true if a lane is
    // not certain.
    bool (*attributes)(const AttributeLanes& attributes, const TriangleLanes& lanes) noexcept;
    // Weights, the rounded plane and its codes in one loop; true if a lane is not certain.
    bool (*depth)(const PixelWeights& w, const FilterPlane& plane, const std::uint16_t* x, const std::uint16_t* y,
                  int count, const DepthLanes& out) noexcept;
    // A plane stepped in binary32 at `count` pixels (float_planes.h).
    void (*float_plane)(PlaneRule rule, const FloatPlane& plane, const std::uint16_t* x, const std::uint16_t* y,
                        int count, float* out) noexcept;
    void (*float_attributes)(const FloatAttributeLanes& attributes, const std::uint16_t* x, const std::uint16_t* y,
                             int count) noexcept;
};

// The kernels of the selected instruction set. Look them up once per draw, not per triangle.
[[nodiscard]] const LaneKernels& lane_kernels() noexcept;

namespace scalar {

// The number of pixels of a span that the batch takes now; they are claimed. 0 if the batch must be flushed first.
[[nodiscard]] inline int claimed(const RowRun& run, int row, const RowSpan& span, PixelClaims& claims,
                                 int batch_count) noexcept {
    const int count = std::min(span.x1 - span.x0, usable_capacity - batch_count);
    const auto region_row = static_cast<std::size_t>(run.y0 + row - run.region_y0);
    const auto column = static_cast<unsigned>(span.x0 - run.region_x0);
    return count > 0 && claims.claim(region_row, column, static_cast<unsigned>(count)) ? count : 0;
}

[[nodiscard]] inline std::uint32_t pixel_number(const RowRun& run, int row, int x) noexcept {
    return static_cast<std::uint32_t>((run.y0 + row - run.region_y0) * run.region_width + x - run.region_x0);
}

inline void append(FragmentBatch& batch, int held, int count, std::uint32_t pixel, int x, int y,
                   std::uint32_t primitive) noexcept {
    for (int i = 0; i < count; ++i) {
        const auto at = static_cast<std::size_t>(held + i);
        batch.pixel[at] = pixel + static_cast<std::uint32_t>(i);
        batch.x[at] = static_cast<std::uint16_t>(x + i);
        batch.y[at] = static_cast<std::uint16_t>(y);
        batch.primitive[at] = primitive;
    }
}

// The walk of both kernels: `span_of(row)` returns the span of a row, `append_row` writes the lanes.
template <class SpanOf, class Append>
[[gnu::always_inline]] inline bool emit_rows(RowRun& run, PixelClaims& claims, FragmentBatch& batch,
                                             const SpanOf& span_of, const Append& append_row) noexcept {
    const RowRun rows = run;  // a copy: the compiler must assume that stores to the lanes change `run`
    int held = batch.count, row = rows.row, taken = rows.taken;
    bool has_room = true;
    while (row < rows.rows) {
        RowSpan span = span_of(row);
        span.x0 = std::max(span.x0, taken);
        while (span.x0 < span.x1) {
            const int count = claimed(rows, row, span, claims, held);
            has_room = count > 0;
            if (!has_room) break;
            append_row(batch, held, count, pixel_number(rows, row, span.x0), span.x0, rows.y0 + row, rows.primitive);
            held += count;
            span.x0 += count;
        }
        taken = has_room ? 0 : span.x0;
        if (!has_room) break;
        ++row;
    }
    batch.count = held;
    run.row = row;
    run.taken = taken;
    return has_room;
}

inline bool emit(const RowSpan* spans, RowRun& run, PixelClaims& claims, FragmentBatch& batch) noexcept {
    return emit_rows(
        run, claims, batch, [&](int row) { return spans[row]; }, append);
}

inline void weights(const PixelWeights& w, const std::uint16_t* __restrict x, const std::uint16_t* __restrict y,
                    int count, double* __restrict b1, double* __restrict b2) noexcept {
    for (int i = 0; i < count; ++i) {
        if (w.kind == PixelWeights::Kind::unsnapped) {
            const double dx = x[i] + 0.5 - w.x0, dy = y[i] + 0.5 - w.y0;
            b1[i] = (dx * w.y2 - dy * w.x2) * w.r;
            b2[i] = (dy * w.x1 - dx * w.y1) * w.r;
        } else {
            b1[i] = w.e1.at(x[i], y[i]) * w.r;
            b2[i] = w.e2.at(x[i], y[i]) * w.r;
        }
    }
}

inline bool round(const FilterPlane& plane, const double* __restrict b1, const double* __restrict b2, int count,
                  float* __restrict out) noexcept {
    std::uint32_t unsure = 0;
    for (int i = 0; i < count; ++i) {
        const RoundedEnds ends = rounded_ends(plane.at(b1[i], b2[i]), plane.error, ToBinary32{});
        unsure |= ends.difference();
        out[i] = std::bit_cast<float>(ends.low);
    }
    return unsure != 0;
}

inline bool attributes(const AttributeLanes& a, const TriangleLanes& lanes) noexcept {
    Lanes<float> inverse_w;
    bool unsure = false;
    const auto round_all = [&](const RationalPlane& plane, float* out) {
        const FilterPlane filter{plane, lanes.reach};
        unsure |= round(filter, lanes.weight1, lanes.weight2, lanes.count, out);
    };
    for (std::size_t k = 0; k < a.constant_count; ++k) std::fill_n(a.constant[k].out, lanes.count, a.constant[k].value);
    if (a.has_w && a.count > 0) round_all(a.inverse_w, inverse_w.data());
    for (std::size_t k = 0; k < a.count; ++k) {
        round_all(a.plane[k], a.out[k]);
        for (int i = 0; a.has_w && i < lanes.count; ++i)
            a.out[k][i] = a.out[k][i] / inverse_w[static_cast<std::size_t>(i)];
    }
    return unsure;
}

inline void float_plane(PlaneRule rule, const FloatPlane& plane, const std::uint16_t* __restrict x,
                        const std::uint16_t* __restrict y, int count, float* __restrict out) noexcept {
    for (int i = 0; i < count; ++i) out[i] = plane.at(rule, x[i], y[i]);
}

inline void float_attributes(const FloatAttributeLanes& a, const std::uint16_t* x, const std::uint16_t* y,
                             int count) noexcept {
    const bool multiplies = a.perspective == PerspectiveDivide::reciprocal, flushes = a.rule == PlaneRule::greatest_w;
    const auto kept = [flushes](float v) { return flushes ? Flushed{v}.v : v; };
    for (int i = 0; i < count; ++i) {
        const float inverse_w = a.inverse_w.at(a.rule, x[i], y[i]);
        const float by = multiplies ? kept(1.0f / inverse_w) : inverse_w;
        for (std::size_t k = 0; k < a.count; ++k) {
            const float value = a.plane[k].at(a.rule, x[i], y[i]);
            a.out[k][i] = kept(multiplies ? value * by : value / by);
        }
    }
}

}  // namespace scalar
}  // namespace strict
}  // namespace strata::rasterizer
