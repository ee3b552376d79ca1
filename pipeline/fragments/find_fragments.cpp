// pipeline/fragments/find_fragments.cpp - the searches of find_fragments.h in sorted per-pixel lists.
#include "pipeline/fragments/find_fragments.h"

#include <algorithm>
#include <limits>
#include <vector>

namespace strata::pipeline {

namespace {

using List = SortedLists::List;

// Calls visit(pixel, list) for every nonempty list.
template <class Visit>
void for_each_list(const SortedLists& sorted, const Visit& visit) {
    for (std::size_t block = 0; block < sorted.blocks(); ++block) {
        if (sorted.height(block) == 0) continue;
        const std::size_t end = std::min((block + 1) * block_lanes, sorted.pixels());
        for (std::size_t pixel = block * block_lanes; pixel < end; ++pixel)
            if (sorted.count(pixel) > 0) visit(pixel, sorted.list(pixel));
    }
}

// Keys [low, high).
struct KeyRange {
    std::uint64_t low, high;
};

[[gnu::always_inline]] inline KeyRange keys_at(const KeyIntervals& intervals, std::size_t pixel) {
    KeyRange keys{intervals.least, intervals.end};
    if (intervals.near.exists()) keys.low = std::max(keys.low, intervals.near.first_behind(pixel));
    for (const BoundPlane& far : intervals.far)
        if (far.exists()) keys.high = std::min(keys.high, far.end_before(pixel));
    if (intervals.range_near == nullptr) return keys;
    const float near = -std::bit_cast<float>(intervals.range_near[pixel]);
    const float far = intervals.range_far != nullptr ? std::bit_cast<float>(intervals.range_far[pixel])
                                                     : std::numeric_limits<float>::infinity();
    if (!(near <= far)) return {0, 0};
    return {std::max<std::uint64_t>(keys.low, rasterizer::ordered_code(near)),
            std::min(keys.high, std::uint64_t{rasterizer::ordered_code(far)} + 1)};
}

// The position of a list's first key that is not less than `low`.
std::uint32_t first_from(SortedLists& sorted, std::size_t pixel, const List& list, std::uint64_t low) {
    std::uint32_t& first = sorted.previous_range(pixel).first;
    return first = list.below(low, first);
}

// Adds the entries of a pixel in submission order: batches keep the order of a pixel's fragments only through waves.
class InOrder {
  public:
    void put(std::uint64_t entry) { entries_.push_back(entry); }
    void add_to(FragmentWaves& waves, std::size_t pixel) {
        std::ranges::sort(entries_, {}, index_of);
        for (std::size_t wave = 0; wave < entries_.size(); ++wave) waves.add(wave, pixel, entries_[wave]);
        entries_.clear();
    }

