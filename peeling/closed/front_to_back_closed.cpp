// peeling/closed/front_to_back_closed.cpp - front-to-back peeling as a closed form: pass i composites the i-th depth of
// every pixel. It runs by default in place of the passes of peeling/algorithms/front_to_back.cpp, which are its
// definition: it leaves their bits, passes, queries and trace. tests/peeling/execution_test.cpp and
// sequences_test.cpp compare the two.
//
// Declines   where closed_form.h says: then the passes run.
// Ties       the first arrival of a depth is its layer; the others are never seen.
#include <algorithm>

#include "peeling/closed/arrivals.h"
#include "peeling/closed/block_course.h"

namespace strata::peeling {

using namespace pipeline;

namespace {

std::uint32_t layers_of(const ColumnBlock& block, std::size_t lane) {
    const std::uint32_t end = block.visible[lane];
    std::uint32_t layers = 0;
    for (std::uint32_t k = 0; k < end; k = block.end_of_depth(lane, k, end)) ++layers;
    return layers;
}

void trace_layers(Region& region, const ColumnBlock& block, std::uint32_t most) {
    if (!region.frame().trace) return;
    for (std::size_t lane = 0; lane < static_cast<std::size_t>(block.count); ++lane) {
        const std::uint32_t end = block.visible[lane];
        std::uint32_t layers = 0;
        for (std::uint32_t k = 0; k < end && layers < most; k = block.end_of_depth(lane, k, end), ++layers)
            region.trace({static_cast<std::uint32_t>(block.first + lane), block.key(lane, k), 0, Side::front, false});
    }
}

// Goes through the passes as the algorithm does, with the same questions in the same order; only the books are written.
void count_passes(Region& region, std::uint32_t layers) {
    for (std::uint32_t pass = 1; !region.limit_reached(); ++pass) {
        region.begin_iteration();
        RegionShortcuts{region}.book({.geometry = 1, .full_screen = 1, .copies = 1});
        if (!region.any(RegionShortcuts::query_of(pass <= layers ? 1 : 0), Idle::yes)) break;
    }
}

template <class Course>
bool composite_layers(Region& region) {
    std::uint32_t layers = 0;  // of the deepest pixel
    const BlockRules rules = block_rules(region.frame(), 0);
    Course course{region, FrontAlpha::lets_through, rules};
    const auto fragments = for_each_block(region, [&](const ColumnBlock& block) {
        for (std::size_t lane = 0; lane < block_lanes; ++lane) layers = std::max(layers, layers_of(block, lane));
        course.run(block, peel_front);
        trace_layers(region, block, rules.most_passes);
    });
    if (!fragments) return false;
    count_passes(region, layers);
    course.publish();
    return true;
}

}  // namespace

bool front_to_back_closed(Region& region) {
    if (!peels_by_columns(region.frame())) return false;
    return has_float_blocks(region.frame()) ? composite_layers<FloatCourse>(region)
                                            : composite_layers<Rgba8Course>(region);
}

}  // namespace strata::peeling
