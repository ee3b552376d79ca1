// tools/lab/effects/effects.cpp - strata bench --per-effect: prints which effects a run simulates and why, what they
// cost, and what omitting the others saves.
#include "tools/lab/effects/effects.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "tools/lab/effects/effects_costs.h"
#include "tools/lab/effects/effects_plan.h"
#include "tools/strata/options/choices.h"
#include "tools/strata/options/parse.h"
#include "tools/strata/table.h"

namespace strata::tools {

namespace {

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
                         .simd = scene.options.simd,
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
