// peeling/closed/dual_closed.cpp - dual peeling as a closed form: pass i takes the i-th depth from the front and the
// i-th from the back. It runs by default in place of the passes of peeling/algorithms/dual.cpp, which are its
// definition: it leaves their bits, counters, queries and trace. tests/peeling/execution_test.cpp and
// sequences_test.cpp compare the two.
//
// Declines   where closed_form.h says, and on what Holds excludes: then the passes run.
// Holds      for targets where MAX does not ask for an order: of 8 bits, or for colours in [0, 1024] and alphas in [0, 1]; for
//            visible depths that MAX keeps as they are: not below the cleared -1, and not flushed as denormals.
// Ties       a depth is one group: MAX over its fragments' blends, and over the front that every other fragment passes through.
// Invariant  before pass i, [near, far) are the fragments between the depths already peeled.
#include <algorithm>
#include <bit>
#include <numeric>

#include "peeling/closed/closed_form.h"
#include "peeling/programs/min_max.h"
#include "pipeline/formats/convert.h"
#include "pipeline/frame/pass_counters.h"
#include "pipeline/region/region_shortcuts.h"
#include "pipeline/stages/blend.h"

namespace strata::peeling {

using namespace pipeline;

namespace {

// False for -0 and NaN, too.
bool is_at_most(float value, float most) noexcept {
    return std::bit_cast<std::uint32_t>(value) <= std::bit_cast<std::uint32_t>(most);
}

// The fragments of one depth of every pixel of a group: [begin, end) in its sorted column, empty where nothing is left.
struct DepthGroup {
    Lanes<std::uint32_t> begin, end;
};

// The course of some pixels of a block, pass after pass.
class GroupPeel {
  public:
    GroupPeel(Region& region, const ColumnBlock& block, const BlockPixels& pixels, const BlockCodes& opaque)
        : region_{region},
          block_{block},
          type_{info(region.frame().color_format).type},
          lane_{pixels.lane},
          n_{pixels.count} {
        for (std::size_t i = 0; i < n_; ++i) {
            near_[i] = 0;
            far_[i] = block.visible[lane_[i]];
        }
        for (auto& channel : front_) std::fill_n(channel.begin(), n_, 0u);
        for (std::size_t c = 0; c < 4; ++c)
            for (std::size_t i = 0; i < n_; ++i) back_[c][i] = opaque[c][lane_[i]];
    }

    // False once every pixel is done.
    [[nodiscard]] bool pass() {
        if (!next_groups()) return false;
        blend_front();
        blend_back();
        return true;
    }
    // Whether MAX of the colours that were taken has no order.
    [[nodiscard]] bool has_plain_colors() const noexcept { return type_ == ChannelType::unorm8 || is_plain_; }
    void result(BlockCodes& front, BlockCodes& back) const {
        for (std::size_t c = 0; c < 4; ++c)
            for (std::size_t i = 0; i < n_; ++i) {
                front[c][lane_[i]] = front_[c][i];
                back[c][lane_[i]] = back_[c][i];
            }
    }

  private:
    [[nodiscard]] std::uint32_t key(std::size_t i, std::uint32_t k) const noexcept { return block_.key(lane_[i], k); }

    // Takes one group from each end. near == far is one group, and the near one (algorithms.md 5.1): the far group is
    // then empty, begin == end, and so is every group of a pixel that is done.
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

    // A group is one mixture, so its entry names the depth and no fragment.
    void trace(std::size_t i, std::uint32_t k, Side side) {
        if (!region_.frame().trace) return;
        region_.trace({static_cast<std::uint32_t>(block_.first + lane_[i]), key(i, k), 0, side, false});
    }

    // The colours of the groups' `member`-th fragments; false if no group has so many.
    [[nodiscard]] bool take(const DepthGroup& group, std::uint32_t member) {
        bool any = false;
        for (std::size_t i = 0; i < n_; ++i) {
            member_.is_near[i] = group.begin[i] + member < group.end[i] ? ~0u : 0u;
            any |= member_.is_near[i] != 0;
            const bool has = member_.is_near[i] != 0;
            const std::size_t place = has ? block_.place(lane_[i], group.begin[i] + member) : 0;
            for (std::size_t c = 0; c < 4; ++c) color_[c][i] = has ? block_.color[c][place] : 0.0f;
            for (std::size_t c = 0; c < 4; ++c) is_plain_ &= is_at_most(color_[c][i], c == 3 ? 1.0f : 1024.0f);
        }
        return any;
    }

