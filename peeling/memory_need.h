// peeling/memory_need.h - the memory that a frame will take, told before it is asked for.
//
// Rule     Counted: the pictures that leave the machine, and the layers; words a pixel of the targets of as many
//          regions as run at once; the prepared triangles. Estimated: the fragments that replay, lists and the audit
//          keep, by the densest part of the view, up to the limits that they have. A rehearsal of 64x64 pixels says how
//          many words and layers there are. A larger frame, more threads or more memory for fragments never need less.
// Tests    tests/peeling/memory_need_test.cpp, tests/tools/max_memory_test.cpp: against measured peaks
#pragma once
#include <cstdint>

namespace strata::pipeline {
struct DrawList;
struct View;
struct DeviceProfile;
}  // namespace strata::pipeline

namespace strata::peeling {

struct Algorithm;
struct RenderOptions;

struct MemoryNeed {  // bytes
    std::uint64_t pictures = 0, targets = 0, layers = 0, fragments = 0, triangles = 0;
    [[nodiscard]] std::uint64_t total() const noexcept { return pictures + targets + layers + fragments + triangles; }
    friend bool operator==(const MemoryNeed&, const MemoryNeed&) = default;
};

// What SampledRenderer::render of these takes beyond the list itself; the frame must be one that the profile does not
// refuse, else all is 0. The lists of every sample are kept, and of its pictures one and the sum. Throws InputError as
// Renderer does.
[[nodiscard]] MemoryNeed memory_need(const pipeline::DrawList& list, const pipeline::View& view,
                                     const pipeline::DeviceProfile& profile, const RenderOptions& options,
                                     const Algorithm& algorithm, int samples = 1);

}  // namespace strata::peeling
