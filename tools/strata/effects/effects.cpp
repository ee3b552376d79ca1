// tools/strata/effects/effects.cpp - strata effects: what a run simulates and why, what it costs, what leaving the
// rest out saved.
#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "tools/strata/command.h"
#include "tools/strata/effects/effects_costs.h"
#include "tools/strata/effects/effects_plan.h"
#include "tools/strata/options/choices.h"
#include "tools/strata/options/parse.h"
#include "tools/strata/table.h"

namespace strata::tools {

namespace {

using nlohmann::ordered_json;

struct EffectsOptions {
    BenchScene scene;
    int repeat = 3;
    bool json = false;
};

// The answer of the command for one algorithm.
struct Explained {
    const peeling::Algorithm* algorithm = nullptr;
    std::string refusal;  // empty: it ran
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
                                       {"seconds", row.seconds ? ordered_json(*row.seconds) : ordered_json(nullptr)}});
    const auto& t = e.plan.tiles;
    document["tiles"] = {{"all", t.tiles},     {"empty", t.empty},     {"opaque_only", t.opaque_only},
                         {"single", t.single}, {"layered", t.layered}, {"with_opaque", t.with_opaque}};
    document["seconds"] = {{"needed", e.times.needed}, {"all", e.times.all}, {"as_asked", e.times.as_asked}};
    return document;
}

// Simulated effects first, then those left out.
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
                                      row.fragments > 0 ? fmt::format("{}", row.fragments) : "-",
                                      row.seconds ? fmt::format("{:.2f}", *row.seconds * 1e3) : "-", row.why});
    const auto& t = e.plan.tiles;
    std::string text = to_text(table);
    const peeling::ListOrder order = e.algorithm->order;
    if (order == peeling::ListOrder::sets || order == peeling::ListOrder::objects)
        text += "fragments: as if every pass drew the whole list; a pass over a part of it draws fewer\n";
    text +=
        "ms: what an effect costs in the whole run, or what leaving it out saves; each pass rasterizes, medians of "
        "runs in turn\n";
    text += fmt::format(
        "{} tiles: {} empty, {} with opaque fragments alone, {} with one transparent fragment a pixel at most, {} that "
        "need peeling; {} need opaque priming\n",
        t.tiles, t.empty, t.opaque_only, t.single, t.layered, t.with_opaque);
    text += fmt::format("needed {:.2f} ms, all {:.2f} ms: leaving the others out makes it {:.2f} times as fast\n",
                        e.times.needed * 1e3, e.times.all * 1e3, e.times.all / e.times.needed);
    if (scene.options.render.execution == pipeline::Execution::replay)
        text += fmt::format("replay {:.2f} ms: rasterizing once makes it {:.2f} times as fast\n",
                            e.times.as_asked * 1e3, e.times.needed / e.times.as_asked);
    return text;
}

int explain_all(EffectsOptions& options) {
    complete(options.scene.options);
    options.scene.session = open_session(options.scene.options);
    ordered_json documents = ordered_json::array();
    std::string text;
    bool any = false;
    for (const peeling::Algorithm* algorithm : options.scene.options.algorithms) {
        const Explained explained = explain(options.scene, *algorithm, options.repeat);
        any |= explained.refusal.empty();
        documents.push_back(to_json(explained, options.scene));
        text += (text.empty() ? "" : "\n") + to_text(explained, options.scene);
    }
    print(options.json ? documents.dump(2, ' ', false, ordered_json::error_handler_t::replace) + '\n' : text);
    return any ? 0 : 2;
}

}  // namespace

Command add_effects(CLI::App& root) {
    auto* app =
        root.add_subcommand("effects", "tell which effects a run simulates, who calls for them, what they cost");
    const auto options = std::make_shared<EffectsOptions>();
    add_picture_options(*app, options->scene.options);
    add_execution_options(*app, options->scene.options);
    add_option(*app, options->repeat, {"--repeat", "N", "runs of each timing (default 3)", "a whole number from 1"},
               to_positive);
    app->add_flag("--json", options->json, "one JSON document instead of the tables");
    app->footer(
        footer("  strata effects teapot --size 200x150\n"
               "  strata effects volume-beam:slices=4 --algorithm dual,weighted_average --size 64x64 --json\n"));
    return {app, [options] { return explain_all(*options); }};
}

}  // namespace strata::tools
