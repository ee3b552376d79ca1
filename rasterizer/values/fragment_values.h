// rasterizer/values/fragment_values.h - fills the arrays of a batch for the fragments of one triangle.
//
// Rule     Depth: shader_z is the exact plane in [0,1] units, rounded once, not clamped; the code is by the requested
//          path, clamped to the depth range. Attributes: u (1/w) rounded to binary32 at the vertex, its exact plane
//          rounded once, divided by the plane of 1/w rounded once, the quotient correctly rounded; three vertex values
//          with the same bits give that constant (assumed). PlaneOrigin::unsnapped: the planes start at the unsnapped
//          positions, are evaluated in binary64 and rounded once. Other values of PlaneRule: planes of float_planes.h;
//          PerspectiveDivide::reciprocal multiplies by the rounded reciprocal of the plane of 1/w. Colours by 8-bit
//          weights: color_weights.h; coordinates by truncated weights: truncated_coordinates.h. depth_replace drops a
//          fragment whose depth is outside the depth range (with depth clamp: clamps it), after the clip of window z.
//          The reference is a second depth of the same fragment, for the depth test.
// Source   rasterizer/reference/depth.md 3 and 4; attributes.md 1 to 3.
// Tests    tests/rasterizer/values/fragment_values_test.cpp
#pragma once
#include <array>
#include <cstdint>
#include <span>

#include "rasterizer/coverage/fragment_batch.h"
#include "rasterizer/set_up/geometry.h"
#include "rasterizer/values/chip_lanes.h"
#include "rasterizer/values/lane_kernels.h"

namespace strata::rasterizer {

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
    [[nodiscard]] TriangleEdges edges() const noexcept { return {geometry.points(record), geometry.rules.tie_rule}; }
};

// A coordinate interpolated by truncated weights: its values at the corners, and the output array.
struct TruncatedCoordinate {
    std::array<float, 3> u;
    float* out;
};

// Computes the fragment values of one pass. Decisions that depend only on state, rules and needs are made by the
// constructor. One object may serve many triangles.
class FragmentValues {
  public:
    FragmentValues(const Geometry& geometry, const DepthRequest& depth, const FragmentNeeds& needs);

    // Fragments [first, batch.count) are those of `triangle`; their pixel, x, y and primitive are already written.
    // Fills the other arrays that the needs name and, with ZClip::per_fragment, removes the fragments outside the depth
    // range. Returns the number of exact fallbacks.
    [[nodiscard]] int fill(const DrawnTriangle& triangle, int first, FragmentBatch& batch, WeightLanes& weights) const;

    // The conversion of shader_z to a code for DepthPath::float32.
    [[nodiscard]] const DepthConversion<float>& to_code() const noexcept { return to_code_; }
    // The conversion of NV2A's window z to codes.
    [[nodiscard]] const ChipDepth& chip_depth() const noexcept { return chip_; }