    // blended = MAX over what it holds and the codes of `values`, where the group has this member.
    void max_into(const ColorLanes& values, ColorCodes& blended) {
        blended_codes_ = blended;
        blend(blend_mode::max, type_, region_.profile(), 4, values, blended_codes_, static_cast<int>(n_));
        for (std::size_t c = 0; c < 4; ++c)
            for (std::size_t i = 0; i < n_; ++i)
                blended[c][i] = member_.is_near[i] != 0 ? blended_codes_[c][i] : blended[c][i];
    }

    // RT1 starts at 0 in every pass. Its old value survives where a fragment outside the group passes it through; each
    // member then adds its own UNDER of that old value, and MAX keeps the greatest of every channel (E12, E13).
    void blend_front() {
        for (std::size_t c = 0; c < 4; ++c) {
            decode(type_, front_[c], front_values_[c], static_cast<int>(n_));
            for (std::size_t i = 0; i < n_; ++i) {
                const std::uint32_t in_group = near_group_.end[i] - near_group_.begin[i];
                const bool passes_through = block_.visible[lane_[i]] + block_.hidden[lane_[i]] > in_group;
                front_[c][i] = passes_through ? front_[c][i] : 0u;
            }
        }
        for (std::uint32_t member = 0; take(near_group_, member); ++member) {
            scalar::write_layers(color_, front_values_, member_, blended_, unused_, n_);
            max_into(blended_, front_);
        }
    }

    // RT2 holds the greatest of every channel over the group; its value, not the fragments' colours, goes OVER the
    // back.
    void blend_back() {
        for (auto& channel : dump_) std::fill_n(channel.begin(), n_, 0u);
        for (std::uint32_t member = 0; take(far_group_, member); ++member) max_into(color_, dump_);
        for (std::size_t c = 0; c < 4; ++c) decode(type_, dump_[c], color_[c], static_cast<int>(n_));
        ColorCodes& over = blended_codes_;
        over = back_;
        static constexpr Blend colors_only = [] {
            Blend b = blend_mode::over;
            b.write_mask = 0x7;  // BACK has no alpha of its own
            return b;
        }();
        blend(colors_only, type_, region_.profile(), 4, color_, over, static_cast<int>(n_));
        for (std::size_t c = 0; c < 3; ++c)
            for (std::size_t i = 0; i < n_; ++i) back_[c][i] = dump_[3][i] != 0 ? over[c][i] : back_[c][i];
    }

    Region& region_;
    const ColumnBlock& block_;
    ChannelType type_;
    std::array<std::size_t, block_lanes> lane_;
    std::size_t n_;
    bool is_plain_ = true;
    Lanes<std::uint32_t> near_, far_;
    PeelLanes member_{};  // is_near: the group has the member that `take` took
    DepthGroup near_group_, far_group_;
    ColorCodes front_, back_, dump_, blended_codes_;
    ColorLanes front_values_, color_, blended_, unused_;
};

// True if the region has a visible depth that MAX blending of (-z, z) onto (-1, -1) does not keep.
bool has_foreign_depths(const RegionFragments& fragments, const DeviceProfile& profile) {
    const bool flushes = profile.denormals == DenormalRule::flush;
    return fragments.nearest < ordered_code(-1.0f) || (flushes && fragments.has_denormals);
}

// Depths of a sorted column.
std::uint32_t distinct(const ColumnBlock& block, std::size_t lane) {
    std::uint32_t depths = 0;
    for (std::uint32_t k = 0; k < block.visible[lane]; ++k)
        depths += k == 0 || block.key(lane, k) != block.key(lane, k - 1) ? 1 : 0;
    return depths;
}

// Pass by pass, the front before the back.
void trace_pixel(Region& region, const ColumnBlock& block, std::size_t lane) {
    const std::uint32_t n = block.visible[lane];
    const auto add = [&](std::uint32_t k, Side side) {
        region.trace({static_cast<std::uint32_t>(block.first + lane), block.key(lane, k), 0, side, false});
    };
    for (std::uint32_t pass = 0; 2 * pass < n; ++pass) {
        add(pass, Side::front);
        if (2 * pass + 1 < n) add(n - 1 - pass, Side::back);
    }
}

// How many pixels have how many depths: every query is answered from it when all blocks have been visited.
class DepthCounts {
  public:
    // Lane by lane, so that no count waits for the one before it; those of 0 depths are nobody's.
    void add(const ColumnBlock& block) {
        if (by_depths_.size() <= (block.height + 1) * block_lanes) by_depths_.resize((block.height + 1) * block_lanes);
        LaneWords depths = block.visible;
        for (std::size_t lane = 0; lane < block_lanes; ++lane)
            if (block.has_ties[lane] != 0) depths[lane] = distinct(block, lane);
        for (std::size_t lane = 0; lane < block_lanes; ++lane) ++by_depths_[depths[lane] * block_lanes + lane];
    }

