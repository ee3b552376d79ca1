// pipeline/frame/sample_loads.h - which sample a program loads of what earlier passes stored.
//
// Source   pipeline/reference/fragment-stages.md 13.5.
#pragma once
#include <cstdint>

namespace strata::pipeline {

class SampleGroup;  // pipeline/frame/sample_group.h

// The sample that a program's loads read: its own, sample 0, or all of them resolved
// (pipeline/reference/fragment-stages.md 13.3).
enum class LoadedSample : std::uint8_t { own, zero, resolved };

// The part of one sample's frame in a group.
struct SampleLoads {
    SampleGroup* group = nullptr;  // null: every sample is a frame by itself, and loads read its own targets
    int sample = 0, count = 1;     // the number of this sample, and of all
    LoadedSample geometry = LoadedSample::own;     // loads of geometry passes: of peels
    LoadedSample full_screen = LoadedSample::own;  // loads of full-screen passes: of composites
    [[nodiscard]] bool loads_others() const noexcept {
        return group != nullptr && (geometry != LoadedSample::own || full_screen != LoadedSample::own);
    }
};

}  // namespace strata::pipeline