  private:
    [[nodiscard]] TriangleLanes lanes(const DrawnTriangle& triangle, const TriangleEdges& edges, int first,
                                      const FragmentBatch& batch, const WeightLanes& weights) const noexcept;
    // Weights, shader_z and code in one loop; false if fill_values must be used.
    [[nodiscard]] bool fill_depth(const DrawnTriangle& triangle, int first, FragmentBatch& batch,
                                  WeightLanes& weights) const noexcept;
    [[nodiscard]] ChipConversion chip_conversion() const noexcept;
    // The same for window_z by NV2A's kernel, which writes only codes.
    [[nodiscard]] bool fill_chip_depth(const DrawnTriangle& triangle, int first, FragmentBatch& batch,
                                       WeightLanes& weights, int& fallbacks) const noexcept;
    // The compared depth of DepthPath::perspective_rq or depth_replace, in the buffer's own units. Returns the number
    // of exact fallbacks.
    [[nodiscard]] int fill_quotient_reference(const DrawnTriangle& triangle, int first, FragmentBatch& batch,
                                              const WeightLanes& weights) const noexcept;
    [[nodiscard]] bool fill_chip_codes(const DrawnTriangle& triangle, int first, FragmentBatch& batch) const noexcept;
    [[nodiscard]] int fill_values(const SetupTriangle& t, const DrawnTriangle& triangle, int first,
                                  FragmentBatch& batch, WeightLanes& weights) const;
    void fill_weights(const DrawnTriangle& triangle, int first, const FragmentBatch& batch,
                      WeightLanes& weights) const noexcept;
    [[nodiscard]] bool may_leave_depth_range(const SetupTriangle& triangle) const noexcept;
    void drop_outside_depth_range(const SetupTriangle& t, const TriangleLanes& lanes, int first, FragmentBatch& batch,
                                  WeightLanes& weights) const noexcept;
    void drop_rejected(int first, FragmentBatch& batch, WeightLanes& weights, double* depth) const noexcept;
    [[nodiscard]] int fill_rounded_codes(const SetupTriangle& triangle, const TriangleLanes& lanes,
                                         std::uint32_t* out) const noexcept;
    [[nodiscard]] int fill_exact_codes(const SetupTriangle& triangle, const TriangleLanes& lanes, const float* shader_z,
                                       std::uint32_t* out) const noexcept;
    // `path` is one that goes directly from the plane to the code.
    [[nodiscard]] int fill_codes(DepthPath path, const SetupTriangle& triangle, const TriangleLanes& lanes,
                                 const float* shader_z, std::uint32_t* out) const;
    // The depth as a value in the buffer's own units, not clamped.
    [[nodiscard]] int fill_depth_values(DepthPath path, const SetupTriangle& t, const DrawnTriangle& triangle,
                                        const TriangleLanes& lanes, const float* shader_z, double* out) const;
    // True for window_z by NV2A's rule, and for w_buffer.
    [[nodiscard]] bool is_chip(DepthPath path) const noexcept;
    // The values of those paths in the buffer's own units, including the per-fragment offset, not clamped.
    void fill_chip_values(DepthPath path, const SetupTriangle& t, const TriangleLanes& lanes,
                          double* out) const noexcept;
    // The code of a depth in the buffer's own units.
    [[nodiscard]] std::uint32_t code_of(double value) const noexcept { return depth_code(value, value_to_code_); }
    void fill_value_codes(const double* values, int count, std::uint32_t* out) const noexcept;
    // Codes of the stored path, if it is one of depth_paths.h; drops the fragments that depth_replace rejects.
    [[nodiscard]] int fill_value_codes(const SetupTriangle& t, const DrawnTriangle& triangle, int first,
                                       FragmentBatch& batch, WeightLanes& weights) const;
    [[nodiscard]] int fill_reference(const SetupTriangle& t, const DrawnTriangle& triangle, int first,
                                     FragmentBatch& batch, const WeightLanes& weights) const;
    [[nodiscard]] int fill_varying(const AttributeLanes& varying, const TriangleLanes& lanes) const;
    // Depth and attributes by a PlaneRule other than the exact plane (float_values.cpp). If is_float_plain_, this is
    // everything that the pass requests.
    [[nodiscard]] int fill_float_values(const DrawnTriangle& triangle, int first, FragmentBatch& batch,
                                        WeightLanes& weights) const;
    void fill_float_z(const DrawnTriangle& triangle, int first, FragmentBatch& batch) const noexcept;
    void fill_ordered_z(const DrawnTriangle& triangle, int first, FragmentBatch& batch) const noexcept;
    void fill_float_codes(int first, FragmentBatch& batch) const noexcept;
    void fill_float_attributes(const DrawnTriangle& triangle, int first, FragmentBatch& batch) const noexcept;
    template <class Planes>
    void fill_attribute_planes(const Planes& planes, const std::array<float, 3>& w, const FloatPlane& under,
                               const std::array<std::uint32_t, 3>& vertex, const DrawnTriangle& triangle, int first,
                               FragmentBatch& batch) const noexcept;
    [[nodiscard]] int fill_attributes(const DrawnTriangle& triangle, int first, FragmentBatch& batch,
                                      const WeightLanes& weights) const;
    // Colours by 8-bit weights, and coordinates by truncated weights.
    void fill_chip_colors(const DrawnTriangle& triangle, const TriangleLanes& lanes, int first,
                          FragmentBatch& batch) const noexcept;
    void fill_chip_coordinates(const DrawnTriangle& triangle, const TriangleLanes& lanes,
                               std::span<const TruncatedCoordinate> coordinates) const noexcept;

    // Converts the depths of fragments [first, batch.count) to keys (rules/depth_key.h).
    void turn_into_keys(int first, FragmentBatch& batch) const noexcept;

    [[nodiscard]] int fill_units(const DrawnTriangle& triangle, int first, FragmentBatch& batch,
                                 const WeightLanes& weights) const;  // unit_values.cpp

    const LaneKernels& kernels_;
    RasterRules rules_;
    DepthRequest depth_;
    FragmentNeeds needs_;
    // Units of vertex z, and of the buffer, in depth 1.0.
    double z_units_;
    double code_units_;
    DepthConversion<float> to_code_;         // for shader_z
    DepthConversion<double> value_to_code_;  // for values in the buffer's own units
    PolygonOffset offset_;                   // added per fragment (OffsetRule::fragments)
    const ChipKernels* chip_kernels_;
    ChipDepth chip_;
    Rect clip_;      // intersection of viewport and scissor
    float w_scale_;  // the w buffer's units in one unit of clip w
    bool clips_fragments_;
    bool rejects_;      // depth_replace without depth clamp: fragments outside the depth range are dropped
    bool is_reversed_;  // DepthOrder::greater
    bool needs_float_z_, needs_attributes_;
    // is_plain_: the pass requests at most shader_z and its code by DepthPath::float32, so one kernel computes both.
    // is_float_plain_: the same by planes stepped in binary32, with colours and coordinates.
    bool is_plain_, is_float_plain_;
    // is_chip_path_: the stored depth is NV2A's window z and has a kernel. is_chip_plain_: also, no exact code and
    // at most a reference by quotient is requested. needs_plane_weights_: some attribute is interpolated by planes.
    bool is_chip_path_, is_chip_plain_, needs_plane_weights_;
    // The compared depth is the stored one, in binary64, so it is computed only once (depth.md 6.1).
    bool reference_is_stored_;
};

}  // namespace strata::rasterizer
