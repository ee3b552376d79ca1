// tools/oracle/fragments/coverages.h - computes the other lists of fragments that a pixel may have on a rasterizer with
// other snapping or another tie rule.
//
// Rule     The scene is rendered again with every tie rule, and moved by 1/16 pixel in the four diagonal directions: no
//          correct rasterizer with at least four subpixel bits covers a pixel that none of these covers. The fragments
//          of one instance and facing are taken from one rendering, so that of two triangles sharing an edge exactly
//          one covers the pixel; other instances may be taken from another rendering. A colour's spread is its largest
//          change in these renderings. Depths that nearly meet may be in another order (near_depths.h). Fragments of
//          exactly equal depth are excluded: rules for ties apply to them.
// Numbers  A fragment that the given rendering lacks has the colour of a moved rendering, with an error of one 8-bit
//          code or of the largest difference between the renderings, whichever is larger.
// Tests    tests/tools/oracle/fragments/coverages_test.cpp
#pragma once
#include <array>
#include <functional>
#include <span>
#include <string_view>
#include <vector>

#include "tools/oracle/fragments/fragments.h"

namespace strata::oracle::verdict {

// The directions in which the scene is moved.
inline constexpr std::array<std::string_view, 4> shift_words{"right and up", "right and down", "left and up",
                                                             "left and down"};

// A pixel's list in another rendering.
struct OtherList {
    std::vector<Fragment> visible{}, hidden{};
    Rgba behind{};
    float behind_spread = 0;
    std::uint32_t opaque = 0;
    bool has_opaque = false;
    bool has_close_depths = false;  // the order or the merging of depths within two codes is another one
    std::uint8_t directions = 0;    // bit n: the coverage of the scene moved in direction n of `shift_words`
    [[nodiscard]] PixelList at(int x, int y) const noexcept;
};

// A pixel at an edge, or with depths that may change their order.
struct EdgePixel {
    std::vector<OtherList> others{};  // all lists that may be right, besides the given one
    OtherList twice{}, never{};       // if the centre is on an edge: both of its triangles are drawn; neither is
    bool has_centre_on_edge = false;
};

// Takes the spreads of a pixel's fragments, visible ones first, if there are any.
using TakeSpreads = std::function<void(int x, int memory_row, std::span<const float> spreads)>;

class Coverages {
  public:
    // Renders the scene seven times in addition to `given`, whose fragments must have been kept. The rows are rendered
    // in bands, so that the seven pictures take no more memory than `given` does.
    Coverages(const peeling::FrameRequest& input, const SceneFragments& given, const TakeSpreads& take);

    [[nodiscard]] const EdgePixel* at(int x, int y) const noexcept;
    [[nodiscard]] std::size_t count() const noexcept { return pixels_.size(); }
    // The spread of the surface behind a pixel's fragments.
    [[nodiscard]] float behind_spread(int x, int y) const noexcept {
        return behind_spreads_.empty() ? 0 : behind_spreads_[index(x, y)];
    }

  private:
    // Adds a pixel with its list in every rendering, the given one's first.
    void add(const PixelList& pixel, int memory_row, std::span<OtherList> lists, const TakeSpreads& take);
    [[nodiscard]] std::size_t index(int x, int y) const noexcept {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
    }

    int width_ = 0;
    std::vector<float> behind_spreads_{};  // empty: all 0
    std::vector<std::uint32_t> number_{};  // per pixel: its number in pixels_, from 1; 0: no edge
    std::vector<EdgePixel> pixels_{};
};

}  // namespace strata::oracle::verdict
