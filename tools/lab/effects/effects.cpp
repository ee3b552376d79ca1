// tools/lab/effects/effects.cpp - strata bench --per-effect: prints which effects a run simulates and why, what they
// cost, and what omitting the others saves.
//
// Rule     Every kind of run is repeated, alternating with the others, on warm caches; its time is the median. The cost
//          of a stage is the difference that a second stage of its kind makes, with a state that changes nothing; this
//          also measures stages that no state needs (pipeline/frame/effects.h). An omitted value is measured in the
//          same way. The cost of a value that passes need is the difference between two traversals of all fragments,
//          one with it and one without, times the number of those passes. Effects are timed without replay, because
//          Effects::all does not use it.
// Tests    tests/tools/lab/effects/effects_test.cpp
#include "tools/lab/effects/effects.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <nlohmann/json.hpp>

#include "tools/lab/bench/bench_jobs.h"
#include "tools/lab/bench/spread.h"
#include "tools/lab/effects/effects_plan.h"
#include "tools/request/choices.h"
#include "tools/request/parse.h"
#include "tools/strata/table.h"

namespace strata::tools {

namespace {

// Seconds of complete runs.
struct EffectTimes {
    Spread needed, all, as_asked;
};

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

// Sets EffectRow::seconds if it can be measured, and whether it exceeds the noise of the runs. Costs are differences of
// measured times; negative ones become 0.
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

using nlohmann::ordered_json;

// The result for one algorithm.
struct Explained {
    const peeling::Algorithm* algorithm = nullptr;
    std::string refusal;  // empty if it ran
    EffectsPlan plan;
    EffectTimes times;
};

// Runs the algorithm once for its counts, then plans and times its effects.
Explained explain(const BenchScene& scene, const peeling::Algorithm& algorithm, int repeat) {
    const BenchJob asked{.scene = &scene,
                         .algorithm = &algorithm,
                         .execution = scene.options.render.execution,
                         .simd = scene.options.render.simd,
                         .effects = scene.options.render.effects};
    Explained explained{.algorithm = &algorithm, .refusal = "", .plan = {}, .times = {}};
    const BenchRun run = run_once(asked);
    explained.refusal = run.refusal;
    if (!run.refusal.empty()) return explained;
    explained.plan = plan_effects(asked, run);
    explained.times = measure_effects(asked, repeat, explained.plan);
    return explained;
}

ordered_json to_json(const Explained& e, const BenchScene& scene) {
    ordered_json document{{"algorithm", e.algorithm->name}, {"profile", scene.session.profile.name}};
    document["refusal"] = e.refusal.empty() ? ordered_json(nullptr) : ordered_json(e.refusal);
    document["geometry_passes"] = e.plan.geometry_passes;
    document["effects"] = ordered_json::array();
    for (const EffectRow& row : e.plan.rows)
        document["effects"].push_back({{"effect", row.effect},
                                       {"simulated", row.is_simulated},
                                       {"why", row.why},
                                       {"passes", row.passes},
                                       {"fragments", row.fragments},
                                       {"seconds", row.seconds ? ordered_json(*row.seconds) : ordered_json(nullptr)},
                                       {"noise", row.is_noise}});
    const auto& t = e.plan.tiles;
    document["tiles"] = {{"all", t.tiles},     {"empty", t.empty},     {"opaque_only", t.opaque_only},
                         {"single", t.single}, {"layered", t.layered}, {"with_opaque", t.with_opaque}};
    document["seconds"] = {
        {"needed", e.times.needed.median}, {"all", e.times.all.median}, {"as_asked", e.times.as_asked.median}};
    return document;
}

std::string milliseconds(const EffectRow& row) {
    if (!row.seconds) return "-";
    return row.is_noise ? "noise" : fmt::format("{:.2f}", *row.seconds * 1e3);
}

// "x 2.00 ms, y 3.00 ms: WORDS 1.50 times as fast", or a note that the runs of both overlap.
std::string compared(const std::string& names, const Spread& with, const Spread& without, const char* words) {
    const std::string times = fmt::format(fmt::runtime(names), with.median * 1e3, without.median * 1e3);
    if (is_apart(with, without))
        return fmt::format("{}: {} {:.2f} times as fast\n", times, words, without.median / with.median);
    return fmt::format(
        "{}: no difference beyond the noise ({} runs of each, {:.2f} to {:.2f} ms and {:.2f} to {:.2f} ms)\n", times,
        with.runs, with.least * 1e3, with.greatest * 1e3, without.least * 1e3, without.greatest * 1e3);
}

// Simulated effects first, then the omitted ones.
std::string to_text(const Explained& e, const BenchScene& scene) {
    if (!e.refusal.empty()) return fmt::format("{}: {}\n", e.algorithm->name, e.refusal);
    Table table{{{e.algorithm->name},
                 {""},
                 {"passes", Align::right},
                 {"fragments", Align::right},
                 {"ms", Align::right},
                 {"why"}},
                {}};
    for (const bool simulated : {true, false})
        for (const EffectRow& row : e.plan.rows)
            if (row.is_simulated == simulated)
                table.rows.push_back({row.effect, simulated ? "simulated" : "left out",
                                      row.passes > 0 ? fmt::format("{}", row.passes) : "-",
                                      row.fragments > 0 ? fmt::format("{}", row.fragments) : "-", milliseconds(row),
                                      row.why});
    const auto& t = e.plan.tiles;
    std::string text = to_text(table);
    const peeling::ListOrder order = e.algorithm->order;
    if (order == peeling::ListOrder::sets || order == peeling::ListOrder::objects)
        text += "fragments: as if every pass drew the whole list; a pass over a part of it draws fewer\n";
    text +=
        "ms: what an effect costs in the whole run, or what leaving it out saves; each pass rasterizes, medians of "
        "runs in turn; noise: less than the runs vary by, or fewer than four of them\n";
    text += fmt::format(
        "{} tiles: {} empty, {} with opaque fragments alone, {} with one transparent fragment a pixel at most, {} that "
        "need peeling; {} need opaque priming\n",
        t.tiles, t.empty, t.opaque_only, t.single, t.layered, t.with_opaque);
    text += compared("needed {:.2f} ms, all {:.2f} ms", e.times.needed, e.times.all, "leaving the others out makes it");
    if (scene.options.render.execution == pipeline::Execution::replay)
        text += compared("replay {:.2f} ms, every pass rasterized {:.2f} ms", e.times.as_asked, e.times.needed,
                         "rasterizing once makes it");
    return text;
}

}  // namespace

int show_effects(const BenchScene& scene, int repeat, bool json) {
    ordered_json documents = ordered_json::array();
    std::string text;
    bool any = false;
    for (const peeling::Algorithm* algorithm : scene.options.algorithms) {
        const Explained explained = explain(scene, *algorithm, repeat);
        any |= explained.refusal.empty();
        documents.push_back(to_json(explained, scene));
        text += (text.empty() ? "" : "\n") + to_text(explained, scene);
    }
    print(json ? documents.dump(2, ' ', false, ordered_json::error_handler_t::replace) + '\n' : text);
    return any ? 0 : 2;
}

}  // namespace strata::tools
