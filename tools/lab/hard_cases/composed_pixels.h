// tools/lab/hard_cases/composed_pixels.h - the fragments and the composited sequence of each nonempty pixel of a frame.
//
// Rule     Pixels are in the frame's order. A pixel without visible fragments and without composited layers is omitted,
//          so the cost does not depend on the frame's size.
// Tests    tests/tools/lab/hard_cases/composited_test.cpp
#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include "pipeline/frame/trace.h"

namespace strata::pipeline {
struct CapturedFragment;
}

namespace strata::tools {

struct ComposedFrame;  // composited.h

// A fragment in front of the opaque surface that is a layer for the algorithm, and its key.
struct VisibleFragment {
    std::uint32_t key = 0;
    const pipeline::CapturedFragment* fragment = nullptr;
};
[[nodiscard]] bool has_tie(const std::vector<VisibleFragment>& pixel);

// The layers that a pixel composited, near to far.
using Sequence = std::vector<pipeline::TraceEntry>;

struct ComposedPixel {
    std::size_t pixel = 0;                 // index in the frame, row by row
    std::vector<VisibleFragment> visible;  // in submission order
    Sequence sequence;
};
[[nodiscard]] std::vector<ComposedPixel> composed_pixels(const ComposedFrame& frame);

}  // namespace strata::tools
