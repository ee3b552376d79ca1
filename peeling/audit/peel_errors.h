// peeling/audit/peel_errors.h - finds the layers that a finished peel composited more than once, and those it never
// composited.
//
// Rule     A pixel's true layers are the distinct depth codes (stored integers) of its fragments before the opaque
//          surface, as the depth path that writes stores them, without polygon offset; fragments of one code are one
//          layer. The composited layers are read from the run's trace (region_trace.h): each depth in it stands for the
//          first fragment of that depth, and so for a layer. A layer composited twice or more often is one duplicate, a
//          layer never composited is one loss, so the counts stay finite for a peel that never ends.
// Source   peeling/reference/audit.md 9; keys-and-counts.md 2.2 (tie policies); algorithms.md 3.
// Tests    tests/peeling/audit/peel_errors_test.cpp
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "peeling/audit/audit_result.h"

namespace strata::peeling {

struct RegionTrace;

// A fragment of the peel: `layer` is the depth code that makes it part of a true layer, `key` the depth by which the
// algorithm orders it and which the trace records.
struct LayerFragment {
    std::uint32_t pixel = 0, primitive = 0;
    std::uint32_t layer = 0, key = 0;
    friend bool operator==(const LayerFragment&, const LayerFragment&) = default;
};

// Bits of a pixel's byte in the map; both may be set.
enum PeelError : std::uint8_t { layer_duplicated = 1, layer_lost = 2 };

struct PeelErrors {
    std::uint64_t layers = 0;  // true layers of all pixels
    int layers_max = 0;        // of the pixel that has the most
    std::uint64_t duplicated = 0, lost = 0;
    PixelCount touched;             // pixels with duplicated or lost layers
    std::vector<std::uint8_t> map;  // PeelError bits per pixel
    [[nodiscard]] std::uint64_t total() const noexcept { return duplicated + lost; }
};

// `fragments` are the visible ones, sorted by pixel and then in submission order; `traces` are those of a run of a
// frame of `width` x `height` pixels.
[[nodiscard]] PeelErrors peel_errors(std::span<const LayerFragment> fragments, std::span<const RegionTrace> traces,
                                     int width, int height);

}  // namespace strata::peeling
