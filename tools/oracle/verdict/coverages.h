// tools/oracle/verdict/coverages.h - what of a pixel may be otherwise on a rasterizer that snaps or breaks ties
// otherwise.
//
// Rule     The scene is drawn again with every rule for ties and moved by 1/16 pixel in the four diagonal directions:
//          no right rasterizer with four bits of subpixels or more covers what none of these covers. The fragments of
//          one instance and facing come from one drawing, so that of two triangles beside an edge one covers the pixel,
//          neither both nor none; those of others may come from another one. Colours are off by what they change by in
//          these drawings, their spread; neighbours whose depths come so much nearer to each other may change places,
//          and one that meets the opaque surface may lie on either side of it. At one depth to the bit neither holds:
//          there are rules for ties.
// Numbers  Colours of fragments that the drawing as given lacks are taken where they were moved to; they are off by a
//          code, or by as much as drawings differ.
// Tests    tests/tools/oracle/verdict/coverages_test.cpp
#pragma once
#include <vector>

#include "tools/oracle/verdict/fragments.h"

namespace strata::oracle::verdict {

// A pixel as another drawing has it.
struct OtherList {
    std::vector<Fragment> visible{}, hidden{};
    Rgba behind{};
    float behind_spread = 0;
    std::uint32_t opaque = 0;
    bool has_opaque = false;
    [[nodiscard]] PixelList at(int x, int y) const noexcept;
};

// A pixel at an edge, or with depths that nearly meet.
struct EdgePixel {
    std::vector<OtherList> others{};  // all that may be right beside the drawing as given
    OtherList twice{}, never{};       // a centre on an edge is drawn by both of its triangles, or by neither
    bool has_centre_on_edge = false;
};

class Coverages {
  public:
    // Draws the scene eight times. Nothing is known of a scene whose fragments were not kept.
    Coverages(const RunInput& input, const SceneFragments& given);

    [[nodiscard]] const EdgePixel* at(int x, int y) const noexcept;
    [[nodiscard]] std::size_t count() const noexcept { return pixels_.size(); }
    // Of a pixel's fragments, the visible ones first, and of what lies behind them.
    [[nodiscard]] const std::vector<float>& spreads(int x, int y) const noexcept { return spreads_[index(x, y)]; }
    [[nodiscard]] float behind_spread(int x, int y) const noexcept { return behind_spreads_[index(x, y)]; }

  private:
    void keep_spreads(const OtherList& list);
    [[nodiscard]] std::size_t index(int x, int y) const noexcept {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
    }

    int width_ = 0;
    std::vector<std::vector<float>> spreads_{};
    std::vector<float> behind_spreads_{};
    std::vector<std::uint32_t> number_{};  // of each pixel in pixels_, from 1; 0: no edge
    std::vector<EdgePixel> pixels_{};
};

}  // namespace strata::oracle::verdict
