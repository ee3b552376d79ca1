// rasterizer/values/fragment_values.h - fills the arrays of a batch for the fragments of one triangle.
//
// Rule     The rules stand with the parts: depths in depth/depth_steps.h, colours and coordinates in
//          attributes/plane_attributes.h and stepped_attributes.h, texture units in attributes/unit_values.h. The parts
//          that a pass needs are selected once, from state, rules and needs. Under reversed depth the depths become
//          keys (rules/depth_key.h).
// Source   rasterizer/reference/depth.md 3 and 4; attributes.md 1 to 3.
// Tests    tests/rasterizer/values/fragment_values_test.cpp
#pragma once
#include <optional>
#include <variant>

#include "rasterizer/values/attributes/plane_attributes.h"
#include "rasterizer/values/attributes/stepped_attributes.h"
#include "rasterizer/values/attributes/unit_values.h"
#include "rasterizer/values/depth/depth_steps.h"
#include "rasterizer/values/depth/fast_depth.h"

namespace strata::rasterizer {

// Computes the fragment values of one pass. One object may serve many triangles.
class FragmentValues {
  public:
    FragmentValues(const Geometry& geometry, const DepthRequest& depth, const FragmentNeeds& needs);

    // Fragments [first, batch.count) are those of `triangle`; their pixel, x, y and primitive are already written.
    // Fills the other arrays that the needs name and, with ZClip::per_fragment, removes the fragments outside the depth
    // range. Returns the number of exact fallbacks.
    [[nodiscard]] int fill(const DrawnTriangle& triangle, int first, FragmentBatch& batch, WeightLanes& weights) const;

  private:
    [[nodiscard]] int fill_depths(const TriangleFragments& fragments) const;
    void turn_into_keys(const TriangleFragments& fragments) const noexcept;

    DepthConstants depth_;
    FragmentNeeds needs_;
    FastDepth fast_;
    DepthSteps steps_;
    bool is_reversed_;  // DepthOrder::greater
    std::variant<std::monostate, PlaneAttributes, SteppedAttributes> attributes_;
    std::optional<UnitValues> units_;
};

}  // namespace strata::rasterizer
