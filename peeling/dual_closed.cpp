// peeling/dual_closed.cpp - dual peeling as a closed form: pass i takes the i-th depth from the front and the i-th from the back.
//
// Holds      for 8-bit targets, where MAX over codes does not ask for an order; for visible depths that MAX keeps as they are: not
//            below the cleared -1, and not flushed as denormals.
// Ties       a depth is one group: MAX over its fragments' blends, and over the front that every other fragment passes through.
// Invariant  before pass i, [near, far) are the fragments between the depths already peeled.
#include <algorithm>

#include "peeling/closed_form.h"
#include "peeling/front_and_back.h"
#include "peeling/min_max.h"
#include "pipeline/blend.h"
#include "pipeline/convert.h"

namespace strata::peeling {

using namespace pipeline;

namespace {

// The fragments of one depth of every pixel of a group: [begin, end) in its sorted column, empty where nothing is left.
struct DepthGroup {
    Lanes<std::uint32_t> begin, end;
};

// The course of up to sixteen neighbouring pixels, pass after pass.
class GroupPeel {
  public:
    GroupPeel(Region& region, const Columns& columns, const PixelGroup& group, std::size_t first_in_region,
              const BlockCodes& opaque)
        : region_{region}, columns_{columns}, group_{group}, first_{first_in_region}, n_{static_cast<std::size_t>(group.count)} {
        for (std::size_t i = 0; i < n_; ++i) {
            near_[i] = 0;
            far_[i] = columns.visible[group.first + i];
        }
        for (auto& channel : front_) std::fill_n(channel.begin(), n_, 0u);
        for (std::size_t c = 0; c < 4; ++c) std::copy_n(opaque[c].begin(), n_, back_[c].begin());
    }

    // False once every pixel is done.
    [[nodiscard]] bool pass() {
        if (!next_groups()) return false;
        blend_front();
        blend_back();
        return true;
    }
    void result(BlockCodes& front, BlockCodes& back) const {
        for (std::size_t c = 0; c < 4; ++c) {
            std::copy_n(front_[c].begin(), n_, front[c].begin());
            std::copy_n(back_[c].begin(), n_, back[c].begin());
        }
    }

  private:
    [[nodiscard]] std::uint32_t key(std::size_t i, std::uint32_t k) const noexcept {
        return columns_.key[columns_.slot(group_.first + i, k)];
    }

    [[nodiscard]] bool next_groups() {
        bool any = false;
        for (std::size_t i = 0; i < n_; ++i) {
            std::uint32_t near = near_[i], far = far_[i];
            near_group_.begin[i] = near;
            if (near < far) {
                any = true;
                trace(i, near, Side::front);
                const std::uint32_t nearest = key(i, near++);
                while (near < far && key(i, near) == nearest) ++near;
            }
            near_group_.end[i] = far_group_.end[i] = near;
            if (near < far) {
                far_group_.end[i] = far;
                trace(i, far - 1, Side::back);
                const std::uint32_t farthest = key(i, --far);
                while (near < far && key(i, far - 1) == farthest) --far;
            }
            far_group_.begin[i] = std::min(far, far_group_.end[i]);
            near_[i] = near;
            far_[i] = far;
        }
        return any;
    }

    void trace(std::size_t i, std::uint32_t k, Side side) {
        if (!region_.frame().trace) return;
        region_.trace({static_cast<std::uint32_t>(first_ + i), key(i, k), 0, side, false});
    }

    // The colours of the groups' `member`-th fragments; false if no group has so many.
    [[nodiscard]] bool take(const DepthGroup& group, std::uint32_t member) {
        bool any = false;
        for (std::size_t i = 0; i < n_; ++i) {
            near_place_.is_near[i] = group.begin[i] + member < group.end[i] ? ~0u : 0u;
            any |= near_place_.is_near[i] != 0;
            const std::size_t slot = near_place_.is_near[i] != 0 ? columns_.sorted(group_.first + i, group.begin[i] + member) : 0;
            for (std::size_t c = 0; c < 4; ++c) color_[c][i] = near_place_.is_near[i] != 0 ? columns_.color[c][slot] : 0.0f;
        }
        return any;
    }

