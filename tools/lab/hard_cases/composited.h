// tools/lab/hard_cases/composited.h - compares the layers that a peel composited with its input fragments, pixel by
// pixel.
//
// Rule     A pixel's sequence is the layers composited UNDER, in order, then those composited OVER, last first. Its
//          keys must not decrease from near to far. An algorithm that keeps ties must composite every visible fragment
//          once; one that drops or mixes them, every key once. Fragments discarded by an alpha test are not expected.
//          All numbers are counted from traces and captured fragments, independently of the audit, so that each checks
//          the other.
// Tests    tests/tools/lab/hard_cases/composited_test.cpp
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
    std::uint64_t visible = 0;             // fragments of the frame in front of the opaque surface
    int deepest = 0, layers = 0;           // largest number of fragments and of distinct keys at a pixel
    std::uint64_t tied_pixels = 0;         // pixels with two visible fragments of one key
    std::uint64_t lost_by_ties = 0;        // visible fragments that share their key with an earlier one
    std::uint64_t lost = 0, repeated = 0;  // fragments, or keys where ties merge, shown never or repeatedly
    std::uint64_t misplaced = 0;           // positions where the key decreases
    std::uint64_t wrong_pixels = 0;        // pixels with any of the last three
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
