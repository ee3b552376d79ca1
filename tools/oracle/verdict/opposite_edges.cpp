// tools/oracle/verdict/opposite_edges.cpp - reflects the values of pixels that are excused at edges, and counts those
// that would be excused, too (opposite_edges.h).
#include "tools/oracle/verdict/opposite_edges.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>

#include "tools/oracle/search/match.h"

namespace strata::oracle::verdict {

namespace {

double levels_of(Storage storage) noexcept {
    return storage == Storage::unorm10 ? 1023 : storage == Storage::unorm16 ? 65535 : 255;
}

// The value as far from the middle of the interval on the other side; a code that is not nearer.
double reflected(double value, const Interval& reach, Storage storage) noexcept {
    const double middle = (reach.low + reach.high) / 2, opposite = 2 * middle - value;
    if (!has_codes(storage)) return opposite;
    const double levels = levels_of(storage), code = opposite * levels;
    return std::clamp((value < middle ? std::ceil(code) : std::floor(code)) / levels, 0.0, 1.0);
}

}  // namespace

ExcusedEdges excused_edges(const SceneFragments& scene, const Colors& candidate, const CheckedAccount& right) {
    const Compositor compositor{right.account.hypothesis};
    const Storage storage = right.account.hypothesis.result.storage;
    ExcusedEdges found;
    std::mutex mutex;
    scene.for_each_tile([&](const TileLists& tile) {
        StackMaker maker{scene.setting()};
        ExcusedEdges own;
        for (std::size_t p = 0; p < tile.rect.area(); ++p) {
            const PixelList list = scene.at(tile, p);
            if (list.edge == nullptr && !list.has_spreads) continue;
            std::array<double, 4> value = candidate.at(list.x, list.y);
            const auto is_excused = [&] {
                const MatchingTies way = matching_ties(compositor, {}, list, value, maker);
                return way.mask != 0 && way.at_edge && !way.has_close_depths;
            };
            if (!is_excused()) continue;
            const ReachableColor reach = compositor.reach(maker.right(list, {}));
            for (std::size_t c = 0; c < 3; ++c) value[c] = reflected(value[c], reach[c], storage);
            ++own.all;
            own.either_way += is_excused() ? 1 : 0;
        }
        const std::scoped_lock lock{mutex};
        found.all += own.all;
        found.either_way += own.either_way;
    });
    return found;
}

}  // namespace strata::oracle::verdict
