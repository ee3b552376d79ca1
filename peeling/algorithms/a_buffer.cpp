// peeling/algorithms/a_buffer.cpp - the oracle: every visible fragment of a pixel, sorted by exact depth, composited in
// binary64. peeling/reference/algorithms.md 17 (Carpenter 1984, the A-buffer).
//
// Needs      nothing: no device ran this algorithm.
// Passes     1. Of equal depths the first submitted is in front; none is lost.
// Invariant  a pixel's fragments are in submission order until they are sorted by the code of DepthPath::exact; equal
//            codes stay in submission order.
#include "peeling/algorithms/entry.h"
#include "peeling/programs/composite.h"
#include "peeling/programs/fragment_lists.h"
#include "peeling/programs/tie_order.h"
#include "pipeline/region/region_shortcuts.h"

namespace strata::peeling::listing::a_buffer {

using namespace pipeline;

namespace {

// Pixels without a fragment keep the copy of the opaque colour. The trace records every fragment with its key, not with
// its exact code.
void resolve(Region& region, const FragmentLists& fragment_lists, Target result) {
    FragmentOrder order;
    for (std::uint32_t pixel = fragment_lists.pixels.first; pixel < fragment_lists.pixels.last; ++pixel) {
        const auto fragments = fragment_lists.of(pixel);
        if (fragments.empty()) continue;
        sort_by(&KeyedFragment::exact_code, fragments, order);
        const auto color = composite(fragments, order, region.targets().color(region.opaque_color(), pixel));
        RegionShortcuts{region}.store_pixel(result, pixel,
                                            {static_cast<float>(color[0]), static_cast<float>(color[1]),
                                             static_cast<float>(color[2]), static_cast<float>(color[3])});
        if (!region.frame().trace) continue;
        for (const std::uint64_t entry : order) {
            const KeyedFragment& f = fragments[submission_index(entry)];
            region.trace({pixel, f.key, f.primitive, Side::front, true});
        }
    }
}

}  // namespace

void run(Region& region) {
    const Target result = region.make(region.frame().picture_format());
    region.set_name(result, "result");
    region.begin_iteration();
    copy_color(region, region.opaque_color(), result);
    const std::vector<std::uint32_t> coverage = coverage_of(region);
    const auto pixels = static_cast<std::uint32_t>(coverage.size());
    const auto range_from = [&](std::uint32_t first) {
        return next_range(coverage, region.rect().width(), first, region.frame().list_bytes / sizeof(KeyedFragment));
    };
    const bool is_one_range = range_from(0).size() == pixels;
    if (!is_one_range) count_list_pass(region);
    FragmentLists fragment_lists;
    for (std::uint32_t first = 0; first < pixels; first = fragment_lists.pixels.last) {
        list_visible(region, range_from(first), coverage, is_one_range ? Counting::counted : Counting::silent,
                     fragment_lists);
        resolve(region, fragment_lists, result);
    }
    region.publish(result);
}

std::vector<Algorithm> entries() {
    return {Algorithm{
        .name = "a_buffer",
        .listed = 170,
        .paper = "Carpenter 1984",
        .section = "the oracle",
        .summary =
            "every fragment sorted by exact depth and composited in binary64; what the others are measured against",
        .pass_formula = "1",
        .ties = TiePolicy::first,
        .key = DepthKey::stored_code,
        .exact = true,
        .is_oracle = true,
        .geometry_passes = one_pass,
        .run = run}};
}

}  // namespace strata::peeling::listing::a_buffer
