#include "pipeline/fragments/find_visits.h"

#include <algorithm>
#include <vector>

namespace strata::pipeline {

namespace {

using Column = SortedColumns::Column;

// Calls visit(pixel, column) with every column that is not empty.
template <class Visit>
void for_each_column(const SortedColumns& sorted, const Visit& visit) {
    for (std::size_t block = 0; block < sorted.blocks(); ++block) {
        if (sorted.height(block) == 0) continue;
        const std::size_t end = std::min((block + 1) * block_lanes, sorted.pixels());
        for (std::size_t pixel = block * block_lanes; pixel < end; ++pixel)
            if (sorted.count(pixel) > 0) visit(pixel, sorted.column(pixel));
    }
}

// Keys [low, high).
struct Keys {
    std::uint64_t low, high;
};

Keys keys_at(const Windows& windows, std::size_t pixel) {
    Keys keys{windows.least, windows.end};
    if (windows.near.exists()) keys.low = std::max(keys.low, windows.near.first_behind(pixel));
    for (const BoundPlane& far : windows.far)
        if (far.exists()) keys.high = std::min(keys.high, far.end_before(pixel));
    if (windows.range_near == nullptr) return keys;
    const float near = -std::bit_cast<float>(windows.range_near[pixel]);
    const float far = std::bit_cast<float>(windows.range_far[pixel]);
    if (!(near <= far)) return {0, 0};
    return {std::max<std::uint64_t>(keys.low, rasterizer::ordered_code(near)),
            std::min(keys.high, std::uint64_t{rasterizer::ordered_code(far)} + 1)};
}

// The number of a column's first key from `low` on.
std::uint32_t first_from(SortedColumns& sorted, std::size_t pixel, const Column& column, std::uint64_t low) {
    std::uint32_t& first = sorted.found(pixel).first;
    return first = column.below(low, first);
}

// A batch has no order of a pixel's fragments but that of waves: the order of arrival.
class InOrder {
  public:
    void put(std::uint64_t word) { words_.push_back(word); }
    void add_to(Visits& visits, std::size_t pixel) {
        std::ranges::sort(words_, {}, place_of);
        for (std::size_t wave = 0; wave < words_.size(); ++wave) visits.add(wave, pixel, words_[wave]);
        words_.clear();
    }

