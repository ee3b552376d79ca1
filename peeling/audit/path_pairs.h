// peeling/audit/path_pairs.h - pairs the fragments of two depth paths and counts how often their codes differ, and by
// how much.
//
// Rule     A pass that writes depth and a pass that compares with it draw the same fragment, identified by its pixel
//          and its primitive. `stored` is the code that the first writes into the buffer, `reference` the code that the
//          second computes. Their difference, reference - stored, is counted in units of the last place: codes of D16
//          and D24, steps between neighbouring floats of D32F (its codes are ordered integers).
// Source   Everitt 2001, "Depth peeling"; peeling/reference/audit.md 8.
// Numbers  |difference| < 2^32, in 64 bits.
// Tests    tests/peeling/audit/path_pairs_test.cpp
#pragma once
#include <cstdint>
#include <span>
#include <vector>

namespace strata::pipeline {
struct CapturedFragment;
}

namespace strata::peeling {

// One fragment, with its codes by both paths.
struct PathPair {
    std::uint32_t pixel = 0, primitive = 0;  // row-major index in the frame; submission index
    std::uint32_t stored = 0, reference = 0;
    friend bool operator==(const PathPair&, const PathPair&) = default;
    [[nodiscard]] std::int64_t difference() const noexcept { return std::int64_t{reference} - stored; }
};

struct PairedFragments {
    std::vector<PathPair> pairs;  // by pixel, then in submission order
    std::uint64_t unmatched = 0;  // fragments that occur in only one of the two passes
};

// How fragments of one pixel are matched: by triangle, or, where quads are split along different diagonals, by the
// triangle of the same index, else by one of its neighbours in submission order.
enum class Match : std::uint8_t { triangle, quad };

// Pairs the fragments of two captures of one frame. `first` gives `stored`, `second` gives `reference`, in both cases
// the captured `code`; the pair's primitive is that of `first`.
[[nodiscard]] PairedFragments pair_up(std::span<const pipeline::CapturedFragment> first,
                                      std::span<const pipeline::CapturedFragment> second,
                                      Match match = Match::triangle);

// Differences in low <= difference <= high; negative bins mirror the positive ones.
struct UlpBin {
    std::int64_t low = 0, high = 0;
    std::uint64_t count = 0;
    friend bool operator==(const UlpBin&, const UlpBin&) = default;
};

// Statistics of all pairs of a frame.
struct PathComparison {
    std::uint64_t fragments = 0, differing = 0, unmatched = 0;
    std::int64_t largest = 0;  // the difference of largest magnitude, with its sign
    PathPair where;            // the first fragment, in order of pixels, that has it
    std::vector<UlpBin>
        histogram;  // from low to high, without empty bins: 0, 1, 2, 3 to 4, 5 to 8, ... by powers of two
    friend bool operator==(const PathComparison&, const PathComparison&) = default;
};

[[nodiscard]] PathComparison compare(const PairedFragments& fragments);

}  // namespace strata::peeling
