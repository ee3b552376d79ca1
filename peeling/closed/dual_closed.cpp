// peeling/closed/dual_closed.cpp - dual peeling as a closed form: pass i takes the i-th depth from the front and the
// i-th from the back. It runs by default in place of the passes of peeling/algorithms/dual.cpp, which are its
// definition: it leaves their bits, passes, queries and trace. tests/peeling/execution_test.cpp and
// sequences_test.cpp compare the two.
//
// Declines   where closed_form.h says, and on what Holds excludes: then the passes run.
// Holds      for targets where MAX does not ask for an order: of 8 bits, or for plain colours (block_passes.h); for
//            visible depths that MAX keeps as they are: not below the cleared -1, and not flushed as denormals.
// Ties       a depth is one group (block_passes.h).
#include <algorithm>

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

std::uint32_t most_distinct(const ColumnBlock& block) {
    std::uint32_t most = 0;
    for (std::size_t lane = 0; lane < block_lanes; ++lane)
        most = std::max(most, block.has_ties[lane] != 0 ? distinct(block, lane) : block.visible[lane]);
    return most;
}

// Colours first, passes last: as long as the fragments may still turn out to be too many, of foreign depths or of colours
// that MAX orders, nothing is booked, and the trace is cut back to where it was.
template <class Course>
bool peel_region(Region& region) {
    RegionShortcuts shortcuts{region};
    const BlockRules rules = block_rules(region.frame(), 1);  // the first pass peels nothing
    Course course{region, FrontAlpha::covers, rules};
    std::uint32_t deepest = 0;
    const std::size_t traced = shortcuts.trace().size();
    bool is_plain = true;
    const auto fragments = for_each_block(region, [&](const ColumnBlock& block) {
        if (block.height == 0) return;
        deepest = std::max(deepest, most_distinct(block));
        is_plain &= course.run(block, peel_both_ends);
        if (!region.frame().trace) return;
        for (std::size_t lane = 0; lane < static_cast<std::size_t>(block.count); ++lane)
            trace_pixel(region, block, lane, rules.most_passes);
    });
    if (!fragments || has_foreign_depths(*fragments, region.profile()) || !is_plain) {
        shortcuts.trace().shorten(traced);
        return false;
    }
    shortcuts.book({.geometry = 1, .copies = 1});
    for (std::uint64_t passes = 1; !region.limit_reached(); ++passes) {
        region.begin_iteration();
        shortcuts.book({.geometry = 1, .full_screen = 1});
        if (!region.any(RegionShortcuts::query_of(deepest > 2 * passes ? 1 : 0), Idle::yes)) break;
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
