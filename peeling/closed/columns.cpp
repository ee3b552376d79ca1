// peeling/closed/columns.cpp - where the columns of a region live: how much memory they get, how many pixels at a time.
//
// Rule     Arrivals are put down band by band, a band being whole rows of the region whose fragments fit into a
//          second-level cache. First the whole region is tried as one band, which most tiles are; a region that does not
//          fit is counted and cut. One row that exceeds the fragment memory makes the closed form decline, and so does a
//          depth beyond the range, of a fragment or of the surface.
// Numbers  At most 2^24 - 1 fragments at a pixel, or the form declines, too. A place has 32 bits. Every column takes a
//          word of 8 bytes for each fragment of the tallest one, and every place 16 bytes of colour: Band::bytes.
#include "peeling/closed/columns.h"

#include <algorithm>
#include <bit>

#include "peeling/closed/arrival_rows.h"
#include "peeling/closed/arrivals.h"
#include "pipeline/fragments/arena.h"
#include "pipeline/region/region_shortcuts.h"
#include "rasterizer/rules/depth_code.h"
#include "rasterizer/walk/rows.h"

namespace strata::peeling {

using namespace pipeline;

namespace {

constexpr std::size_t word_bytes = sizeof(std::uint64_t), color_bytes = 4 * sizeof(float);
constexpr std::size_t cached_bytes = std::size_t{1}
                                     << 20;         // what a second-level cache holds of them beside the targets
constexpr std::uint32_t most_ranks = 0xffffff;      // 2 GiB of words in the narrowest row
constexpr std::uint64_t most_places = 0xffffff00;   // a place has 32 bits
constexpr std::uint32_t first_place = block_lanes;  // what rows would write before it, and does not count
static_assert(rasterizer::row_padding <= block_lanes);

[[nodiscard]] std::size_t blocks_of(std::size_t pixels) noexcept { return (pixels + block_lanes - 1) / block_lanes; }

// Rows of the region, and how much their fragments take.
struct Band {
    rasterizer::Rect rect;
    std::uint64_t ranks = 0, places = 0;

    // 16 more words: ranks a power of two apart would fall on the same lines of a cache.
    [[nodiscard]] std::size_t stride() const noexcept { return (blocks_of(rect.area()) + 1) * block_lanes; }
    [[nodiscard]] std::uint64_t bytes() const noexcept { return ranks * stride() * word_bytes + places * color_bytes; }
};

class RegionColumns {
  public:
    RegionColumns(Region& region, const std::function<void(const ColumnBlock&)>& visit)
        : region_{region},
          visit_{visit},
          bytes_{region.frame().replay.bytes},
          by_shader_z_{region.frame().key == DepthKey::shader_z},
          may_leave_range_{region.frame().profile->raster.depth_limits == rasterizer::DepthLimits::wrap},
          shortcuts_{region},
          rows_of_{shortcuts_.row_source()} {
        const std::size_t pixels =
            (blocks_of(region.rect().area()) + 1) * block_lanes;  // a row may end behind the last
        for (auto* const counts : {&count_, &hidden_, &at_surface_})
            *counts = shortcuts_.arena().take<std::uint32_t>(pixels);
    }

    // First as if all fitted into a cache: one walk. What does not is counted, and walked band by band.
    [[nodiscard]] std::optional<RegionFragments> run() {
        if (!region_.has_ordered_surface()) return std::nullopt;
        const Band whole = as_much_as_is_cached();
        if (whole.ranks > 0) {
            take_memory(whole);
            if (place(whole)) {
                visit_blocks(whole);
                return fragments_;
            }
        }
        std::vector<Band> bands;
        if (!plan(bands)) return std::nullopt;
        fragments_ = {};
        for (const Band& band : bands) {
            take_memory(band);
            if (!place(band)) return std::nullopt;
            visit_blocks(band);
        }
        return fragments_;
    }

  private:
    // The key in one of its two forms, and the colour; nothing else of a fragment enters a closed form.
    [[nodiscard]] rasterizer::FragmentNeeds needs() const noexcept {
        return {by_shader_z_, !by_shader_z_, false, true, false, false};
    }

