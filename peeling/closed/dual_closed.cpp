// peeling/closed/dual_closed.cpp - dual peeling as a closed form: pass i takes the i-th depth from the front and the
// i-th from the back. It runs by default in place of the passes of peeling/algorithms/dual.cpp, which are its
// definition: it leaves their bits, counters, queries and trace. tests/peeling/execution_test.cpp and
// sequences_test.cpp compare the two.
//
// Declines   where closed_form.h says, and on what Holds excludes: then the passes run.
// Holds      for targets where MAX does not ask for an order: of 8 bits, or for plain colours (block_passes.h); for
//            visible depths that MAX keeps as they are: not below the cleared -1, and not flushed as denormals.
// Ties       a depth is one group (block_passes.h).
#include <algorithm>
#include <numeric>

#include "peeling/closed/block_course.h"
#include "peeling/programs/min_max.h"

namespace strata::peeling {

using namespace pipeline;

namespace {

// True if the region has a visible depth that MAX blending of (-z, z) onto (-1, -1) does not keep.
bool has_foreign_depths(const RegionFragments& fragments, const DeviceProfile& profile) {
    const bool flushes = profile.denormals == DenormalRule::flush;
    return fragments.nearest < ordered_code(-1.0f) || (flushes && fragments.has_denormals);
}

// Depths of a sorted column.
std::uint32_t distinct(const ColumnBlock& block, std::size_t lane) {
    std::uint32_t depths = 0;
    const std::uint32_t end = block.visible[lane];
    for (std::uint32_t k = 0; k < end; k = block.end_of_depth(lane, k, end)) ++depths;
    return depths;
}

// Pass by pass, the front before the back. A depth's fragments are one mixture, so its entry names the depth and no
// fragment; near == far is one group, and the near one (algorithms.md 5.1).
void trace_pixel(Region& region, const ColumnBlock& block, std::size_t lane, std::uint32_t most_passes) {
    std::uint32_t near = 0, far = block.visible[lane];
    const auto add = [&](std::uint32_t k, Side side) {
        region.trace({static_cast<std::uint32_t>(block.first + lane), block.key(lane, k), 0, side, false});
    };
    for (std::uint32_t pass = 0; near < far && pass < most_passes; ++pass) {
        add(near, Side::front);
        near = block.end_of_depth(lane, near, far);
        if (near == far) break;
        add(far - 1, Side::back);
        far = block.begin_of_depth(lane, near, far - 1);
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
    const BlockRules rules = block_rules(region.frame(), 1);  // the first pass peels nothing
    Course course{region, FrontAlpha::covers, rules};
    DepthCounts depths;
    const std::size_t traced = shortcuts.trace().size();
    bool is_plain = true;
    const auto fragments = for_each_block(region, [&](const ColumnBlock& block) {
        if (block.height == 0) return;
        depths.add(block);
        is_plain &= course.run(block, peel_both_ends);
        if (!region.frame().trace) return;
        for (std::size_t lane = 0; lane < static_cast<std::size_t>(block.count); ++lane)
            trace_pixel(region, block, lane, rules.most_passes);
    });
    if (!fragments || has_foreign_depths(*fragments, region.profile()) || !is_plain) {
        shortcuts.trace().shorten(traced);
        return false;
    }
    depths.finish();
    shortcuts.book(of_copy(bytes_a_color, area) + of_clear(bytes_a_color + rg32f_bytes, area),
                   {.copies = 1});  // front, back, min-max
    shortcuts.book(of_initialize(*fragments), {.geometry = 1});
    for (std::size_t passes = 1; !region.limit_reached(); ++passes) {
        region.begin_iteration();
        shortcuts.book(of_peel(*fragments, area, bytes_a_color), {.geometry = 1, .full_screen = 1});
        if (!region.any(RegionShortcuts::query_of(depths.left(passes)), Idle::steady)) break;
    }
    course.publish();
    return true;
}

}  // namespace

bool dual_closed(Region& region) {
    if (!peels_by_columns(region.frame())) return false;
    return has_float_blocks(region.frame()) ? peel_region<FloatCourse>(region) : peel_region<Rgba8Course>(region);
}

}  // namespace strata::peeling
