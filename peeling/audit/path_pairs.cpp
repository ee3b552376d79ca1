// peeling/audit/path_pairs.cpp - a merge of two sorted sequences of fragments, and the histogram of their
// differences.
#include "peeling/audit/path_pairs.h"

#include <algorithm>
#include <bit>
#include <map>
#include <tuple>

#include "pipeline/frame/captured_fragment.h"

namespace strata::peeling {

using pipeline::CapturedFragment;

namespace {

// Identifies a fragment, to match both captures; primitives ascend in submission order.
auto place(const CapturedFragment& f) { return std::tuple(f.pixel, f.primitive); }

// A stable sort keeps fragments of one pixel and primitive in the order of the capture.
std::vector<CapturedFragment> by_place(std::span<const CapturedFragment> fragments) {
    std::vector<CapturedFragment> sorted(fragments.begin(), fragments.end());
    std::stable_sort(sorted.begin(), sorted.end(), [](const auto& a, const auto& b) { return place(a) < place(b); });
    return sorted;
}

// True if the first fragments of both sequences are the same. A neighbour matches only if
// the sequence with the lower index does not continue with a fragment of the other's triangle.
bool are_partners(std::span<const CapturedFragment> a, std::span<const CapturedFragment> b, Match match) {
    if (place(a[0]) == place(b[0])) return true;
    if (match == Match::triangle || a[0].pixel != b[0].pixel) return false;
    const auto is_before = [](std::span<const CapturedFragment> near, const CapturedFragment& far) {
        return near[0].primitive + 1 == far.primitive && (near.size() == 1 || place(near[1]) != place(far));
    };
    return is_before(a, b[0]) || is_before(b, a[0]);
}

// 0 is bin 0, 1 is 1, 2 is 2, 3 to 4 is 3, 5 to 8 is 4: the bit width of magnitude - 1, plus one.
int bin_of(std::int64_t difference) {
    const auto magnitude = static_cast<std::uint64_t>(difference < 0 ? -difference : difference);
    if (magnitude == 0) return 0;
    const int bin = static_cast<int>(std::bit_width(magnitude - 1)) + 1;
    return difference < 0 ? -bin : bin;
}

// The inverse of bin_of(): bin b > 1 contains 2^(b - 2) + 1 to 2^(b - 1).
UlpBin bounds_of(int bin) {
    if (bin == 0) return {0, 0, 0};
    const int steps = bin < 0 ? -bin : bin;
    const std::int64_t high = std::int64_t{1} << (steps - 1), low = steps == 1 ? 1 : high / 2 + 1;
    return bin < 0 ? UlpBin{-high, -low, 0} : UlpBin{low, high, 0};
}

std::int64_t magnitude(const PathPair& pair) { return pair.difference() < 0 ? -pair.difference() : pair.difference(); }

}  // namespace

PairedFragments pair_up(std::span<const CapturedFragment> first, std::span<const CapturedFragment> second,
                        Match match) {
    const std::vector<CapturedFragment> a = by_place(first), b = by_place(second);
    PairedFragments result;
    result.pairs.reserve(std::min(a.size(), b.size()));
    // A first element without a partner is skipped and counted; so are the remainders of both sequences.
    std::size_t i = 0, j = 0;
    while (i < a.size() && j < b.size()) {
        if (are_partners(std::span{a}.subspan(i), std::span{b}.subspan(j), match))
            result.pairs.push_back({a[i].pixel, a[i].primitive, a[i++].code, b[j++].code});
        else if (++result.unmatched; place(a[i]) < place(b[j]))
            ++i;
        else
            ++j;
    }
    result.unmatched += a.size() - i + b.size() - j;
    return result;
}

PathComparison compare(const PairedFragments& fragments) {
    PathComparison result;
    result.fragments = fragments.pairs.size();
    result.unmatched = fragments.unmatched;
    // Ordered, so that the histogram runs from low to high.
    std::map<int, std::uint64_t> bins;
    for (const PathPair& pair : fragments.pairs) {
        ++bins[bin_of(pair.difference())];
        if (pair.difference() == 0) continue;
        // Only a larger magnitude replaces it, so the first of equals is kept.
        if (result.differing++ == 0 || magnitude(pair) > magnitude(result.where)) result.where = pair;
    }
    result.largest = result.where.difference();
    for (const auto& [bin, count] : bins) {
        result.histogram.push_back(bounds_of(bin));
        result.histogram.back().count = count;
    }
    return result;
}

}  // namespace strata::peeling
