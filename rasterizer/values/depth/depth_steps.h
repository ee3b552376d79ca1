// rasterizer/values/depth/depth_steps.h - computes the depths that a pass requests one array after the other, by any
// path and rule. It is the definition of the fast forms in fast_depth.h.
//
// Rule     shader_z is the exact plane in [0,1] units, rounded once, not clamped; the code is by the requested path,
//          clamped to the depth range. The reference is a second depth of the same fragment, for the depth test: its
//          code is computed as if a pass stored this path. Fragments outside the depth range are removed as early as
//          possible, so that later arrays are filled only for the others.
//          ZClip::per_fragment compares NV2A's own value with the range if NV2A computes one: the w buffer's, else
//          window z, whichever path is stored. Otherwise shader_z is compared (assumed): a value that rounds to n or f
//          is inside. depth_replace compares the replaced depth, after that.
// Source   rasterizer/reference/depth.md 3, 4, 5.2 and 6.1
// Tests    tests/rasterizer/values/fragment_values_test.cpp
#pragma once
#include <cstdint>

#include "rasterizer/values/depth/path_depth.h"

namespace strata::rasterizer {

// The test of ZClip::per_fragment.
class DepthRangeTest {
  public:
    DepthRangeTest(const DepthConstants& constants, const DepthRequest& depth, const RasterRules& rules) noexcept;

    // False if no fragment of the triangle can be outside.
    [[nodiscard]] bool may_be_left(const DepthConstants& constants, const DepthInput& input) const noexcept;
    void drop_outside(const DepthConstants& constants, const DepthInput& input,
                      const TriangleFragments& fragments) const noexcept;

  private:
    bool stores_w_;
    int (*values_)(const DepthConstants&, const DepthInput&, double*);  // null: shader_z is compared
};

// The test of a replaced depth, depth[0] of the first fragment; the values that remain move with their fragments.
void drop_rejected(const DepthScale& scale, const TriangleFragments& fragments, double* depth) noexcept;

class DepthSteps {
  public:
    DepthSteps(const DepthConstants& constants, const Geometry& geometry, const DepthRequest& depth,
               const FragmentNeeds& needs) noexcept;

    // Returns the number of exact fallbacks.
    [[nodiscard]] int fill(const DepthConstants& constants, const TriangleFragments& fragments) const;

  private:
    enum class ShaderZ : std::uint8_t { not_needed, exact_plane, stepped_plane };
    enum class Reference : std::uint8_t {
        not_needed,
        values,     // values of the stored path, and its codes
        is_stored,  // the same in binary64: computed once, as the stored depth
        other_path,
    };

    [[nodiscard]] int fill_stored(const DepthConstants& constants, const DepthInput& input,
                                  const TriangleFragments& fragments) const;
    [[nodiscard]] int fill_reference(const DepthConstants& constants, const DepthInput& input,
                                     const TriangleFragments& fragments) const;

    PathDepth stored_, compared_;
    DepthRangeTest range_;
    FragmentNeeds needs_;
    ShaderZ shader_z_;
    Reference reference_;
    bool rejects_;       // depth_replace without depth clamp: fragments outside the depth range are dropped
    bool is_own_order_;  // logarithmic: shader_z and the exact code are this depth, because codes of z are too coarse
};

}  // namespace strata::rasterizer
