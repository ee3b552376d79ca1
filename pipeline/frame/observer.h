// pipeline/frame/observer.h - reports the steps and stages of a run to a caller that explains them.
//
// Rule     A run with an observer takes Path::literal (pipeline/frame/region_statistics.h): it uses one region and one
//          thread and executes every step in order. Steps are reported after they end, the stages of a batch after each
//          has processed all lanes. The emulator's own work
//          (opaque priming) is reported as uncounted.
// Tests    tests/tools/oracle/passes/passes_test.cpp, tests/tools/oracle/explain/explain_test.cpp
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
        nullptr;    // for passes; null for a pass that is counted but not executed (RegionShortcuts::count_passes)
    Target to{};    // for clear, copy and publish
    Target from{};  // for copy
    const ClearValue* clear = nullptr;  // for clear
    std::uint8_t sample_mask = 0xff;    // for clear
    // For passes: the fragments that passed the tests, and the sum of Outputs::tally. For a query: `passed` is its
    // count.
    std::uint64_t passed = 0, tallied = 0;
    bool answer = false;  // for a query: whether the loop continues
    bool is_counted = true;
    int iteration = 0;  // 0: before the first
};

// The stages of a batch in order; `depth_units` are the tests of STRATA_depth_units, `written` is reported after the
// render targets are updated.
enum class Stage : std::uint8_t { shaded, program, alpha_test, depth_units, tests, written };

struct StageEvent {
    Stage stage{};
    const PassState& state;
    const FragmentBatch& batch;
    const Outputs& out;
    const Lanes<std::uint32_t>& alive;  // the lanes that are alive after this stage
    int sample = 0;
    bool is_geometry = true, is_counted = true;
};

// Empty functions are not called. If `traced` is set, the run records a trace and calls it for each entry.
struct Observer {
    std::function<void(Target target, std::string_view name)> named{};
    std::function<void(const Region& region, const StepEvent& event)> step{};
    std::function<void(const Region& region, const StageEvent& event)> stage{};
    std::function<void(const Region& region, const TraceEntry& entry)> traced{};
};

}  // namespace strata::pipeline