    // The region as one band, half of the cache for words and the rest for colours. Nothing is known yet of its
    // fragments: placing them shows whether they fit.
    [[nodiscard]] Band as_much_as_is_cached() const {
        const std::uint64_t bytes = std::min<std::uint64_t>(cached_bytes, bytes_);
        Band band{region_.rect()};
        band.ranks = std::min<std::uint64_t>(bytes / 2 / (band.stride() * word_bytes), most_ranks);
        band.places = (bytes - band.ranks * band.stride() * word_bytes) / color_bytes;
        return band;
    }

    // False: a single row is too much.
    [[nodiscard]] bool plan(std::vector<Band>& bands) {
        const rasterizer::Rect rect = region_.rect();
        const auto width = static_cast<std::size_t>(rect.width());
        const auto coverage = shortcuts_.arena().take<std::uint32_t>(rect.area() + block_lanes);
        const auto places = shortcuts_.arena().take<std::uint32_t>(static_cast<std::size_t>(rect.height()));
        find_coverage(coverage, places);
        for (int y = rect.y0; y < rect.y1; ++y) {
            Band row{{rect.x0, y, rect.x1, y + 1}};
            const auto number = static_cast<std::size_t>(y - rect.y0);
            row.ranks = std::ranges::max(coverage.subspan(number * width, width));
            row.places = places[number];
            if (row.bytes() > bytes_ || row.ranks > most_ranks || row.places > most_places) return false;
            if (!bands.empty()) {
                const Band& last = bands.back();
                const Band both{
                    {rect.x0, last.rect.y0, rect.x1, y + 1}, std::max(last.ranks, row.ranks), last.places + row.places};
                if (both.bytes() <= std::min<std::uint64_t>(bytes_, cached_bytes)) {
                    bands.back() = both;
                    continue;
                }
            }
            bands.push_back(row);
        }
        return true;
    }

    // Counts the fragments of every pixel, and the places that the fragments of every row of pixels take.
    void find_coverage(std::span<std::uint32_t> coverage, std::span<std::uint32_t> places) {
        std::ranges::fill(coverage, 0u);
        std::ranges::fill(places, 0u);
        if (rows_of_) return count_rows(*rows_of_, region_.rect(), coverage.data(), places.data());
        shortcuts_.count_coverage(coverage);
        const auto width = static_cast<std::size_t>(region_.rect().width());
        for (std::size_t y = 0; y < places.size(); ++y)
            for (const std::uint32_t n : coverage.subspan(y * width, width)) places[y] += n;
    }

    // One piece of memory, cut anew for every band; another one where a single row needs more.
    void take_memory(const Band& band) {
        const std::size_t words = band.ranks * band.stride(), levels = band.ranks * block_lanes;
        const std::size_t places = first_place + band.places + block_lanes;
        const std::size_t needed = (words + levels) * word_bytes + places * color_bytes;
        if (memory_.size() < needed) memory_ = shortcuts_.arena().take<std::byte>(needed);
        word_ = reinterpret_cast<std::uint64_t*>(memory_.data());
        levels_ = word_ + words;
        auto* const colors = reinterpret_cast<float*>(levels_ + levels);
        for (std::size_t c = 0; c < 4; ++c) color_[c] = colors + c * places;
    }

    // Puts the fragments of a band down. Counts start at 0 for every band; words and colours need no clearing, since a
    // count says how many of them are there.
    [[nodiscard]] bool place(const Band& band) {
        for (const auto& counts : {count_, hidden_, at_surface_}) std::ranges::fill(counts, 0u);
        arrivals_ = {.stride = band.stride(),
                     .ranks = static_cast<std::uint32_t>(band.ranks),
                     .places = first_place,
                     .most_places = first_place + static_cast<std::uint32_t>(band.places),
                     .word = word_,
                     .count = count_.data(),
                     .hidden = hidden_.data(),
                     .at_surface = at_surface_.data(),
                     .opaque = region_.storage(region_.opaque_depth()).depth(0) + first_of(band),
                     .same_opaque = shortcuts_.opaque_depth_is_cleared(),
                     .by_shader_z = by_shader_z_};
        for (std::size_t c = 0; c < 4; ++c) arrivals_.color[c] = color_[c];
        const bool fits = rows_of_ ? place_rows(band) : place_batches(band);
        fragments_.has_denormals |= arrivals_.has_denormals;
        return fits;
    }

