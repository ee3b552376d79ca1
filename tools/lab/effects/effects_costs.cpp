#include "tools/lab/effects/effects_costs.h"

#include <algorithm>
#include <chrono>

#include "tools/lab/bench/bench_jobs.h"
#include "tools/lab/effects/effects_plan.h"

namespace strata::tools {

namespace {

using pipeline::Effect;

// Wall-clock seconds of one call.
double seconds_of(const std::function<void()>& run) {
    const auto start = std::chrono::steady_clock::now();
    run();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

// The seconds of each; a first round warms up. The runs of a round follow each other directly, so that a machine that
// becomes slower affects all of them equally.
std::vector<Spread> in_turn(const std::vector<std::function<void()>>& runs, int repeat) {
    std::vector<std::vector<double>> seconds(runs.size());
    for (int round = 0; round <= repeat; ++round)
        for (std::size_t i = 0; i < runs.size(); ++i) {
            const double taken = seconds_of(runs[i]);
            if (round > 0) seconds[i].push_back(taken);
        }
    std::vector<Spread> spreads;
    for (const auto& values : seconds) spreads.push_back(spread_of(values));
    return spreads;
}

// Sets the cost to the difference between runs with and without an effect, times `times`.
void set_cost(EffectRow& row, const Spread& with, const Spread& without, double times = 1) {
    row.seconds = std::max(0.0, with.median - without.median) * times;
    row.is_noise = !is_apart(with, without);
}

// True for an array that is computed per fragment; the other effects are stages.
bool is_value(Effect effect) {
    using enum Effect;
    return effect == color || effect == texcoord || effect == shader_z || effect == code || effect == facing;
}

// Values that the run needs cannot be omitted: they are measured by traversals of the fragments.
bool is_walked(const EffectRow& row) { return row.is_simulated && is_value(row.effect_id); }

// The values that the plan simulates, except one.
rasterizer::FragmentNeeds values_without(const EffectsPlan& plan, Effect left_out) {
    rasterizer::FragmentNeeds needs{false, false, false, false, false, false};
    for (const EffectRow& row : plan.rows)
        if (is_walked(row) && row.effect_id != left_out) needs = with_value(needs, row.effect_id);
    return needs;
}

// Traversal 0 computes all needed values, each further one all except one.
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
    const std::vector<Spread> spreads = in_turn(walks, repeat);
    std::size_t next = 1;
    for (EffectRow& row : plan.rows)
        if (is_walked(row)) set_cost(row, spreads[0], spreads[next++], static_cast<double>(row.passes));
}

}  // namespace

EffectTimes measure_effects(const BenchJob& asked, int repeat, EffectsPlan& plan) {
    // The plain run is made without replay, which would hide the cost of passes.
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
    const std::vector<Spread> spreads = in_turn(runs, repeat);
    for (std::size_t i = 0; i < rows.size(); ++i) set_cost(*rows[i], spreads[3 + i], spreads[0]);
    measure_values(asked, repeat, plan);
    return {spreads[0], spreads[1], spreads[2]};
}

}  // namespace strata::tools
