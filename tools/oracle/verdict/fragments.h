// tools/oracle/verdict/fragments.h - every transparent fragment of a scene, pixel by pixel, near to far, and what lies
// behind them.
//
// Rule     A pixel's list has its visible fragments by depth code, equal codes in the order of submission; then its
//          hidden ones, those at or behind the opaque surface, likewise. Lists come tile by tile, each tile once; tiles
//          without a fragment come, too.
// Numbers  44 bytes a fragment. Tiles are kept while they fit into the memory that is stated, and drawn again for each
//          walk where they do not.
// Tests    tests/tools/oracle/verdict/fragments_test.cpp
#pragma once
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "pipeline/formats/image.h"
#include "tools/oracle/run_input.h"
#include "tools/oracle/verdict/setting.h"

namespace strata::oracle::verdict {

struct Fragment {
    Rgba color{};                 // straight
    std::uint32_t code = 0;       // its depth as stored, less is nearer
    float shader_z = 0;           // in [0, 1], less is nearer
    std::uint32_t primitive = 0;  // submission number of its triangle
    std::uint32_t instance = 0;   // of the draw list
    std::uint32_t material = 0;
    bool is_front_facing = true;
    float slack = 0;  // by which its colour may be off
    float spread =
        0;  // by which it changes if positions are snapped otherwise (coverages.h); 0 where that is not known
};

struct EdgePixel;  // coverages.h
class Coverages;
class SceneFragments;

struct PixelList {
    int x = 0, y = 0;  // in the frame
    std::span<const Fragment> visible{}, hidden{};
    Rgba behind{};                          // the opaque surface's colour or the background's
    float behind_spread = 0;                // as a fragment's
    bool has_spreads = false;               // they are known
    std::uint32_t opaque = 0;               // its depth's code
    bool has_opaque = false;                // false: the background lies behind
    const SceneFragments* scene = nullptr;  // that knows other pixels, too; null: it does not
    const EdgePixel* edge = nullptr;        // what else may cover it; null: nothing, or it is not known
};

struct TileLists {
    rasterizer::Rect rect{};  // pixels of the frame
    std::vector<std::uint32_t> start{},
        hidden{};  // of each pixel, row by row: where its lists begin; `start` has one more
    std::vector<Fragment> fragments{};
    std::vector<std::uint32_t> opaque{};  // each pixel's depth code of the opaque surface
};

class SceneFragments {
  public:
    // Draws the scene. `bytes`: what may be kept. Throws Refused and InputError as a renderer does. What `input` refers
    // to must live as long.
    SceneFragments(const RunInput& input, std::uint64_t bytes);

    [[nodiscard]] int width() const noexcept { return behind_.width; }
    [[nodiscard]] int height() const noexcept { return behind_.height; }
    [[nodiscard]] const Setting& setting() const noexcept { return setting_; }
    [[nodiscard]] const pipeline::DrawList& list() const noexcept { return input_.list; }
    [[nodiscard]] std::uint64_t count() const noexcept { return count_; }
    [[nodiscard]] std::size_t most_visible() const noexcept { return most_visible_; }

    // What the candidate has where nothing is drawn.
    void set_seen_background(const Rgba& color) { setting_.seen_background = color; }
    // Finds out what else may cover pixels at edges, from now on; nothing for scenes that are too large for it.
    void find_coverages();

    // visit(tile) for every tile, from several threads.
    void for_each_tile(const std::function<void(const TileLists&)>& visit) const;
    [[nodiscard]] PixelList at(const TileLists& tile, std::size_t pixel) const noexcept;  // `pixel` counts in the tile
    // Of lists that are kept; no fragments beyond the frame.
    [[nodiscard]] std::span<const Fragment> visible_at(int x, int y) const noexcept;

  private:
    // Draws the scene once; `take` gets the tiles that run: all that are not blank. Returns the opaque scene's colours.
    pipeline::Image draw(const std::function<void(TileLists&&)>& take) const;

    void index_tiles();

    RunInput input_;
    Setting setting_;
    std::vector<std::uint32_t> instance_of_{};  // of a primitive
    std::uint32_t far_code_ = 0;                // where no opaque surface is
    pipeline::Image behind_{};                  // rgba32f
    std::vector<TileLists> kept_{};
    std::vector<std::uint32_t> tile_of_{};   // of each pixel of the frame, from 1; 0: it has no fragments
    std::vector<rasterizer::Rect> blank_{};  // what no tile that ran holds
    std::shared_ptr<const Coverages> coverages_{};
    bool keeps_ = true;
    std::uint64_t count_ = 0;
    std::size_t most_visible_ = 0;
};

}  // namespace strata::oracle::verdict
