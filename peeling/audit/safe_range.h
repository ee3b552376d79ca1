// peeling/audit/safe_range.h - computes the biases with which a peel by two depth paths is correct, for `strata
// invariance`.
//
// Rule     A pass peels the fragments whose reference is behind the depth peeled last, moved back by n: reference >
//          stored + n. In a pixel whose layers (distinct stored codes) are L1 < L2 < ..., no layer is peeled twice iff
//          n >= reference - stored for every fragment, and none is lost iff for all neighbouring layers Li, Li+1 some
//          fragment of the second one has reference - Li > n. So the safe n are an interval of whole numbers of codes.
//          Where it is empty, two fragments require contradictory n.
// Source   Everitt 2001 (the peel); the proof: a fragment whose reference stays behind its own biased depth is found
//          again in every later pass, since the least remaining depth never exceeds it; and a skipped layer is never
//          found, because the next peeled one is behind it.
// Numbers  Differences of 32-bit codes, in 64 bits.
// Tests    tests/peeling/audit/safe_range_test.cpp
#pragma once
#include <cstdint>
#include <optional>
#include <span>

#include "peeling/audit/path_pairs.h"
#include "pipeline/formats/format.h"

namespace strata::peeling {

struct SafeRange {
    // Inclusive; lowest is empty without fragments, highest if no layer can be lost.
    std::optional<std::int64_t> lowest, highest;
    // Determines `lowest`: below it this fragment is peeled twice, or, with a bias, is in front of the opaque surface.
    PathPair repeated;
    PathPair front, behind;  // determine `highest`: above it `behind` is lost once `front` is peeled
    // true: `highest` is limited by the opaque surface or the far end, which `front` would reach, and not by `behind`.
    bool behind_opaque = false;
    [[nodiscard]] bool is_empty() const noexcept { return lowest && highest && *lowest > *highest; }
    [[nodiscard]] bool contains(std::int64_t n) const noexcept {
        return (!lowest || n >= *lowest) && (!highest || n <= *highest);
    }
    friend bool operator==(const SafeRange&, const SafeRange&) = default;
};

// The safe range of an epsilon in the comparison, in units of the last place. `pairs` as returned by pair_up; `opaque`
// is the stored code of the opaque surface per pixel: fragments not in front of it are invisible.
[[nodiscard]] SafeRange safe_epsilon(std::span<const PathPair> pairs, std::span<const std::uint32_t> opaque);

// The safe range of a bias added to the stored depth, in codes of a fixed-point format: a biased fragment must also
// stay on its side of `opaque`. References must be above 0, where depths would be clamped.
[[nodiscard]] SafeRange safe_bias(std::span<const PathPair> pairs, std::span<const std::uint32_t> opaque);

// Epsilons as fractions of the depth range [0,1], as a program adds them: every double from `lowest` to `highest` is
// safe, and the next doubles outside are not. If the range is empty, no double is safe.
struct SafeAbsolute {
    std::optional<double> lowest,
        highest;  // lowest: empty if no epsilon up to 1 suffices; highest: empty if no layer can be lost
    bool is_empty = false;
    [[nodiscard]] bool contains(double epsilon) const noexcept {
        return !is_empty && lowest && epsilon >= *lowest && (!highest || epsilon <= *highest);
    }
    friend bool operator==(const SafeAbsolute&, const SafeAbsolute&) = default;
};
[[nodiscard]] SafeAbsolute safe_absolute(std::span<const PathPair> pairs, std::span<const std::uint32_t> opaque,
                                         pipeline::DepthFormat format);

}  // namespace strata::peeling
