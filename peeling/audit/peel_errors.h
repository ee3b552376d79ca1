// peeling/audit/peel_errors.h - which layers a finished peel composited twice, and which never.
//
// Rule     A pixel's true layers are the distinct codes, before the opaque surface, that the writing path stores
//          without any bias: what the exact A-buffer keeps under the tie policy UNIQUE. What was composited is the
//          run's trace: a depth there means the first fragment of that depth, and so its layer. Twice or more often is
//          one duplicate; never is one loss. So a peel that never ends does not count without end.
// Source   audit.md 9; keys-and-counts.md 2.2 (tie policies); algorithms.md 3.
// Tests    tests/peeling/audit/peel_errors_test.cpp
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "peeling/audit/audit_result.h"

namespace strata::peeling {

struct RegionTrace;

// A fragment as the peel met it: `layer` is its code in the truth, `key` what the trace calls it.
struct LayerFragment {
    std::uint32_t pixel = 0, primitive = 0;
    std::uint32_t layer = 0, key = 0;
    friend bool operator==(const LayerFragment&, const LayerFragment&) = default;
};

// Bits of one pixel's byte in the map: both may be set.
enum PeelError : std::uint8_t { layer_duplicated = 1, layer_lost = 2 };

struct PeelErrors {
    std::uint64_t layers = 0;  // true layers of all pixels
    int layers_max = 0;        // of the deepest pixel
    std::uint64_t duplicated = 0, lost = 0;
    PixelCount touched;             // pixels with either
    std::vector<std::uint8_t> map;  // of each pixel: PeelError bits
    [[nodiscard]] std::uint64_t total() const noexcept { return duplicated + lost; }
};

// `fragments` are the visible ones, by pixel and in submission order; `traces` a run's, of a frame `width` x `height`.
[[nodiscard]] PeelErrors peel_errors(std::span<const LayerFragment> fragments, std::span<const RegionTrace> traces,
                                     int width, int height);

}  // namespace strata::peeling
