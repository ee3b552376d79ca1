// peeling/audit/safe_range.cpp - computes the range over all pixels as the largest lower and the smallest upper bound
// (safe_range.h).
#include "peeling/audit/safe_range.h"

#include <algorithm>
#include <bit>
#include <vector>

#include "pipeline/stages/depth_compare.h"

namespace strata::peeling {

namespace {

// Per layer, the fragment that is found in the most passes: that with the largest reference, the first one if several
// are equal.
std::vector<PathPair> layers_of(std::span<const PathPair> pixel, std::uint32_t opaque) {
    std::vector<PathPair> layers;
    for (const PathPair& pair : pixel)
        if (pair.stored < opaque) layers.push_back(pair);
    std::stable_sort(layers.begin(), layers.end(), [](const PathPair& a, const PathPair& b) {
        return a.stored != b.stored ? a.stored < b.stored : a.reference > b.reference;
    });
    const auto same = [](const PathPair& a, const PathPair& b) { return a.stored == b.stored; };
    layers.erase(std::unique(layers.begin(), layers.end(), same), layers.end());
    return layers;
}

// Keeps the first fragment, in the order of the pairs, with the strictest bound.
void limit_from_below(SafeRange& range, std::int64_t lowest, const PathPair& pair) {
    if (range.lowest && *range.lowest >= lowest) return;
    range.lowest = lowest;
    range.repeated = pair;
}

void limit_from_above(SafeRange& range, std::int64_t highest, const PathPair& front, const PathPair& behind,
                      bool is_opaque) {
    if (range.highest && *range.highest <= highest) return;
    range.highest = highest;
    range.front = front;
    range.behind = behind;
    range.behind_opaque = is_opaque;
}

// The depth that n is added to: only the compared one, or the stored one. In the latter case the opaque surface is also
// compared with the moved depth.
enum class Moves : std::uint8_t { comparison, stored_depth };

// Calls body(layers, opaque code) for every pixel.
template <class Body>
void for_each_pixel(std::span<const PathPair> pairs, std::span<const std::uint32_t> opaque, Body&& body) {
    for (std::size_t begin = 0; begin < pairs.size();) {
        std::size_t end = begin;
        while (end < pairs.size() && pairs[end].pixel == pairs[begin].pixel) ++end;
        const std::uint32_t limit = opaque[pairs[begin].pixel];
        body(layers_of(pairs.subspan(begin, end - begin), limit), limit);
        begin = end;
    }
}

SafeRange range_of(std::span<const PathPair> pairs, std::span<const std::uint32_t> opaque, Moves moves) {
    SafeRange range;
    for_each_pixel(pairs, opaque, [&](const std::vector<PathPair>& layers, std::uint32_t limit) {
        for (std::size_t i = 0; i < layers.size(); ++i) {
            limit_from_below(range, layers[i].difference(), layers[i]);
            if (i + 1 == layers.size()) continue;
            // The largest integer n with reference > stored + n.
            const std::int64_t highest = std::int64_t{layers[i + 1].reference} - layers[i].stored - 1;
            limit_from_above(range, highest, layers[i], layers[i + 1], false);
        }
        if (moves == Moves::stored_depth && !layers.empty())
            limit_from_above(range, std::int64_t{limit} - layers.back().stored - 1, layers.back(), {}, true);
    });
    return range;
}

// Compares a fragment's reference with a stored code, as a program does. The doubles from 0 to 1 are ordered like their
// bits.
struct CodePair {
    pipeline::DepthFormat format;
    std::uint32_t reference, stored;

    [[nodiscard]] bool is_behind(std::uint64_t epsilon_bits) const {
        const pipeline::DepthCompare compare{.format = format, .epsilon = {std::bit_cast<double>(epsilon_bits), 0}};
        return compare.is_behind(reference, compare.value(reference), stored);
    }
    // The least epsilon in low ... high with which the reference is not behind; high if no smaller one is found.
    [[nodiscard]] std::uint64_t least_that_hides(std::uint64_t low, std::uint64_t high) const {
        while (low < high) {
            const std::uint64_t middle = low + (high - low) / 2;
            if (is_behind(middle))
                low = middle + 1;
            else
                high = middle;
        }
        return low;
    }
};

constexpr auto one_bits = std::bit_cast<std::uint64_t>(1.0);

}  // namespace

SafeRange safe_epsilon(std::span<const PathPair> pairs, std::span<const std::uint32_t> opaque) {
    return range_of(pairs, opaque, Moves::comparison);
}

SafeRange safe_bias(std::span<const PathPair> pairs, std::span<const std::uint32_t> opaque) {
    SafeRange range = range_of(pairs, opaque, Moves::stored_depth);
    for (const PathPair& pair : pairs) {
        const std::uint32_t limit = opaque[pair.pixel];
        // A hidden fragment must stay hidden when the bias moves it: stored + n >= opaque.
        if (pair.stored >= limit) limit_from_below(range, std::int64_t{limit} - pair.stored, pair);
    }
    return range;
}

SafeAbsolute safe_absolute(std::span<const PathPair> pairs, std::span<const std::uint32_t> opaque,
                           pipeline::DepthFormat format) {
    // The doubles from 0 to 1 are ordered like their bits, so both searches are binary searches over the bits.
    std::uint64_t lowest = 0, lost_from = one_bits + 1;  // safe: lowest <= epsilon < lost_from
    for_each_pixel(pairs, opaque, [&](const std::vector<PathPair>& layers, std::uint32_t) {
        for (std::size_t i = 0; i < layers.size(); ++i) {
            const CodePair own{format, layers[i].reference, layers[i].stored};
            // Only a fragment that violates the current bound needs a search.
            if (own.is_behind(lowest)) lowest = own.least_that_hides(lowest, one_bits + 1);
            if (i + 1 == layers.size()) continue;
            const CodePair next{format, layers[i + 1].reference, layers[i].stored};
            if (lost_from > 0 && !next.is_behind(lost_from - 1)) lost_from = next.least_that_hides(0, lost_from - 1);
        }
    });
    SafeAbsolute range{.lowest = {}, .highest = {}, .is_empty = lowest >= lost_from};
    if (lowest <= one_bits) range.lowest = std::bit_cast<double>(lowest);
    if (lost_from > 0 && lost_from <= one_bits) range.highest = std::bit_cast<double>(lost_from - 1);
    return range;
}

}  // namespace strata::peeling
