// peeling/truth/chain_list.h - generates the fragments of one draw list with a chain: depth and colour before any test.
//
// Rule     If plane, colour and snap are exact no kernel of the emulated device is used, and coverage is that of
//          unsnapped corners. Otherwise triangles are set up and batches filled by the device's code; an exact link is
//          then evaluated in binary64 at the corners of the set-up triangle. Kernels need positions on a grid: if snap
//          is exact and a kernel is used, the grid is the finest that a profile may have, 1/4096 pixel.
// Tests    tests/peeling/truth/chain_test.cpp
#pragma once
#include <functional>
#include <optional>
#include <vector>

#include "peeling/render_options.h"
#include "peeling/truth/chain.h"
#include "peeling/truth/real_triangle.h"
#include "pipeline/vertices/prepare.h"

namespace strata::peeling {

// The input of an image, as a Renderer takes it. The references must outlive this.
struct ChainScene {
    const pipeline::DrawList& list;
    pipeline::View view;
    const pipeline::DeviceProfile& profile;
    const RenderOptions& options;

    [[nodiscard]] rasterizer::DepthRequest depth() const;
    [[nodiscard]] pipeline::Format color_format() const;
    [[nodiscard]] rasterizer::RasterState raster() const;
};

struct ChainFragment {
    std::uint32_t pixel = 0;  // index in the tile, row by row
    double depth = 0;         // in the list's own unit, see far()
    std::array<double, 4> color{};
};

class ChainList {
  public:
    static constexpr int tile_size = 64;

    ChainList(const ChainScene& scene, const Chain& chain, pipeline::Selection selection);

    // The depth of a cleared buffer in the unit of the fragments' depths: codes, the buffer's own values, or [0, 1].
    [[nodiscard]] double far() const noexcept { return far_; }
    // Appends the fragments of a tile in submission order, after MASK.
    void fragments_of(std::size_t tile, std::vector<ChainFragment>& out) const;
    // Tiles are numbered row by row over the frame.
    [[nodiscard]] std::size_t tile_count() const noexcept;
    [[nodiscard]] rasterizer::Rect tile_rect(std::size_t tile) const noexcept;

  private:
    void device_fragments(std::size_t tile, std::vector<ChainFragment>& out) const;
    void real_fragments(std::size_t tile, std::vector<ChainFragment>& out) const;
    void take(rasterizer::FragmentBatch& batch, const RealTriangle* triangle, std::vector<ChainFragment>& out) const;
    // Empty if MASK discards the fragment.
    [[nodiscard]] std::optional<std::array<double, 4>> real_color(const RealTriangle& triangle,
                                                                  const RealWeights& weights) const;
    [[nodiscard]] double real_depth(double z) const;

    const ChainScene& scene_;
    Chain chain_;
    rasterizer::DepthRequest depth_;
    rasterizer::Rect frame_;
    double far_ = 1;
    float alpha_scale_;
    bool is_real_;  // no kernel of the emulated device is used
    pipeline::PreparedDraw prepared_;
    std::vector<RealTriangle> triangles_;
    std::vector<std::vector<std::uint32_t>> bins_;
};

}  // namespace strata::peeling