    // No column sorts depths beyond the range (depth.md 2.9): the form declines.
    [[nodiscard]] bool leaves_range(const FragmentBatch& in) const {
        const auto is_beyond = [&](std::size_t i) {
            return by_shader_z_ ? std::bit_cast<std::uint32_t>(in.shader_z[i]) > std::bit_cast<std::uint32_t>(1.0f)
                                : rasterizer::is_beyond_range(in.code[i], region_.frame().key_request().format);
        };
        bool any = false;
        for (std::size_t i = 0; i < lanes(in); ++i) any |= is_beyond(i);
        return any;
    }

    // The way of batches: after texture and MASK, whose victims are counted, as `alpha_killed` wants it.
    [[nodiscard]] bool place_batches(const Band& band) {
        return shortcuts_.look(needs(), band.rect, [&](const FragmentBatch& in, const Outputs& out) {
            if (may_leave_range_ && leaves_range(in)) return false;
            fragments_.rasterized += lanes(in);
            fragments_.masked += lanes(in) - RegionShortcuts::alive_count(out, in.count);
            return append(arrivals_, in, out.alive.data());
        });
    }

    // Each part has twice as many triangles as the one before: if they do not fit, that is known soon.
    [[nodiscard]] bool place_rows(const Band& band) {
        const std::uint64_t before = fragments_.rasterized;
        bool fits = true;
        auto triangles = rows_of_->triangles;
        for (std::size_t part = 64; fits && !triangles.empty(); part *= 2) {
            part = std::min(part, triangles.size());
            fits = append_rows(arrivals_, *rows_of_, triangles.first(part), band.rect, fragments_.rasterized);
            triangles = triangles.subspan(part);
        }
        shortcuts_.looked_at(fragments_.rasterized - before);
        return fits;
    }

    [[nodiscard]] std::size_t first_of(const Band& band) const noexcept {
        return static_cast<std::size_t>(band.rect.y0 - region_.rect().y0) *
               static_cast<std::size_t>(region_.rect().width());
    }

    // Blocks go from the band's first pixel on, sixteen neighbours each; one may end in the next row of the region.
    void visit_blocks(const Band& band) {
        const std::size_t pixels = band.rect.area();
        ColumnBlock block;
        for (std::size_t c = 0; c < 4; ++c) block.color[c] = color_[c];
        for (std::size_t pixel = 0; pixel < pixels; pixel += block_lanes) {
            if (!take_block(arrivals_, pixel, block, levels_)) continue;
            block.first = first_of(band) + pixel;
            block.count = static_cast<int>(std::min(pixels - pixel, block_lanes));
            fragments_.nearest = std::min(fragments_.nearest, block.nearest);
            visit_(block);
        }
    }

    Region& region_;
    const std::function<void(const ColumnBlock&)>& visit_;
    std::uint64_t bytes_;  // the region's share of memory
    bool by_shader_z_, may_leave_range_;
    RegionShortcuts shortcuts_;
    std::optional<RowSource> rows_of_;  // empty: batches
    RegionFragments fragments_;
    Arrivals arrivals_;
    std::span<std::uint32_t> count_, hidden_, at_surface_;
    std::span<std::byte> memory_;
    std::uint64_t *word_ = nullptr, *levels_ = nullptr;
    std::array<float*, 4> color_{};
};

}  // namespace

std::optional<RegionFragments> for_each_block(Region& region, const std::function<void(const ColumnBlock&)>& visit) {
    return RegionColumns{region, visit}.run();
}

}  // namespace strata::peeling
