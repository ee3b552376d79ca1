// peeling/frame/prepared_lists.h - the draw lists of the frames of one command, each transformed and set up once.
//
// Rule     Lists in other submission orders are prepared when an algorithm first requires them. The second list is
//          drawn by all passes except the first, if another vertex path, another split of the surfaces or another depth
//          clamp is requested.
// Tests    tests/peeling/comparison_test.cpp, sequences/partial_order_test.cpp, frame/sort_test.cpp
#pragma once
#include <array>
#include <optional>

#include "peeling/algorithms/algorithm.h"
#include "peeling/frame/shadow_light.h"
#include "peeling/render_options.h"
#include "pipeline/device/check.h"
#include "pipeline/vertices/prepare.h"

namespace strata::peeling {

// True if a depth path needs r and q of the vertices.
[[nodiscard]] bool takes_quotient(const rasterizer::DepthRequest& depth) noexcept;

class PreparedLists {
  public:
    // The settings that all draw lists share.
    struct Settings {
        const pipeline::DrawList& list;
        pipeline::View view;
        pipeline::DeviceProfile profile;
        RenderOptions options;
        rasterizer::RasterState raster{};
        rasterizer::DepthRequest depth{};
        const LightMap* light = nullptr;  // must outlive the lists
    };
    explicit PreparedLists(Settings settings);

    // Why the profile cannot draw a primitive of the list, if so; nothing is prepared then.
    [[nodiscard]] std::optional<pipeline::Refusal> undrawable() const;
    [[nodiscard]] const pipeline::PreparedDraw& transparent(ListOrder order);
    // Sorts all existing lists into tiles of this size, unless they already are.
    void bin(int tile_size_px);
    [[nodiscard]] const pipeline::PreparedDraw* opaque() const noexcept { return opaque_.get(); }
    [[nodiscard]] const pipeline::PreparedDraw* second() const noexcept { return second_.get(); }
    // The input of set-up, for callers that need the vertices. submission: the indices of the transparent soup's
    // triangles in submission order, empty if as listed.
    [[nodiscard]] rasterizer::TriangleSoup opaque_soup() const;
    [[nodiscard]] rasterizer::TriangleSoup transparent_soup() const;
    [[nodiscard]] std::vector<std::uint32_t> submission(ListOrder order) const;
    // The time in which the lists of an algorithm with this order were prepared and last binned, also if an earlier
    // algorithm drew them first.
    [[nodiscard]] double seconds(ListOrder order) const noexcept {
        return transparent_[static_cast<std::size_t>(order)].seconds() + opaque_.seconds() + second_.seconds();
    }
    [[nodiscard]] const Settings& settings() const noexcept { return s_; }

  private:
    struct TimedList {
        std::optional<pipeline::PreparedDraw> draw{};
        double prepared_seconds = 0, binned_seconds = 0;
        [[nodiscard]] const pipeline::PreparedDraw* get() const noexcept { return draw ? &*draw : nullptr; }
        [[nodiscard]] double seconds() const noexcept { return prepared_seconds + binned_seconds; }
    };

    [[nodiscard]] pipeline::PrepareOptions prepare_options(pipeline::Selection selection) const;
    [[nodiscard]] pipeline::Selection transparent_selection() const;
    [[nodiscard]] int samples() const;
    [[nodiscard]] TimedList prepare(const pipeline::DrawList& list, const pipeline::View& view,
                                    const rasterizer::RasterState& raster,
                                    const pipeline::PrepareOptions& options) const;
    void prepare_second();
    [[nodiscard]] bool arrives_sorted(const pipeline::Instance& instance) const;
    [[nodiscard]] PartSort parts_of(const rasterizer::TriangleSoup& soup, ListOrder order) const;
    [[nodiscard]] pipeline::Ordering ordering(ListOrder order) const;

    Settings s_;
    pipeline::Lighting lighting_;
    std::array<TimedList, 4> transparent_{};  // indexed by ListOrder
    TimedList opaque_{}, second_{};
};

}  // namespace strata::peeling
