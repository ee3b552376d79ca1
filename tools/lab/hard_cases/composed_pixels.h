// tools/lab/hard_cases/composed_pixels.h - the fragments and the composited sequence of each pixel that a frame shows
// something at.
//
// Rule     Pixels come in the frame's order. One without a visible fragment on which nothing was composited is left
//          out, so a frame costs what it shows, however large it is.
// Tests    tests/tools/hard_cases/composited_test.cpp
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

// A fragment that lies before the opaque surface and is a layer to the algorithm, and its key.
struct VisibleFragment {
    std::uint32_t key = 0;
    const pipeline::CapturedFragment* fragment = nullptr;
};
[[nodiscard]] bool has_tie(const std::vector<VisibleFragment>& pixel);

// What a pixel composited, near to far.
using Sequence = std::vector<pipeline::TraceEntry>;

struct ComposedPixel {
    std::size_t pixel = 0;                 // of the frame, row by row
    std::vector<VisibleFragment> visible;  // in submission order
    Sequence sequence;
};
[[nodiscard]] std::vector<ComposedPixel> composed_pixels(const ComposedFrame& frame);

}  // namespace strata::tools