    // Sums from the deepest pixels on, once: an answer must not cost the frame's depth.
    void finish() {
        at_least_.assign(by_depths_.size() / block_lanes + 1, 0);
        for (std::size_t depths = at_least_.size() - 1; depths-- > 0;) {
            const auto first = by_depths_.begin() + static_cast<std::ptrdiff_t>(depths * block_lanes);
            at_least_[depths] = std::accumulate(first, first + block_lanes, at_least_[depths + 1]);
        }
    }
    // Pixels that have something left after `passes` peels.
    [[nodiscard]] std::uint64_t left(std::size_t passes) const {
        return at_least_[std::min(2 * passes + 1, at_least_.size() - 1)];
    }

  private:
    std::vector<std::uint64_t> by_depths_;  // sixteen counts, one a lane, for every number of depths
    std::vector<std::uint64_t> at_least_;   // pixels of so many depths or more
};

// The blocks of an rgba8 frame, from fragments to the last quad.
class Rgba8Course {
  public:
    explicit Rgba8Course(Region& region)
        : region_{region},
          target_{region.make_color()},
          opaque_{RegionShortcuts{region}.words(region.opaque_color())},
          result_{RegionShortcuts{region}.words(target_)} {
        for (std::size_t pixel = 0; pixel < region.rect().area(); ++pixel)  // where there is no fragment
            result_[pixel] = opaque_[pixel] | 0xff000000u;
    }

    void run(const ColumnBlock& block) {
        const BlockCodes opaque_codes = codes_of(opaque_ + block.first);
        BlockCodes front{}, back = opaque_codes;
        peel_both_ends(block, front, back, region_.profile().blend_rounding);
        if (block.has_any_tie()) {
            GroupPeel peel{region_, block, pixels_of(block, true), opaque_codes};
            while (peel.pass()) {
            }
            peel.result(front, back);
        }
        composite_block(front, back, FrontAlpha::covers, result_ + block.first);
        if (!region_.frame().trace) return;
        for (std::size_t lane = 0; lane < static_cast<std::size_t>(block.count); ++lane)
            if (block.has_ties[lane] == 0) trace_pixel(region_, block, lane);
    }
    [[nodiscard]] static bool has_plain_colors() noexcept { return true; }

    void publish() {
        const std::uint64_t area = region_.rect().area();
        RegionShortcuts{region_}.book(of_loads(2 * 4, area) + of_color(4, area, false), {.full_screen = 1});
        region_.publish(target_);
    }

  private:
    Region& region_;
    Target target_;
    const std::uint32_t* opaque_;  // words of the region
    std::uint32_t* result_;
};

// The blocks of an rgba16f or rgba32f frame, blended by the passes' own stage functions.
class FloatCourse {
  public:
    explicit FloatCourse(Region& region) : region_{region}, front_{region.make_color()}, back_{region.make_color()} {
        region.uncounted([&] {
            region.clear(front_, {.color = {0, 0, 0, 0}});
            region.copy(region.opaque_color(), back_);
        });
    }

