// peeling/memory_need.h - the memory that a frame will need, computed before it is allocated.
//
// Rule     Counted: the resulting images and layers; the words per pixel of the targets of all regions that run at
//          once; the prepared triangles. Estimated: the fragments that replay, lists and the audit keep, from the
//          densest part of the view, up to their limits. A rehearsal frame of 64x64 pixels gives the number of words
//          and layers. A larger frame, more threads or more memory for fragments never give a smaller result.
// Tests    tests/peeling/frame/memory_need_test.cpp, tests/tools/strata/render/max_memory_test.cpp: comparison with
//          measured peaks
#pragma once
#include <cstdint>

namespace strata::peeling {

struct Algorithm;
struct FrameRequest;

struct MemoryNeed {  // in bytes
    std::uint64_t pictures = 0, targets = 0, layers = 0, fragments = 0, triangles = 0;
    [[nodiscard]] std::uint64_t total() const noexcept { return pictures + targets + layers + fragments + triangles; }
    friend bool operator==(const MemoryNeed&, const MemoryNeed&) = default;
};

// The memory that Renderer::render needs for these arguments in addition to the list itself; all 0 if the
// profile rejects the frame. The lists of every sample are kept, but only one image of a sample and the sum; of samples
// that load one another, the frames exist together. Throws InputError as Renderer does.
[[nodiscard]] MemoryNeed memory_need(const FrameRequest& request, const Algorithm& algorithm);

}  // namespace strata::peeling
