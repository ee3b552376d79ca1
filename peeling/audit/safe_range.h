// peeling/audit/safe_range.h - which bias keeps a peel by two depth paths right: the adviser of the invariance
// laboratory.
//
// Rule     A pass peels what its reference lies behind the depth peeled last, moved back by n: reference > stored + n.
//          In a pixel whose layers (distinct stored codes) are L1 < L2 < ..., no layer comes twice iff n >= reference -
//          stored for every fragment, and none is lost iff for all neighbours some fragment of the second one has
//          reference - Li > n. So the safe n are an interval, whole numbers of codes; two fragments exclude each other
//          where it is empty.
// Source   Everitt 2001 (the peel); the proof: a fragment whose reference stays behind its own biased depth is found
//          again in every later pass, since the least of the depths left never grows past it; and a layer that is
//          passed over is never found, because what is peeled next lies behind it.
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
    std::optional<std::int64_t> lowest, highest;  // inclusive; no lowest: no fragment; no highest: no layer to lose
    PathPair repeated;  // sets `lowest`: below it this fragment is peeled twice, or, by a bias, comes before the opaque
                        // surface
    PathPair front, behind;      // set `highest`: above it `behind` is lost once `front` is peeled
    bool behind_opaque = false;  // `highest` is set by the opaque surface or the far end instead: `front` would meet it
    [[nodiscard]] bool is_empty() const noexcept { return lowest && highest && *lowest > *highest; }
    [[nodiscard]] bool contains(std::int64_t n) const noexcept {
        return (!lowest || n >= *lowest) && (!highest || n <= *highest);
    }
    friend bool operator==(const SafeRange&, const SafeRange&) = default;
};

// `pairs` as pair_up gives them; `opaque` holds the stored code of the opaque surface of every pixel: what is not
// before it is invisible. For an epsilon in the compare, in units of the last place.
[[nodiscard]] SafeRange safe_epsilon(std::span<const PathPair> pairs, std::span<const std::uint32_t> opaque);

// For a bias added to the stored depth, in codes of a fixed-point format: a biased fragment must also stay on its side
// of `opaque`. References are above 0, where depths would be clamped.
[[nodiscard]] SafeRange safe_bias(std::span<const PathPair> pairs, std::span<const std::uint32_t> opaque);

// Epsilons as parts of the depth range [0,1], as a program adds them: every double from `lowest` to `highest` is safe,
// the next ones outside are not. Empty: no double is.
struct SafeAbsolute {
    std::optional<double> lowest,
        highest;  // lowest: none if no epsilon up to 1 is enough; highest: none if nothing can be lost
    bool is_empty = false;
    [[nodiscard]] bool contains(double epsilon) const noexcept {
        return !is_empty && lowest && epsilon >= *lowest && (!highest || epsilon <= *highest);
    }
    friend bool operator==(const SafeAbsolute&, const SafeAbsolute&) = default;
};
[[nodiscard]] SafeAbsolute safe_absolute(std::span<const PathPair> pairs, std::span<const std::uint32_t> opaque,
                                         pipeline::DepthFormat format);

}  // namespace strata::peeling
