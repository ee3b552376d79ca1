// pipeline/frame/observer.h - what a run shows of itself, step by step and stage by stage, to a caller that explains
// it.
//
// Rule     A run with an observer is literal: one region, one thread, every step in order. Steps are shown when they
//          have ended, stages of a batch when its lanes have passed them. What is the emulator's own work (opaque
//          priming) is shown as uncounted.
// Tests    tests/tools/oracle/passes_test.cpp, explain_test.cpp
#pragma once
#include <functional>
#include <string_view>

#include "pipeline/frame/pass.h"

namespace strata::pipeline {

class Region;
struct TraceEntry;  // pipeline/frame/trace.h

enum class Step : std::uint8_t { clear, copy, geometry, full_screen, query, publish };

struct StepEvent {
    Step step{};
    const PassState* state =
        nullptr;    // of passes; null for one that runs beside the stages (RegionShortcuts::count_passes)
    Target to{};    // of clear, copy and publish
    Target from{};  // of copy
    const ClearValue* clear = nullptr;      // of clear
    std::uint8_t sample_mask = 0xff;        // of clear
    std::uint64_t passed = 0, tallied = 0;  // of passes; of a query, `passed` is the count that it asks about
    bool answer = false;                    // of a query: go on
    bool is_counted = true;
    int iteration = 0;  // 0: before the first
};

// The stages of a batch in their order; `written` is behind the render targets.
enum class Stage : std::uint8_t { shaded, program, alpha_test, depth_units, tests, written };

struct StageEvent {
    Stage stage{};
    const PassState& state;
    const FragmentBatch& batch;
    const Outputs& out;
    const Lanes<std::uint32_t>& alive;  // the lanes that are left behind this stage
    int sample = 0;
    bool is_geometry = true, is_counted = true;
};

// Empty functions are not called. With `traced` the run keeps a trace, and each step of it is shown when it is taken
// down.
struct Observer {
    std::function<void(Target target, std::string_view name)> named{};
    std::function<void(const Region& region, const StepEvent& event)> step{};
    std::function<void(const Region& region, const StageEvent& event)> stage{};
    std::function<void(const Region& region, const TraceEntry& entry)> traced{};
};

}  // namespace strata::pipeline
