// tools/oracle/fragments/coverages.cpp - draws the scene with other snapping and tie rules and keeps, for each pixel,
// the lists that differ (coverages.h).
#include "tools/oracle/fragments/coverages.h"

#include <algorithm>
#include <deque>
#include <span>

#include "pipeline/device/profile.h"
#include "pipeline/vertices/prepare.h"
#include "tools/oracle/fragments/edge_lists.h"

namespace strata::oracle::verdict {

PixelList OtherList::at(int x, int y) const noexcept {
    return {.x = x,
            .y = y,
            .visible = visible,
            .hidden = hidden,
            .behind = behind,
            .behind_spread = behind_spread,
            .opaque = opaque,
            .has_opaque = has_opaque};
}

namespace {

constexpr double moved_by = 1.0 / 16;  // pixels

OtherList copy_of(const PixelList& list) {
    return {.visible = {list.visible.begin(), list.visible.end()},
            .hidden = {list.hidden.begin(), list.hidden.end()},
            .behind = list.behind,
            .behind_spread = list.behind_spread,
            .opaque = list.opaque,
            .has_opaque = list.has_opaque};
}

bool is_blank(const PixelList& list) noexcept { return list.visible.empty() && list.hidden.empty(); }

// Moves the scene to the right and up by the given number of pixels.
pipeline::VertexAlteration moved(double right, double up, int width, int height) {
    const auto x = static_cast<float>(2 * right / width), y = static_cast<float>(2 * up / height);
    return {.vertices =
                [x, y](rasterizer::TriangleSoup& soup) {
                    for (rasterizer::ClipVertex& v : soup.vertices) {
                        v.x += x * v.w;
                        v.y += y * v.w;
                    }
                },
            .corners = {}};
}

// The renderings of some rows: by every tie rule, then moved.
class EightDrawings {
  public:
    EightDrawings(const peeling::FrameRequest& input, const SceneFragments& given, const Rows& rows) : given_{given} {
        constexpr std::uint64_t bytes = std::uint64_t{1} << 30;
        using rasterizer::TieRule;
        for (const TieRule rule :
             {TieRule::top_left, TieRule::top_right, TieRule::bottom_left, TieRule::bottom_right}) {
            if (rule == input.profile.raster.tie_rule) continue;
            pipeline::DeviceProfile& profile = profiles_.emplace_back(input.profile);
            profile.raster.tie_rule = rule;
            others_.emplace_back(input.on(profile, input.options), bytes, rows);
        }
        for (const double right : {moved_by, -moved_by})
            for (const double up : {moved_by, -moved_by}) {
                peeling::RenderOptions options = input.options;
                options.vertex_alteration =
                    &changes_.emplace_back(moved(right, up, input.options.width, input.options.height));
                others_.emplace_back(input.with(options), bytes, rows);
            }
    }

    // The lists of a pixel, the given rendering's first. They are valid until the next call.
    [[nodiscard]] std::span<OtherList> at(int x, int memory_row) {
        lists_.clear();
        lists_.push_back(copy_of(given_.list_at(x, memory_row)));
        for (const SceneFragments& other : others_) lists_.push_back(copy_of(other.list_at(x, memory_row)));
        return lists_;
    }

    // True if no rendering has a fragment there, and all have the same surface behind it.
    [[nodiscard]] bool is_plain(int x, int memory_row) const {
        const PixelList given = given_.list_at(x, memory_row);
        return is_blank(given) && std::ranges::all_of(others_, [&](const SceneFragments& other) {
                   const PixelList list = other.list_at(x, memory_row);
                   return is_blank(list) && list.has_opaque == given.has_opaque && list.opaque == given.opaque &&
                          list.behind == given.behind;
               });
    }

  private:
    const SceneFragments& given_;
    // The renderings refer to these.
    std::deque<pipeline::DeviceProfile> profiles_{};
    std::deque<pipeline::VertexAlteration> changes_{};
    std::deque<SceneFragments> others_{};
    std::vector<OtherList> lists_{};
};

// Bands of rows whose eight renderings take about as much memory as a quarter of the picture's bound.
std::vector<Rows> bands_of(const SceneFragments& scene) {
    constexpr std::uint64_t drawings = 8, least = std::uint64_t{24} << 20, bytes_a_pixel = 24, of_pixel = 28;
    constexpr int step = 64;  // rows of a tile
    const auto width = static_cast<std::uint64_t>(scene.width());
    const std::uint64_t most = std::max(least, bytes_a_pixel * width * static_cast<std::uint64_t>(scene.height()));
    const std::vector<std::uint64_t> bytes = scene.bytes_of_rows();
    std::vector<Rows> bands{{0, 0}};
    std::uint64_t sum = 0;
    for (int y = 0; y < scene.height(); y += step) {
        const int end = std::min(y + step, scene.height());
        std::uint64_t more = 0;
        for (int row = y; row < end; ++row)
            more += drawings * (bytes[static_cast<std::size_t>(row)] + of_pixel * width);
        if (sum + more > most && bands.back().end > bands.back().first) {
            bands.push_back({y, y});
            sum = 0;
        }
        sum += more;
        bands.back().end = end;
    }
    return bands;
}

}  // namespace

Coverages::Coverages(const peeling::FrameRequest& input, const SceneFragments& given, const TakeSpreads& take)
    : width_{given.width()} {
    number_.assign(static_cast<std::size_t>(given.width()) * static_cast<std::size_t>(given.height()), 0);
    for (const Rows& rows : bands_of(given)) {
        EightDrawings drawings{input, given, rows};
        for (int row = rows.first; row < rows.end; ++row)
            for (int x = 0; x < given.width(); ++x) {
                if (drawings.is_plain(x, row)) continue;
                add(given.list_at(x, row), row, drawings.at(x, row), take);
            }
    }
}

void Coverages::add(const PixelList& pixel, int memory_row, std::span<OtherList> lists, const TakeSpreads& take) {
    std::vector<const OtherList*> of_pixel;
    for (const OtherList& list : lists) of_pixel.push_back(&list);
    find_spreads(lists[0], Drawings{of_pixel}.subspan(tie_drawings));
    std::vector<float> spreads;
    for (const auto* part : {&lists[0].visible, &lists[0].hidden})
        for (const Fragment& f : *part) spreads.push_back(f.spread);
    if (!spreads.empty()) take(pixel.x, memory_row, spreads);
    const std::size_t at = index(pixel.x, pixel.y);
    if (lists[0].behind_spread > 0) {
        behind_spreads_.resize(number_.size());
        behind_spreads_[at] = lists[0].behind_spread;
    }
    EdgePixel edge = edge_pixel_of(of_pixel);
    if (edge.others.empty() && !edge.has_centre_on_edge) return;
    pixels_.push_back(std::move(edge));
    number_[at] = static_cast<std::uint32_t>(pixels_.size());
}

const EdgePixel* Coverages::at(int x, int y) const noexcept {
    const std::uint32_t number =
        number_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x)];
    return number == 0 ? nullptr : &pixels_[number - 1];
}

}  // namespace strata::oracle::verdict
