// peeling/algorithms/a_buffer.cpp - the oracle: every visible fragment of a pixel, sorted by exact depth, composited in binary64.
// algorithms.md 17 (Carpenter 1984, the A-buffer).
//
// Needs      nothing: no device ran it.
// Passes     1. Equal depths: the first arrival in front, none lost.
// Invariant  a pixel's list is in submission order until it is sorted, stably, by the code of DepthPath::exact.
#include "peeling/algorithms/runs.h"
#include "peeling/programs/composite.h"
#include "peeling/programs/fragment_lists.h"

namespace strata::peeling {

using namespace pipeline;

void a_buffer(Region& region) {
    const Target result = region.make_color();
    region.begin_iteration();
    region.copy(region.opaque_color(), result);
    const FragmentLists lists = visible_fragments(region, Bookkeeping::counted);
    for (std::uint32_t pixel = 0; pixel + 1 < lists.start.size(); ++pixel) {
        if (lists.of(pixel).empty()) continue;
        const std::vector<KeyedFragment> sorted = by_exact_depth(lists.of(pixel));
        const auto color = composite(sorted, region.color(region.opaque_color(), pixel));
        region.store_pixel(
            result, pixel,
            {static_cast<float>(color[0]), static_cast<float>(color[1]), static_cast<float>(color[2]), 1.0f});
        if (!region.frame().trace) continue;
        for (const KeyedFragment& f : sorted) region.trace().push_back({pixel, f.key, f.primitive, Side::front, true});
    }
    region.publish(result);
}

}  // namespace strata::peeling
