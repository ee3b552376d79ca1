// peeling/front_to_back_closed.cpp - front-to-back peeling as a closed form: pass i composites the i-th depth of every pixel.
//
// Ties       the first arrival of a depth is its layer; the others are never seen.
// Counters   pass i discards what lies at or before depth i - 1 (behind a pixel's last layer: at or before the opaque surface), and
//            the depth test passes whatever is nearer than all that came before it and still counts. Fragment f does so in
//            the passes whose threshold lies in [depth of m, depth of f), where m is the farthest of the earlier arrivals that
//            are not behind f: from no depth at all (pass 1) if there is none.
#include <algorithm>
#include <bit>

#include "peeling/closed_form.h"
#include "pipeline/arena.h"
#include "pipeline/blend.h"
#include "pipeline/convert.h"

namespace strata::peeling {

using namespace pipeline;

namespace {

// What the passes count, summed over pixels. Index i is pass i, from 1.
struct PassTallies {
    std::vector<std::uint64_t> first_passed, no_longer_passed;  // fragments that begin, and cease, to pass the depth test there
    std::vector<std::uint64_t> discarded;                       // by pixels that have a layer i - 1
    std::vector<std::uint64_t> exhausted;                       // discarded from there on by pixels that have none

    void make_room(std::size_t passes) {
        if (exhausted.size() > passes) return;
        for (auto* const tally : {&first_passed, &no_longer_passed, &discarded, &exhausted}) tally->resize(2 * passes + 1);
    }
};

// A set of places in a column.
class PlaceSet {
  public:
    void clear(std::size_t places) { words_.assign(places / 64 + 1, 0); }
    void add(std::size_t place) { words_[place / 64] |= std::uint64_t{1} << (place % 64); }
    // How many places there are up to the last member before `place`; 0 if there is none.
    [[nodiscard]] std::size_t before(std::size_t place) const {
        std::size_t word = place / 64;
        std::uint64_t bits = words_[word] & ((std::uint64_t{1} << (place % 64)) - 1);
        while (bits == 0 && word > 0) bits = words_[--word];
        return bits == 0 ? 0 : word * 64 + static_cast<std::size_t>(std::bit_width(bits));
    }

  private:
    std::vector<std::uint64_t> words_;
};

class ColumnTallies {
  public:
    explicit ColumnTallies(PassTallies& tallies) : tallies_{tallies} {}

    void add(const Columns& columns, std::size_t pixel) {
        const std::uint32_t n = columns.visible[pixel];
        if (columns.alive[pixel] == 0) return;
        tallies_.make_room(n + 2);
        rank_.resize(n);
        place_.resize(n);
        std::uint32_t depths = 0;
        for (std::uint32_t k = 0; k < n; ++k) {
            const std::size_t slot = columns.slot(pixel, k);
            const bool is_new = k == 0 || columns.key[slot] != columns.key[slot - block_lanes];
            if (is_new && k > 0) tallies_.discarded[depths + 1] += k;  // at or before depth `depths`
            depths += is_new ? 1 : 0;
            rank_[k] = depths;
            place_[columns.order[slot]] = k;
        }
        if (n > 0) tallies_.discarded[depths + 1] += n;
        tallies_.exhausted[depths + 2] += n + columns.at_surface[pixel];
        add_passed(n);
    }

  private:
    void add_passed(std::uint32_t n) {
        arrived_.clear(n);
        for (const std::uint32_t place : place_) {
            const std::size_t before = arrived_.before(place);
            const std::uint32_t threshold = before > 0 ? rank_[before - 1] : 0;
            arrived_.add(place);
            if (threshold == rank_[place]) continue;
            ++tallies_.first_passed[threshold + 1];
            ++tallies_.no_longer_passed[rank_[place] + 1];
        }
    }

    PassTallies& tallies_;
    std::vector<std::uint32_t> rank_, place_;  // by place in the column; by arrival
    PlaceSet arrived_;
};

// Composites the layers of up to sixteen neighbouring pixels as `peel` and `composite` do: stored, loaded, blended UNDER.
class GroupComposite {
  public:
    GroupComposite(Region& region, const Columns& columns, const PixelGroup& group, std::size_t first_in_region)
        : region_{region}, columns_{columns}, group_{group}, first_{first_in_region}, n_{static_cast<std::size_t>(group.count)} {
        std::fill_n(next_.begin(), n_, 0u);
    }

    // The last layer is an empty one, as in the last pass.
    void run(BlockCodes& block) {
        const Format format = region_.frame().color_format;
        ColorCodes accumulated;
        for (std::size_t c = 0; c < 4; ++c) std::copy_n(block[c].begin(), n_, accumulated[c].begin());
        for (bool any = true; any;) {
            any = take_layer();
            for (std::size_t c = 0; c < 4; ++c) {
                encode(info(format).type, region_.profile().half_rounding, layer_[c], codes_, group_.count);
                decode(info(format).type, codes_, layer_[c], group_.count);
            }
            blend(blend_mode::under, info(format).type, region_.profile(), 4, layer_, accumulated, group_.count);
        }
        for (std::size_t c = 0; c < 4; ++c) std::copy_n(accumulated[c].begin(), n_, block[c].begin());
    }

