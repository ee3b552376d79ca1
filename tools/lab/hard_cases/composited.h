// tools/lab/hard_cases/composited.h - what a peel composited, held against the fragments that it was given, pixel by
// pixel.
//
// Rule     A pixel's sequence is what was composited UNDER, then what was composited OVER, last first. Its keys must
//          not fall from near to far. An algorithm that keeps ties must show every visible fragment once; one that
//          drops or mixes them, every key once. What an alpha test keeps from being a layer is not looked for. The
//          figures are counted from traces and captured fragments alone. The audit has no part in them, so each of the
//          two checks the other.
// Tests    tests/tools/hard_cases/composited_test.cpp
#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

namespace strata::peeling {
struct Algorithm;
struct FrameFragments;
struct RegionTrace;
}  // namespace strata::peeling

namespace strata::tools {

struct Composited {
    std::uint64_t visible = 0;             // fragments of the frame before the opaque surface
    int deepest = 0, layers = 0;           // most fragments and most distinct keys at a pixel
    std::uint64_t tied_pixels = 0;         // with two visible fragments of one key
    std::uint64_t lost_by_ties = 0;        // visible fragments that share their key with an earlier one
    std::uint64_t lost = 0, repeated = 0;  // fragments, or keys where those count, shown never or more than once
    std::uint64_t misplaced = 0;           // places where the key falls
    std::uint64_t wrong_pixels = 0;        // that have one of the last three
    friend bool operator==(const Composited&, const Composited&) = default;
};

// The frame whose fragments and traces are compared.
struct ComposedFrame {
    const peeling::Algorithm& algorithm;
    int width = 0;
    bool tests_codes = true;  // the alpha test compares 8-bit codes
    const peeling::FrameFragments& fragments;
    const std::vector<peeling::RegionTrace>& traces;
};

[[nodiscard]] Composited composited(const ComposedFrame& frame);

}  // namespace strata::tools