    // blended = MAX over what it holds and the codes of `values`, where the group has this member.
    void max_into(const ColorLanes& values, ColorCodes& blended) {
        for (std::size_t c = 0; c < 4; ++c) {
            encode(ChannelType::unorm8, region_.profile().half_rounding, values[c], codes_, group_.count);
            for (std::size_t i = 0; i < n_; ++i) blended[c][i] = std::max(blended[c][i], codes_[i] & near_place_.is_near[i]);
        }
    }

    void blend_front() {
        for (std::size_t c = 0; c < 4; ++c) {
            decode(ChannelType::unorm8, front_[c], front_values_[c], group_.count);
            for (std::size_t i = 0; i < n_; ++i) {
                const std::uint32_t in_group = near_group_.end[i] - near_group_.begin[i];
                const bool passes_through = columns_.alive[group_.first + i] > in_group;
                front_[c][i] = passes_through ? front_[c][i] : 0u;
            }
        }
        for (std::uint32_t member = 0; take(near_group_, member); ++member) {
            scalar::write_layers(color_, front_values_, near_place_, blended_, unused_, n_);
            max_into(blended_, front_);
        }
    }

    void blend_back() {
        for (auto& channel : dump_) std::fill_n(channel.begin(), n_, 0u);
        for (std::uint32_t member = 0; take(far_group_, member); ++member) max_into(color_, dump_);
        for (std::size_t c = 0; c < 4; ++c) decode(ChannelType::unorm8, dump_[c], color_[c], group_.count);
        ColorCodes& over = blended_codes_;
        over = back_;
        static constexpr Blend colors_only = [] {
            Blend b = blend_mode::over;
            b.write_mask = 0x7;  // BACK has no alpha of its own
            return b;
        }();
        blend(colors_only, ChannelType::unorm8, region_.profile(), 4, color_, over, group_.count);
        for (std::size_t c = 0; c < 3; ++c)
            for (std::size_t i = 0; i < n_; ++i) back_[c][i] = dump_[3][i] != 0 ? over[c][i] : back_[c][i];
    }

    Region& region_;
    const Columns& columns_;
    PixelGroup group_;
    std::size_t first_, n_;
    Lanes<std::uint32_t> near_, far_, codes_;
    PeelLanes near_place_{};  // is_near: the group has the member that `take` took
    DepthGroup near_group_, far_group_;
    ColorCodes front_, back_, dump_, blended_codes_;
    ColorLanes front_values_, color_, blended_, unused_;
};

// What MAX blending of (-z, z) onto (-1, -1) would not keep.
bool has_foreign_depths(const Columns& columns, const DeviceProfile& profile) {
    const std::uint32_t least = ordered_code(-1.0f), zero = ordered_code(0.0f);
    const std::uint32_t first_normal = ordered_code(0x1p-126f), last_normal = ordered_code(-0x1p-126f);
    const bool flushes = profile.denormals == DenormalRule::flush;
    for (const ColumnBlock& block : columns.blocks)
        for (std::size_t s = block.first; s < block.first + block.depth * block_lanes; ++s) {
            const std::uint32_t key = columns.key[s];
            const bool denormal = key > last_normal && key < first_normal && key != zero;
            if (key < least || (flushes && denormal)) return true;
        }
    return false;
}

// Depths of a sorted column.
std::size_t distinct(const Columns& columns, std::size_t pixel) {
    std::size_t count = 0;
    for (std::uint32_t k = 0; k < columns.visible[pixel]; ++k)
        count += k == 0 || columns.key[columns.slot(pixel, k)] != columns.key[columns.slot(pixel, k - 1)] ? 1 : 0;
    return count;
}

struct Course {
    CodePlanes front, back;
    std::vector<std::uint64_t> pixels_by_depths;
    bool declined = false;

