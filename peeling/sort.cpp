// peeling/sort.cpp - computes keys, then one stable sort per rule: equal keys keep the order of the list, so the result
// is the same on every computer.
#include "peeling/sort.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "pipeline/vertices/prepare.h"
#include "rasterizer/base/numerics.h"
#include "rasterizer/base/split_mix.h"

namespace strata::peeling {

namespace {

using rasterizer::TriangleSoup;
using Numbers = std::vector<std::uint32_t>;
using Keys = std::vector<double>;  // by triangle index

// The sum instead of the mean: a division by 3 would only round. Corners are added in the order of the list, in
// binary64.
Keys centroid_keys(const TriangleSoup& soup, NearerZ nearer) {
    const double sign = nearer == NearerZ::less ? 1.0 : -1.0;
    Keys keys;
    keys.reserve(soup.indices.size() / 3);
    for (std::size_t i = 0; i + 2 < soup.indices.size(); i += 3) {
        const auto z = [&](std::size_t corner) { return double{soup.vertices[soup.indices[i + corner]].z}; };
        const double sum = (z(0) + z(1)) + z(2);
        keys.push_back(sum == sum ? sign * sum
                                  : 0);  // a triangle with NaN is dropped at set-up, but must not break the sort here
    }
    return keys;
}

void sort_exactly(Numbers& numbers, const Keys& keys) {
    std::stable_sort(numbers.begin(), numbers.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return keys[a] < keys[b]; });
}

void sort_reversed(Numbers& numbers, const Keys& keys) {
    std::stable_sort(numbers.begin(), numbers.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return keys[a] > keys[b]; });
}

// Infinite keys do not extend the range; they go into the first or the last bucket.
void sort_into_buckets(Numbers& numbers, const Keys& keys, int buckets) {
    double least = HUGE_VAL, greatest = -HUGE_VAL;
    for (const std::uint32_t n : numbers) {
        if (!std::isfinite(keys[n])) continue;
        least = std::min(least, keys[n]);
        greatest = std::max(greatest, keys[n]);
    }
    const double last = buckets - 1;
    const auto bucket = [&](std::uint32_t n) {
        const double position = (keys[n] - least) / (greatest - least) * buckets;
        return position > 0 ? std::min(std::floor(position), last) : 0.0;  // NaN where all keys are equal
    };
    std::stable_sort(numbers.begin(), numbers.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return bucket(a) < bucket(b); });
}

// Permutes `fraction` of the entries, rounded, in one cycle.
void disorder(Numbers& numbers, double fraction, std::uint64_t seed) {
    // Rounded half up. A single entry cannot be permuted.
    const std::size_t moved = static_cast<std::size_t>(fraction * static_cast<double>(numbers.size()) + 0.5);
    if (moved < 2) return;
    Numbers positions(numbers.size());
    std::iota(positions.begin(), positions.end(), 0u);
    // A partial Fisher-Yates shuffle: the first `moved` positions are chosen at random without repetition. The bias of
    // the remainder is below 2^-32.
    SplitMix64 random{seed};
    for (std::size_t i = 0; i < moved; ++i)
        std::swap(positions[i], positions[i + random.next() % (positions.size() - i)]);
    // One cycle moves every chosen entry; pairwise swaps would leave one of an odd number unmoved.
    const std::uint32_t first = numbers[positions[0]];
    for (std::size_t i = 0; i + 1 < moved; ++i) numbers[positions[i]] = numbers[positions[i + 1]];
    numbers[positions[moved - 1]] = first;
}

void sort_numbers(Numbers& numbers, const Keys& keys, const Sort& sort) {
    switch (sort.rule) {
        case SortRule::none: return;
        case SortRule::exact: return sort_exactly(numbers, keys);
        case SortRule::bucket: return sort_into_buckets(numbers, keys, sort.buckets);
        case SortRule::reverse: return sort_reversed(numbers, keys);
        case SortRule::shuffle: sort_exactly(numbers, keys); return disorder(numbers, sort.fraction, sort.seed);
    }
}

}  // namespace

std::vector<std::uint32_t> submission_order(const TriangleSoup& soup, const Sort& sort, NearerZ nearer) {
    Numbers numbers(soup.indices.size() / 3);
    std::iota(numbers.begin(), numbers.end(), 0u);
    sort_numbers(numbers, centroid_keys(soup, nearer), sort);
    return numbers;
}

pipeline::SubmissionOrder submission_order(const TriangleSoup& soup, const Sort& sort, const PartSort& parts,
                                           NearerZ nearer) {
    const Keys keys = centroid_keys(soup, nearer);
    std::vector<Numbers> members(parts.sorts.size());
    // A run consists of whole triangles of one object: first_index and index_count are multiples of 3.
    for (std::size_t run = 0; run < soup.runs.size(); ++run) {
        const std::uint32_t first = soup.runs[run].first_index / 3, triangles = soup.runs[run].index_count / 3;
        for (std::uint32_t n = first; n < first + triangles; ++n) members[parts.part_of_run[run]].push_back(n);
    }
    pipeline::SubmissionOrder order;
    // Empty parts are kept, because callers refer to parts by index.
    for (std::size_t part = 0; part < members.size(); ++part) {
        if (parts.sorts[part]) sort_numbers(members[part], keys, sort);
        const auto begin = static_cast<std::uint32_t>(order.triangles.size());
        order.triangles.insert(order.triangles.end(), members[part].begin(), members[part].end());
        order.parts.push_back({begin, static_cast<std::uint32_t>(order.triangles.size())});
    }
    return order;
}

}  // namespace strata::peeling