  private:
    [[nodiscard]] bool take_layer() {
        bool any = false;
        for (std::size_t i = 0; i < n_; ++i) {
            const std::size_t pixel = group_.first + i;
            const std::uint32_t k = next_[i], end = columns_.visible[pixel];
            const bool has = k < end;
            const std::size_t slot = has ? columns_.sorted(pixel, k) : 0;
            for (std::size_t c = 0; c < 4; ++c) color_[c][i] = has ? columns_.color[c][slot] : 0.0f;
            if (!has) continue;
            any = true;
            const std::uint32_t key = columns_.key[columns_.slot(pixel, k)];
            if (region_.frame().trace) region_.trace({static_cast<std::uint32_t>(first_ + i), key, 0, Side::front, false});
            while (next_[i] < end && columns_.key[columns_.slot(pixel, next_[i])] == key) ++next_[i];
        }
        premultiply(color_, layer_, n_);
        return any;
    }

    Region& region_;
    const Columns& columns_;
    PixelGroup group_;
    std::size_t first_, n_;
    Lanes<std::uint32_t> next_, codes_;
    ColorLanes color_, layer_;
};

// The same where no column has equal depths.
void peel_layers(Region& region, const Columns& columns, PeelBlock& block, const PixelGroup& group, std::size_t first) {
    peel_front(block, region.profile().blend_rounding);
    if (!region.frame().trace) return;
    for (std::size_t i = 0; i < static_cast<std::size_t>(group.count); ++i)
        for (std::uint32_t k = 0; k < block.visible[i]; ++k) {
            const std::uint32_t key = columns.key[columns.slot(group.first + i, k)];
            region.trace({static_cast<std::uint32_t>(first + i), key, 0, Side::front, false});
        }
}

// What the accumulated colour is cleared to, (0, 0, 0, 1), as codes.
BlockCodes cleared(const Region& region) {
    BlockCodes block{};
    Lanes<float> one;
    Lanes<std::uint32_t> code;
    std::fill_n(one.begin(), block_lanes, 1.0f);
    encode(info(region.frame().color_format).type, region.profile().half_rounding, one, code, int{block_lanes});
    std::copy_n(code.begin(), block_lanes, block[3].begin());
    return block;
}

// Everything that one iteration counts; called with 1, 2, 3 ...
class PassCounters {
  public:
    PassCounters(const Region& region, const RegionFragments& fragments, const PassTallies& tallies)
        : tallies_{tallies}, fragments_{fragments}, area_{region.rect().area()},
          color_{bytes_per_pixel(region.frame().color_format)},
          depth_{bytes_per_pixel(target_format(region.frame().key_request().format))} {}

    [[nodiscard]] Counters of(std::size_t pass) {
        passed_ += at(tallies_.first_passed, pass) - at(tallies_.no_longer_passed, pass);
        exhausted_ += at(tallies_.exhausted, pass);
        const std::uint64_t discarded = at(tallies_.discarded, pass) + exhausted_;
        const std::uint64_t arriving = fragments_.rasterized - fragments_.masked - discarded;
        const std::uint64_t loads = pass > 1 ? depth_ * fragments_.rasterized : 0;
        const std::uint64_t clear_and_copy = (color_ + depth_) * area_, quad = (2 * color_ + 2 * depth_) * area_;
        return {.fragments_rasterized = fragments_.rasterized, .discarded = discarded, .alpha_killed = fragments_.masked,
                .depth_killed = arriving - passed_, .blended = passed_,
                .bytes_read = loads + depth_ * arriving + depth_ * area_ + quad,
                .bytes_written = (color_ + depth_) * passed_ + clear_and_copy + color_ * area_};
    }
    [[nodiscard]] std::uint64_t passed() const noexcept { return passed_; }  // in the latest pass

  private:
    [[nodiscard]] static std::uint64_t bytes_per_pixel(Format format) {
        return static_cast<std::uint64_t>(info(format).bytes_per_pixel);
    }
    [[nodiscard]] static std::uint64_t at(const std::vector<std::uint64_t>& tally, std::size_t i) {
        return i < tally.size() ? tally[i] : 0;
    }

    const PassTallies& tallies_;
    RegionFragments fragments_;
    std::uint64_t area_, color_, depth_;
    std::uint64_t passed_ = 0, exhausted_ = 0;
};

}  // namespace

bool front_to_back_closed(Region& region) {
    if (!peels_to_the_end(region.frame())) return false;
    PassTallies tallies;
    ColumnTallies pixel_tallies{tallies};
    const Target accumulated = region.make_color();
    CodePlanes planes{region, accumulated};
    const bool rgba8 = region.frame().color_format == Format::rgba8;
    const BlockCodes before = cleared(region);
    const auto fragments = for_each_band(region, [&](const Columns& columns) {
        for (std::size_t pixel = 0; pixel < columns.pixels(); ++pixel) pixel_tallies.add(columns, pixel);
        const std::size_t above = static_cast<std::size_t>(columns.band.y0 - region.rect().y0) *
                                  static_cast<std::size_t>(region.rect().width());
        for_each_block(columns, [&](std::size_t number, const PixelGroup& group) {
            PeelBlock block = peel_block(columns, number);
            const std::size_t first = above + group.first;
            block.front = before;
            if (rgba8 && !columns.blocks[number].has_ties) peel_layers(region, columns, block, group, first);
            else GroupComposite{region, columns, group, first}.run(block.front);
            planes.store(first, group.count, block.front);
        });
    });
    if (!fragments) return false;
    region.clear(accumulated, {.color = {0, 0, 0, 1}});
    planes.write_to(accumulated);
    PassCounters counters{region, *fragments, tallies};
    for (std::size_t pass = 1; !region.limit_reached(); ++pass) {
        region.begin_iteration();
        region.count(counters.of(pass), {.geometry = 1, .full_screen = 1, .copies = 1});
        if (!region.any(Region::counted(counters.passed()), Idle::when_zero)) break;
    }
    publish_over_background(region, accumulated, region.opaque_color());
    return true;
}

}  // namespace strata::peeling