  private:
    std::vector<std::uint64_t> entries_;
};

}  // namespace

void find_nearest(SortedLists& sorted, const KeyIntervals& intervals, const StoredCodes& stored, FragmentWaves& waves) {
    for_each_list(sorted, [&](std::size_t pixel, const List& list) {
        const KeyRange keys = keys_at(intervals, pixel);
        const std::uint32_t first = first_from(sorted, pixel, list, keys.low);
        if (first < list.size() && key_of(list[first]) < std::min<std::uint64_t>(keys.high, stored.of(pixel)))
            waves.add(0, pixel, list[first]);
    });
}

// A fragment that is behind has a compared code of at least the raised bound. Its stored code is therefore less than
// that bound by at most the record's greatest lead. An unquantized depth may differ from its code, which other
// arithmetic computed: then every fragment is tested.
void find_nearest_behind(SortedLists& sorted, const TileFragments& fragments, const DepthCompare& compare,
                         const KeyIntervals& intervals, const std::uint32_t* behind, const StoredCodes& stored,
                         FragmentWaves& waves) {
    const auto code = fragments.reference_code();
    const auto z = fragments.reference_z();
    for_each_list(sorted, [&](std::size_t pixel, const List& list) {
        const std::uint32_t raised = compare.raised(behind[pixel]);
        const auto [low, high] = keys_at(intervals, pixel);
        const std::uint32_t lead = compare.quantizes ? fragments.reference_lead() : raised;
        const std::uint64_t from = std::max<std::uint64_t>(low, raised - std::min(raised, lead));
        const std::uint64_t end = std::min<std::uint64_t>(high, stored.of(pixel));
        for (std::uint32_t k = first_from(sorted, pixel, list, from); k < list.size(); ++k) {
            if (key_of(list[k]) >= end) return;
            const std::uint32_t index = index_of(list[k]);
            if (compare.is_behind(code[index], z[index], behind[pixel])) return waves.add(0, pixel, list[k]);
        }
    });
}

// The end of an interval is searched from its beginning, because the entries between are visited anyway.
bool find_intervals(SortedLists& sorted, const KeyIntervals& intervals, FragmentWaves& waves) {
    std::uint64_t inside = 0;
    for_each_list(sorted, [&](std::size_t pixel, const List& list) {
        const KeyRange keys = keys_at(intervals, pixel);
        const std::uint32_t first = first_from(sorted, pixel, list, keys.low);
        std::uint32_t& last = sorted.previous_range(pixel).last;
        last = keys.high > 0xffffffff ? list.size() : std::max(first, list.below(keys.high, first));
        inside += last - first;
    });
    if (2 * inside > sorted.size()) return false;
    InOrder kept;
    for_each_list(sorted, [&](std::size_t pixel, const List& list) {
        const auto [first, last] = sorted.previous_range(pixel);
        if (last == first + 1) return waves.add(0, pixel, list[first]);
        for (std::uint32_t k = first; k < last; ++k) kept.put(list[k]);
        kept.add_to(waves, pixel);
    });
    return true;
}

// Entries [first, last) of a list: each end is searched from its position in the previous pass.
SortedLists::ListRange range_of(SortedLists& sorted, const KeyIntervals& intervals, std::size_t pixel,
                                const List& list) {
    const KeyRange keys = keys_at(intervals, pixel);
    const std::uint32_t first = first_from(sorted, pixel, list, keys.low);
    std::uint32_t& last = sorted.previous_range(pixel).last;
    last = std::max(first, list.below(keys.high, std::min(last, list.size())));
    return {first, last};
}

// The waves of the ends are: nearest, the entries next to each end, farthest; then those tied with an end, in
// submission order. Each end writes its own target, and the entries between write targets with MAX, which does not
// depend on the order.
void find_ends(SortedLists& sorted, const KeyIntervals& intervals, bool one_outside, FragmentWaves& waves) {
    for_each_list(sorted, [&](std::size_t pixel, const List& list) {
        const auto [first, last] = range_of(sorted, intervals, pixel, list);
        const auto same = [&](std::uint32_t a, std::uint32_t b) { return key_of(list[a]) == key_of(list[b]); };
        std::size_t tied = 4;
        std::uint32_t near_end = first, far_begin = last;
        if (first < last) waves.add(0, pixel, list[near_end++]);
        while (near_end < last && same(near_end, first)) waves.add(tied++, pixel, list[near_end++]);
        while (far_begin > near_end && same(far_begin - 1, last - 1)) --far_begin;
        if (near_end < far_begin) waves.add(1, pixel, list[near_end]);
        if (near_end + 1 < far_begin) waves.add(2, pixel, list[far_begin - 1]);
        if (far_begin < last) waves.add(3, pixel, list[far_begin]);
        for (std::uint32_t k = far_begin + 1; k < last; ++k) waves.add(tied++, pixel, list[k]);
        if (one_outside && near_end == last && last - first < list.size())
            waves.add(1, pixel, list[first > 0 ? 0 : last]);
    });
}

// A wave is an entry of a group, in submission order; the entry behind the group is in the next one.
void find_groups(SortedLists& sorted, const KeyIntervals& intervals, FragmentWaves& waves) {
    for_each_list(sorted, [&](std::size_t pixel, const List& list) {
        const KeyRange keys = keys_at(intervals, pixel);
        const std::uint32_t first = first_from(sorted, pixel, list, keys.low);
        bool is_group = true;
        for (std::uint32_t k = first; is_group && k < list.size() && key_of(list[k]) < keys.high; ++k) {
            is_group = key_of(list[k]) == key_of(list[first]);
            waves.add(k - first, pixel, list[k]);
        }
    });
}

// Compared depths are ordered differently from keys, so every fragment of a list is tested.
void find_ends_compared(SortedLists& sorted, const TileFragments& fragments, const DepthCompare& compare,
                        const KeyIntervals& intervals, bool one_outside, FragmentWaves& waves) {
    const auto depths = fragments.reference_z();
    KeyIntervals by_key = intervals;  // compared depths are not keys: the range is tested below
    by_key.range_near = nullptr;
    InOrder kept;
    for_each_list(sorted, [&](std::size_t pixel, const List& list) {
        const double near = -std::bit_cast<float>(intervals.range_near[pixel]);
        const double far = std::bit_cast<float>(intervals.range_far[pixel]);
        const auto reaches = [&](double least, double greatest) { return !compare.exceeds(least, greatest); };
        auto [first, last] = range_of(sorted, by_key, pixel, list);
        if (!(near <= far)) last = first;
        constexpr std::uint32_t none = ~0u;
        std::uint32_t nearest = none, farthest = none, outside = first > 0 ? 0 : last < list.size() ? last : none;
        bool is_near_alone = true;
        for (std::uint32_t k = first; k < last; ++k) {
            const double z = compare.own(depths[index_of(list[k])]);
            const bool is_inside = reaches(near, z) && reaches(z, far);
            if (!is_inside) {
                outside = k;
            } else if (reaches(z, near) || reaches(far, z)) {
                is_near_alone &= reaches(z, near);
                kept.put(list[k]);
            } else {
                farthest = k;
                nearest = std::min(nearest, k);
            }
        }
        if (nearest != none) kept.put(list[nearest]);
        if (nearest != farthest) kept.put(list[farthest]);
        if (one_outside && nearest == none && is_near_alone && outside != none) kept.put(list[outside]);
        kept.add_to(waves, pixel);
    });
}

}  // namespace strata::pipeline