  private:
    std::vector<std::uint64_t> words_;
};

}  // namespace

void find_nearest(SortedColumns& sorted, const Windows& windows, const StoredCodes& stored, Visits& visits) {
    for_each_column(sorted, [&](std::size_t pixel, const Column& column) {
        const Keys keys = keys_at(windows, pixel);
        const std::uint32_t first = first_from(sorted, pixel, column, keys.low);
        if (first < column.size() && key_of(column[first]) < std::min<std::uint64_t>(keys.high, stored.of(pixel)))
            visits.add(0, pixel, column[first]);
    });
}

// A fragment that lies behind has a compared code of at least the raised bound, and so a code of its own that is less by the record's
// greatest lead at most. A depth that is not quantised may part from its code, which other arithmetic made: each fragment is asked.
void find_nearest_behind(SortedColumns& sorted, const TileFragments& fragments, const DepthCompare& compare,
                         const Windows& windows, const std::uint32_t* behind, const StoredCodes& stored,
                         Visits& visits) {
    const auto code = fragments.reference_code();
    const auto z = fragments.reference_z();
    for_each_column(sorted, [&](std::size_t pixel, const Column& column) {
        const std::uint32_t raised = compare.raised(behind[pixel]);
        const auto [low, high] = keys_at(windows, pixel);
        const std::uint32_t lead = compare.quantizes ? fragments.reference_lead() : raised;
        const std::uint64_t from = std::max<std::uint64_t>(low, raised - std::min(raised, lead));
        const std::uint64_t end = std::min<std::uint64_t>(high, stored.of(pixel));
        for (std::uint32_t k = first_from(sorted, pixel, column, from); k < column.size(); ++k) {
            if (key_of(column[k]) >= end) return;
            const std::uint32_t place = place_of(column[k]);
            if (compare.is_behind(code[place], z[place], behind[pixel])) return visits.add(0, pixel, column[k]);
        }
    });
}

// Where a window ends is sought from its beginning: what lies between is visited.
bool find_windows(SortedColumns& sorted, const Windows& windows, Visits& visits) {
    std::uint64_t inside = 0;
    for_each_column(sorted, [&](std::size_t pixel, const Column& column) {
        const Keys keys = keys_at(windows, pixel);
        const std::uint32_t first = first_from(sorted, pixel, column, keys.low);
        std::uint32_t& last = sorted.found(pixel).last;
        last = keys.high > 0xffffffff ? column.size() : std::max(first, column.below(keys.high, first));
        inside += last - first;
    });
    if (2 * inside > sorted.size()) return false;
    InOrder kept;
    for_each_column(sorted, [&](std::size_t pixel, const Column& column) {
        const auto [first, last] = sorted.found(pixel);
        if (last == first + 1) return visits.add(0, pixel, column[first]);
        for (std::uint32_t k = first; k < last; ++k) kept.put(column[k]);
        kept.add_to(visits, pixel);
    });
    return true;
}

// Numbers [first, last) of a column: either end is sought from where the pass before had it.
SortedColumns::Found range_of(SortedColumns& sorted, const Windows& windows, std::size_t pixel, const Column& column) {
    const Keys keys = keys_at(windows, pixel);
    const std::uint32_t first = first_from(sorted, pixel, column, keys.low);
    std::uint32_t& last = sorted.found(pixel).last;
    last = std::max(first, column.below(keys.high, std::min(last, column.size())));
    return {first, last};
}

// The waves of the ends are those of their places: nearest, the two next to the ends, farthest; then what is tied with an end, whose own
// order is that of arrival. Either end has a target of its own, and what lies between writes what MAX takes in any order.
void find_ends(SortedColumns& sorted, const Windows& windows, bool one_outside, Visits& visits) {
    for_each_column(sorted, [&](std::size_t pixel, const Column& column) {
        const auto [first, last] = range_of(sorted, windows, pixel, column);
        const auto same = [&](std::uint32_t a, std::uint32_t b) { return key_of(column[a]) == key_of(column[b]); };
        std::size_t tied = 4;
        std::uint32_t near_end = first, far_begin = last;
        if (first < last) visits.add(0, pixel, column[near_end++]);
        while (near_end < last && same(near_end, first)) visits.add(tied++, pixel, column[near_end++]);
        while (far_begin > near_end && same(far_begin - 1, last - 1)) --far_begin;
        if (near_end < far_begin) visits.add(1, pixel, column[near_end]);
        if (near_end + 1 < far_begin) visits.add(2, pixel, column[far_begin - 1]);
        if (far_begin < last) visits.add(3, pixel, column[far_begin]);
        for (std::uint32_t k = far_begin + 1; k < last; ++k) visits.add(tied++, pixel, column[k]);
        if (one_outside && near_end == last && last - first < column.size())
            visits.add(1, pixel, column[first > 0 ? 0 : last]);
    });
}

// Compared depths have an order of their own: each fragment of a column is asked.
void find_ends_compared(SortedColumns& sorted, const TileFragments& fragments, const DepthCompare& compare,
                        const Windows& windows, bool one_outside, Visits& visits) {
    const auto depths = fragments.reference_z();
    Windows by_key = windows;  // which a compared depth is not: what lies in the range is asked below
    by_key.range_near = nullptr;
    InOrder kept;
    for_each_column(sorted, [&](std::size_t pixel, const Column& column) {
        const double near = -std::bit_cast<float>(windows.range_near[pixel]);
        const double far = std::bit_cast<float>(windows.range_far[pixel]);
        const auto reaches = [&](double least, double greatest) { return !compare.exceeds(least, greatest); };
        auto [first, last] = range_of(sorted, by_key, pixel, column);
        if (!(near <= far)) last = first;
        constexpr std::uint32_t none = ~0u;
        std::uint32_t nearest = none, farthest = none, outside = first > 0 ? 0 : last < column.size() ? last : none;
        bool is_near_alone = true;
        for (std::uint32_t k = first; k < last; ++k) {
            const double z = compare.own(depths[place_of(column[k])]);
            const bool is_inside = reaches(near, z) && reaches(z, far);
            if (!is_inside) {
                outside = k;
            } else if (reaches(z, near) || reaches(far, z)) {
                is_near_alone &= reaches(z, near);
                kept.put(column[k]);
            } else {
                farthest = k;
                nearest = std::min(nearest, k);
            }
        }
        if (nearest != none) kept.put(column[nearest]);
        if (nearest != farthest) kept.put(column[farthest]);
        if (one_outside && nearest == none && is_near_alone && outside != none) kept.put(column[outside]);
        kept.add_to(visits, pixel);
    });
}

}  // namespace strata::pipeline