    void run(const ColumnBlock& block) {
        const TargetStorage& opaque = region_.storage(region_.opaque_color());
        BlockCodes front{}, back{};
        for (std::size_t c = 0; c < 4; ++c)
            for (std::size_t lane = 0; lane < static_cast<std::size_t>(block.count); ++lane)
                back[c][lane] = opaque.code(block.first + lane, static_cast<int>(c), 0);
        GroupPeel peel{region_, block, pixels_of(block, false), back};
        while (peel.pass()) {
        }
        has_plain_colors_ &= peel.has_plain_colors();
        peel.result(front, back);
        store(front, block, front_);
        store(back, block, back_);
    }
    [[nodiscard]] bool has_plain_colors() const noexcept { return has_plain_colors_; }

    void publish() { publish_over(region_, front_, FrontAlpha::covers, back_); }

  private:
    void store(const BlockCodes& codes, const ColumnBlock& block, Target to) {
        for (std::size_t c = 0; c < 4; ++c) std::copy_n(codes[c].begin(), block.count, codes_[c].begin());
        RegionShortcuts{region_}.store_pixels(to, static_cast<std::uint32_t>(block.first), block.count, codes_);
    }

    Region& region_;
    Target front_, back_;
    bool has_plain_colors_ = true;
    ColorCodes codes_;
};

// The counters of the draws and the quad of `dual`. Clears and copies are really done, or counted here where they
// repeat.
Counters of_fates(const RegionFragments& fragments) {
    return {.fragments_rasterized = fragments.rasterized,
            .alpha_killed = fragments.masked,
            .blended = fragments.rasterized - fragments.masked};
}
constexpr std::uint64_t rg32f_bytes = 8, d32f_bytes = 4;
Counters of_initialize(const RegionFragments& fragments) {
    const Counters fates = of_fates(fragments);
    return fates + of_loads(d32f_bytes, fragments.rasterized) + of_color(rg32f_bytes, fates.blended, true);
}
Counters of_peel(const RegionFragments& fragments, std::uint64_t area, std::uint64_t bytes_a_color) {
    const std::uint64_t targets = rg32f_bytes + 2 * bytes_a_color;
    const Counters fates = of_fates(fragments);
    const Counters draw = of_loads(rg32f_bytes + bytes_a_color + d32f_bytes, fragments.rasterized) +
                          of_color(targets, fates.blended, true);
    const Counters quad = of_loads(bytes_a_color + 2 * rg32f_bytes, area) + of_color(bytes_a_color, area, true);
    return fates + of_clear(targets, area) + draw + quad;
}

// Colours first, counters last: as long as the fragments may still turn out to be too many, of foreign depths or of
// colours that MAX orders, nothing is counted, and the trace is cut back to where it was.
template <class Course>
bool peel_region(Region& region) {
    const std::size_t area = region.rect().area();
    const auto bytes_a_color = static_cast<std::uint64_t>(info(region.frame().color_format).bytes_per_pixel);
    RegionShortcuts shortcuts{region};
    Course course{region};
    DepthCounts depths;
    const std::size_t traced = shortcuts.trace().size();
    const auto fragments = for_each_block(region, [&](const ColumnBlock& block) {
        if (block.height == 0) return;
        depths.add(block);
        course.run(block);
    });
    if (!fragments || has_foreign_depths(*fragments, region.profile()) || !course.has_plain_colors()) {
        shortcuts.trace().shorten(traced);
        return false;
    }
    depths.finish();
    shortcuts.book(of_copy(bytes_a_color, area) + of_clear(bytes_a_color + rg32f_bytes, area),
                   {.copies = 1});  // front, back, min-max
    shortcuts.book(of_initialize(*fragments), {.geometry = 1});
    for (std::size_t passes = 1;; ++passes) {  // no limit: peels_to_the_end()
        region.begin_iteration();
        shortcuts.book(of_peel(*fragments, area, bytes_a_color), {.geometry = 1, .full_screen = 1});
        if (!region.any(RegionShortcuts::query_of(depths.left(passes)), Idle::steady)) break;
    }
    course.publish();
    return true;
}

}  // namespace

bool dual_closed(Region& region) {
    const Frame& frame = region.frame();
    if (!peels_to_the_end(frame)) return false;
    if (frame.color_format == Format::rgba8) return peel_region<Rgba8Course>(region);
    const bool is_float = frame.color_format == Format::rgba16f || frame.color_format == Format::rgba32f;
    return is_float && peel_region<FloatCourse>(region);
}

}  // namespace strata::peeling
