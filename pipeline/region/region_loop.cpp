// pipeline/region/region_loop.cpp - a region's iterations, queries and termination. The frame's counterpart is
// executor.cpp.
#include "pipeline/region/region_loop.h"

#include "pipeline/frame/termination.h"
#include "pipeline/region/region_shared.h"
#include "pipeline/region/region_targets.h"

namespace strata::pipeline {

void Loop::begin_loop() {
    if (const std::size_t number = shared_.statistics.loops.size(); number < shared_.statistics.passes_before.size())
        shared_.statistics.geometry_passes = shared_.statistics.passes_before[number];
    shared_.statistics.loops.emplace_back();
}

void Loop::begin_iteration() {
    ++shared_.statistics.iterations;
    ++shared_.statistics.loops.back().iterations;
}

// A tile that counts nothing stops; the executor runs it again with the frame's answers, unless it has promised to be
// idle.
bool Loop::any(Count count, Idle idle) {
    if (shared_.frame.termination.rule == TerminationRule::fixed) return true;  // no query at all
    if (shared_.instruments.log_passes) ++shared_.statistics.pass_log.queries;
    // A pass whose programs load other samples may composite a fragment again, though none passes its tests.
    if (!shared_.instruments.trust_idle || shared_.frame.loads_others()) idle = Idle::no;
    LoopStatistics& loop = shared_.statistics.loops.back();
    const std::size_t index = loop.decisions.size(), number = shared_.statistics.loops.size() - 1;
    const bool is_known = number < shared_.statistics.script.size() && index < shared_.statistics.script[number].size();
    bool answer = false;
    if (is_known) {
        answer = shared_.statistics.script[number][index];
    } else if (shared_.is_frame()) {
        answer = continues(shared_.frame.termination, shared_.frame.rect(), count.own_, shared_.frame.samples());
    } else {
        answer = count.own_ > 0;
    }
    if (const Alteration* a = shared_.alteration(); a != nullptr && a->query) answer = a->query(count.own_, answer);
    loop.decisions.push_back({count.own_, idle, answer});
    shared_.show({.step = Step::query, .passed = count.own_, .answer = answer});
    return answer;
}

// Both limits count geometry passes of the whole algorithm (peeling/reference/keys-and-counts.md 3.2). Every region has
// made the same number at this point, so all of them stop together.
bool Loop::limit_reached(int passes) const {
    const int fixed = shared_.frame.termination.rule == TerminationRule::fixed ? shared_.frame.termination.passes : 0;
    const int after = shared_.statistics.geometry_passes + passes;
    return (shared_.frame.max_passes > 0 && after > shared_.frame.max_passes) || (fixed > 0 && after > fixed);
}

void Loop::keep_layer(Target color, Target depth, Side side) {
    if (!shared_.frame.keep_layers) return;
    shared_.statistics.layers.push_back({targets_.resolved(color), targets_.resolved(depth), side});
}

void Loop::keep_no_layer(Target color, Target depth) {
    if (!shared_.frame.keep_layers) return;
    shared_.statistics.layers.push_back({targets_.resolved(color), targets_.resolved(depth), Side::front});
    ++shared_.statistics.idle_layers;
}

}  // namespace strata::pipeline
