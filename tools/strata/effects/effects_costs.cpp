#include "tools/strata/effects/effects_costs.h"

#include <algorithm>
#include <chrono>

#include "tools/strata/bench/bench_report.h"
#include "tools/strata/effects/effects_plan.h"

namespace strata::tools {

namespace {

using pipeline::Effect;

// Wall-clock seconds of one call.
double seconds_of(const std::function<void()>& run) {
    const auto start = std::chrono::steady_clock::now();
    run();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

// Median seconds of each; a first round warms up. The runs of a round stand next to each other in
// time, so that a machine that becomes slower changes all of them alike.
std::vector<double> in_turn(const std::vector<std::function<void()>>& runs, int repeat) {
    std::vector<std::vector<double>> seconds(runs.size());
    for (int round = 0; round <= repeat; ++round)
        for (std::size_t i = 0; i < runs.size(); ++i) {
            const double taken = seconds_of(runs[i]);
            if (round > 0) seconds[i].push_back(taken);
        }
    std::vector<double> medians;
    for (const auto& values : seconds) medians.push_back(spread_of(values).median);
    return medians;
}

double cost(double with, double without) { return std::max(0.0, with - without); }

// True for an array that is computed for each fragment; the other effects are stages.
bool is_value(Effect effect) {
    using enum Effect;
    return effect == color || effect == texcoord || effect == shader_z || effect == code || effect == facing;
}

// Values that the run needs cannot be left out of it: walks over the fragments measure them.
bool is_walked(const EffectRow& row) { return row.is_simulated && is_value(row.effect_id); }

// The values that the plan simulates, all but one.
rasterizer::FragmentNeeds values_without(const EffectsPlan& plan, Effect left_out) {
    rasterizer::FragmentNeeds needs{false, false, false, false, false, false};
    for (const EffectRow& row : plan.rows)
        if (is_walked(row) && row.effect_id != left_out) needs = with_value(needs, row.effect_id);
    return needs;
}

// Walk 0 computes all values that are called for, each further walk all but one.
void measure_values(const BenchJob& asked, int repeat, EffectsPlan& plan) {
    const peeling::RenderOptions& options = asked.scene->options.render;
    std::vector<std::function<void()>> walks;
    const auto add = [&](Effect left_out) {
        walks.push_back([&plan, &options, needs = values_without(plan, left_out)] {
            const SimdScope kernels{options.simd};
            pipeline::walk(plan.drawn, {}, needs, options.threads);
        });
    };
    add(Effect::none);
    for (const EffectRow& row : plan.rows)
        if (is_walked(row)) add(row.effect_id);
    const std::vector<double> medians = in_turn(walks, repeat);
    std::size_t next = 1;
    for (EffectRow& row : plan.rows)
        if (is_walked(row)) row.seconds = cost(medians[0], medians[next++]) * static_cast<double>(row.passes);
}

}  // namespace

EffectTimes measure_effects(const BenchJob& asked, int repeat, EffectsPlan& plan) {
    // The plain run: without replay, which would hide what passes cost.
    BenchJob needed = asked;
    needed.is_never_replayed = true;
    needed.effects = pipeline::Effects::needed;
    BenchJob all = needed;
    all.effects = pipeline::Effects::all;
    std::vector<BenchJob> jobs{needed, all, asked};
    std::vector<EffectRow*> rows;
    for (EffectRow& row : plan.rows) {
        if (row.effect_id == Effect::none || is_walked(row)) continue;
        jobs.push_back(needed);
        jobs.back().once_more = row.effect_id;
        rows.push_back(&row);
    }
    std::vector<std::function<void()>> runs;
    for (const BenchJob& job : jobs) runs.push_back([&job] { static_cast<void>(run_once(job)); });
    const std::vector<double> medians = in_turn(runs, repeat);
    for (std::size_t i = 0; i < rows.size(); ++i) rows[i]->seconds = cost(medians[3 + i], medians[0]);
    measure_values(asked, repeat, plan);
    return {medians[0], medians[1], medians[2]};
}

}  // namespace strata::tools
