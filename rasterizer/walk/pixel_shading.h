// rasterizer/walk/pixel_shading.h - the values of a sample's fragments that are evaluated once a pixel, at its centre
// or centroid.
//
// Rule     Coverage, the stored depth and its clip are those of the sample; all else that a program reads is evaluated
//          at the pixel's centre. Colours and coordinates may be at its centroid: the centre if the triangle covers
//          every sample of the pixel, else the first sample that it covers. Beyond the triangle its planes go on.
// Source   rasterizer/reference/coverage.md 12.3.
// Tests    tests/rasterizer/walk/pixel_shading_test.cpp
#pragma once
#include <memory>
#include <optional>
#include <vector>

#include "rasterizer/coverage/coverage.h"
#include "rasterizer/set_up/geometry.h"
#include "rasterizer/values/weight_lanes.h"

namespace strata::rasterizer {

class PixelShading {
  public:
    // The geometry's state has a sample, and `at` is not `sample`; the path does not replace depth.
    PixelShading(Interpolation at, const Geometry& geometry, const DepthRequest& depth, const FragmentNeeds& needs);
    ~PixelShading();

    // True if values that are needed are evaluated apart from the sample.
    [[nodiscard]] static bool is_used(Interpolation at, const FragmentNeeds& needs) noexcept {
        return at != Interpolation::sample &&
               (needs.shader_z || needs.color || needs.texcoord || needs.reference || needs.has_extras());
    }

    // What the sample itself has of these needs.
    [[nodiscard]] static FragmentNeeds of_sample(const FragmentNeeds& needs) noexcept;

    // Fragments [first, batch.count) are those of triangle `index`, already filled with the values of the sample.
    // Returns the number of exact fallbacks.
    [[nodiscard]] int fill(std::uint32_t index, int first, FragmentBatch& batch, WeightLanes& weights);

  private:
    struct Point;
    struct Few;

    [[nodiscard]] Point point_at(SamplePoint point, const DepthRequest& depth, const FragmentNeeds& needs) const;
    void take(std::uint32_t index, Point& point) const;
    [[nodiscard]] int fill_at(Point& point, std::uint32_t index, int first, FragmentBatch& batch, WeightLanes& weights);
    [[nodiscard]] int fill_at_centroids(std::uint32_t index, int first, FragmentBatch& batch);
    void find_least(std::uint32_t index);
    // The centroid in a pixel whose own sample is at `pixel`: 0 for the centre, 1 + s for sample s.
    [[nodiscard]] std::size_t centroid_of(SubpixelPoint pixel) const noexcept;
    void copy_attributes(const FragmentBatch& from, std::size_t i, FragmentBatch& to, std::size_t k) const noexcept;

    const Geometry& geometry_;
    Interpolation at_;
    FragmentNeeds needs_;
    std::vector<Point> points_;           // the centre, then for the centroid the samples
    std::optional<TriangleEdges> edges_;  // of the current triangle at its own sample
    std::vector<EdgeValues> least_;       // for each sample, the values of those edges from which on it is covered
    std::unique_ptr<Few> few_;            // for the centroid
};

}  // namespace strata::rasterizer