    void run(Region& region, const Columns& columns) {
        declined |= has_foreign_depths(columns, region.profile());
        if (declined) return;
        for (std::size_t pixel = 0; pixel < columns.pixels(); ++pixel) {
            const bool has_ties = columns.blocks[pixel / block_lanes].has_ties;
            tally(pixels_by_depths, has_ties ? distinct(columns, pixel) : columns.visible[pixel]);
        }
        const std::size_t above = static_cast<std::size_t>(columns.band.y0 - region.rect().y0) *
                                  static_cast<std::size_t>(region.rect().width());
        for_each_block(columns, [&](std::size_t number, const PixelGroup& group) {
            if (columns.blocks[number].depth == 0) return;
            PeelBlock block = peel_block(columns, number);
            const std::size_t first = above + group.first;
            front.load(first, block.front);
            back.load(first, block.back);
            if (columns.blocks[number].has_ties) {
                GroupPeel peel{region, columns, group, first, block.back};
                while (peel.pass()) {}
                peel.result(block.front, block.back);
            } else {
                peel_both_ends(block, region.profile().blend_rounding);
                if (region.frame().trace) trace_block(region, columns, group, first);
            }
            front.store(first, group.count, block.front);
            back.store(first, group.count, block.back);
        });
    }

    // Pass by pass, the front before the back.
    static void trace_block(Region& region, const Columns& columns, const PixelGroup& group, std::size_t first) {
        for (std::size_t i = 0; i < static_cast<std::size_t>(group.count); ++i) {
            const std::uint32_t n = columns.visible[group.first + i];
            const auto add = [&](std::uint32_t k, Side side) {
                const std::uint32_t key = columns.key[columns.slot(group.first + i, k)];
                region.trace({static_cast<std::uint32_t>(first + i), key, 0, side, false});
            };
            for (std::uint32_t pass = 0; 2 * pass < n; ++pass) {
                add(pass, Side::front);
                if (2 * pass + 1 < n) add(n - 1 - pass, Side::back);
            }
        }
    }

    // Pixels that have something left after `passes` peels.
    [[nodiscard]] std::uint64_t left(std::size_t passes) const {
        std::uint64_t pixels = 0;
        for (std::size_t depths = 2 * passes + 1; depths < pixels_by_depths.size(); ++depths) pixels += pixels_by_depths[depths];
        return pixels;
    }
};

// What the draws and the quad of `dual` count; its clears and copies are done, or counted here where they repeat.
Counters of_initialize(const RegionFragments& fragments) {
    const std::uint64_t alive = fragments.rasterized - fragments.masked;
    return {.fragments_rasterized = fragments.rasterized, .alpha_killed = fragments.masked, .blended = alive,
            .bytes_read = 4 * fragments.rasterized + 8 * alive, .bytes_written = 8 * alive};
}
Counters of_peel(const RegionFragments& fragments, std::uint64_t area) {
    const std::uint64_t alive = fragments.rasterized - fragments.masked;
    constexpr std::uint64_t min_max = 8, color = 4, depth = 4, targets = min_max + 2 * color;
    return {.fragments_rasterized = fragments.rasterized, .alpha_killed = fragments.masked, .blended = alive,
            .bytes_read = (min_max + color + depth) * fragments.rasterized + targets * alive +
                          (color + 2 * min_max + color) * area,  // the quad's loads and its blending
            .bytes_written = targets * (area + alive) + color * area};
}

}  // namespace

bool dual_closed(Region& region) {
    const Frame& frame = region.frame();
    if (!peels_to_the_end(frame) || frame.color_format != Format::rgba8) return false;
    const std::size_t area = region.rect().area();
    const Target front = region.make_color(), back = region.make_color();  // cleared to 0 by being made
    Course course{{region, front}, {region, region.opaque_color()}, {}};
    const std::size_t traced = region.trace().size();
    const auto fragments = for_each_band(region, [&](const Columns& columns) { course.run(region, columns); });
    if (!fragments || course.declined) {
        region.trace().resize(traced);
        return false;
    }
    region.clear(front, {.color = {0, 0, 0, 0}});
    region.copy(region.opaque_color(), back);
    region.count({.bytes_written = 8 * area}, {});  // the min-max target's clear
    region.count(of_initialize(*fragments), {.geometry = 1});
    for (std::size_t passes = 1; !region.limit_reached(); ++passes) {
        region.begin_iteration();
        region.count(of_peel(*fragments, area), {.geometry = 1, .full_screen = 1});
        if (!region.any(Region::counted(course.left(passes)), Idle::steady)) break;
    }
    course.front.write_to(front);
    course.back.write_to(back);
    publish_front_and_back(region, front, back);
    return true;
}

}  // namespace strata::peeling
