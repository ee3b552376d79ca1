// tools/oracle/fragments/fragments.h - collects every transparent fragment of a scene, pixel by pixel, near to far, and
// the opaque colour behind them.
//
// Rule     A pixel's list contains its visible fragments by depth code, equal codes in submission order; then its
//          hidden ones, at or behind the opaque surface, in the same order. Lists are passed tile by tile, each tile
//          once, including tiles without fragments.
// Numbers  44 bytes per fragment, 12 per pixel of a tile with fragments, and 16 per pixel if something opaque is drawn.
//          Tiles are kept if they fit into the given memory; otherwise the scene is rendered again for each traversal.
// Tests    tests/tools/oracle/fragments/fragments_test.cpp
#pragma once
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "peeling/frame_request.h"
#include "pipeline/formats/image.h"
#include "tools/oracle/fragments/setting.h"

namespace strata::oracle::verdict {

struct Fragment {
    Rgba color{};                 // not premultiplied
    std::uint32_t code = 0;       // stored depth, where less is nearer
    float shader_z = 0;           // in [0, 1], less is nearer
    std::uint32_t primitive = 0;  // index of its triangle in submission order
    std::uint32_t instance = 0;   // index in the draw list
    std::uint32_t material = 0;
    bool is_front_facing = true;
    float slack = 0;   // possible error of its colour
    float spread = 0;  // change of its colour if positions are snapped differently (coverages.h); 0 if not known
};

struct EdgePixel;  // coverages.h
class Coverages;
class SceneFragments;

struct PixelList {
    int x = 0, y = 0;  // position in the frame
    std::span<const Fragment> visible{}, hidden{};
    Rgba behind{};                          // colour of the opaque surface, or of the background
    float behind_spread = 0;                // as Fragment::spread
    bool has_spreads = false;               // the spreads are known
    std::uint32_t opaque = 0;               // depth code of the opaque surface
    bool has_opaque = false;                // false: the background is behind the fragments
    const SceneFragments* scene = nullptr;  // for rules that read other pixels; null: these are not available
    const EdgePixel* edge = nullptr;        // other possible coverage; null: none, or not known
};

struct TileLists {
    rasterizer::Rect rect{};  // in pixels of the frame
    std::vector<std::uint32_t> start{},
        // Per pixel, row by row: begin of its visible and of its hidden fragments; `start` has one more entry.
        hidden{};
    std::vector<Fragment> fragments{};
    std::vector<std::uint32_t> opaque{};  // per pixel: depth code of the opaque surface
};

// Rows of a frame in memory order.
struct Rows {
    int first = 0, end = std::numeric_limits<int>::max();
};

class SceneFragments {
  public:
    // Renders the scene at one sample, whose point RasterState::sample says. `bytes` limits the kept fragments. Only
    // tiles that intersect `rows` are rendered and kept: the other ones look blank. Throws Refused and InputError like
    // a renderer. Objects that `input` refers to must outlive this.
    SceneFragments(const peeling::FrameRequest& input, std::uint64_t bytes, const Rows& rows = {});

    [[nodiscard]] int width() const noexcept { return input_.options.width; }
    [[nodiscard]] int height() const noexcept { return input_.options.height; }
    [[nodiscard]] const Setting& setting() const noexcept { return setting_; }
    [[nodiscard]] const pipeline::DrawList& list() const noexcept { return input_.list; }
    [[nodiscard]] std::uint64_t count() const noexcept { return count_; }
    [[nodiscard]] std::size_t most_visible() const noexcept { return most_visible_; }

    // Sets the colour that the candidate has where nothing is drawn, if that is one colour and not the background's.
    void set_seen_background(const std::optional<Rgba>& color) { setting_.seen_background = color; }
    void set_stored(ColorStorage stored) { setting_.stored = stored; }
    // Shows fragments at the greatest depth where there is no opaque surface: a port without a depth test composites
    // those that interpolation moves beyond the far plane, while LESS against the cleared depth fails.
    void show_at_far_plane(bool is_shown) { shows_at_far_plane_ = is_shown; }
    [[nodiscard]] std::uint64_t count_at_far_plane() const noexcept { return count_at_far_plane_; }  // in pixels

    // Computes the other possible coverage of pixels at edges; does nothing for scenes that are too large.
    void find_coverages();

    // Calls visit(tile) for every tile, from several threads.
    void for_each_tile(const std::function<void(const TileLists&)>& visit) const;
    [[nodiscard]] PixelList at(const TileLists& tile, std::size_t pixel) const noexcept;  // `pixel`: index in the tile
    // The kept fragments of a pixel; empty if they were not kept, and outside the frame.
    [[nodiscard]] std::span<const Fragment> visible_at(int x, int y) const noexcept;
    // The list of a pixel, in memory order of rows, if the fragments were kept.
    [[nodiscard]] PixelList list_at(int x, int memory_row) const noexcept;
    [[nodiscard]] bool keeps() const noexcept { return keeps_; }
    // Bytes of the kept lists in a row of pixels, for all rows in memory order.
    [[nodiscard]] std::vector<std::uint64_t> bytes_of_rows() const;

  private:
    // Renders the scene once and passes all tiles that are not blank to `take`. Returns the opaque scene's colours.
    pipeline::Image draw(const std::function<void(TileLists&&)>& take) const;

    // Keeps the colours behind the fragments of these rows; one colour if it is the same everywhere.
    void keep_behind(const pipeline::Image& drawn);
    [[nodiscard]] Rgba behind_at(int x, int y) const noexcept;
    void index_tiles();
    [[nodiscard]] const TileLists* tile_at(int x, int memory_row) const noexcept;

    peeling::FrameRequest input_;
    Rows rows_;
    Setting setting_;
    std::vector<std::uint32_t> instance_of_{};  // per primitive
    std::uint32_t far_code_ = 0;                // depth code without an opaque surface
    // The colours behind the fragments, row by row from the top: of the rows from first_behind_ on, or a single one.
    std::vector<Rgba> behind_{};
    int first_behind_ = 0;
    std::vector<TileLists> kept_{};
    // By square of `tile_side` pixels, row by row: the number of its tile, from 1; 0: no fragments.
    std::vector<std::uint32_t> tile_of_{};
    std::size_t columns_ = 0;                // of such squares
    std::vector<rasterizer::Rect> blank_{};  // the area outside the tiles that ran
    std::shared_ptr<const Coverages> coverages_{};
    bool keeps_ = true, shows_at_far_plane_ = false;
    std::uint64_t count_at_far_plane_ = 0;
    std::uint64_t count_ = 0;
    std::size_t most_visible_ = 0;
};

}  // namespace strata::oracle::verdict
