// tools/lab/bench/bench.cpp - strata bench: measures the run time of algorithms, in every way of running them.
#include <cstdio>
#include <memory>

#include "peeling/registry.h"
#include "scenes/files/atomic_file.h"
#include "tools/lab/bench/bench_report.h"
#include "tools/lab/commands.h"
#include "tools/lab/effects/effects.h"
#include "tools/request/choices.h"
#include "tools/request/parse.h"
#include "tools/strata/messages.h"
#include "tools/strata/render/memory.h"
#include "tools/strata/table.h"

namespace strata::tools {

namespace {

// The command line. Each list is a dimension: every combination of its values is a job.
struct BenchOptions {
    RunOptions run;
    // Scenes by name or file, opened one after another.
    std::vector<std::string> scenes;
    std::vector<const peeling::Algorithm*> algorithms;
    std::vector<pipeline::Execution> executions{pipeline::Execution::replay};
    std::vector<Simd> simds{Simd::best};
    std::vector<pipeline::Effects> effects{pipeline::Effects::needed};
    Repetitions repetitions;
    std::string output, baseline;
    bool json = false, per_effect = false;
};

// All algorithms by name, and `depth`, which is not an algorithm: null.
std::vector<Choice<const peeling::Algorithm*>> job_names() {
    std::vector<Choice<const peeling::Algorithm*>> names{{"depth", nullptr}};
    for (const peeling::Algorithm& algorithm : peeling::algorithms()) names.push_back({algorithm.name, &algorithm});
    return names;
}

template <class T>
std::vector<T> values_of(const std::vector<Choice<T>>& choices) {
    std::vector<T> values;
    for (const auto& choice : choices) values.push_back(choice.value);
    return values;
}

// The ways of running are the innermost loop, so that the times to be compared are measured one right after another.
std::vector<BenchJob> jobs_of(const BenchOptions& options, const std::vector<BenchScene>& scenes) {
    std::vector<Simd> simds;
    for (Simd simd : options.simds) {
        check_simd(simd);
        if (simd == Simd::best) simd = available_simd().back();
        if (std::find(simds.begin(), simds.end(), simd) == simds.end()) simds.push_back(simd);
    }
    std::vector<BenchJob> jobs;
    for (const BenchScene& scene : scenes)
        for (const auto* algorithm : options.algorithms)
            for (const auto effects : options.effects)
                for (const auto simd : simds)
                    for (const auto execution : options.executions)
                        jobs.push_back({&scene, algorithm, execution, simd, effects});
    return jobs;
}

// Each scene has its own options and session, because --camera and --orbit give another view in each.
std::vector<BenchScene> open_scenes(const BenchOptions& options) {
    std::vector<BenchScene> scenes;
    for (const std::string& name : options.scenes) {
        BenchScene& scene = scenes.emplace_back(BenchScene{options.run, {}});
        scene.options.scene = name;
        scene.session = open_session(scene.options);
        for (const peeling::Algorithm* algorithm : options.algorithms)
            if (algorithm != nullptr) check_memory(scene.options, scene.session, *algorithm);
    }
    return scenes;
}

// 1 if a way of running changed a bit; 2 if every job was refused.
int exit_status(const std::vector<BenchResult>& results) {
    const auto wrong = differing(results);
    for (const std::string& name : wrong) say_error(name + ": the picture differs");
    if (!wrong.empty()) return 1;
    return std::all_of(results.begin(), results.end(), [](const BenchResult& r) { return r.is_refused(); }) ? 2 : 0;
}

// For one scene; of each list only the first value is used.
int show_effects_of(BenchOptions& options) {
    if (options.scenes.size() > 1) throw CLI::ValidationError("--per-effect takes one scene");
    if (!options.output.empty() || !options.baseline.empty())
        throw CLI::ValidationError("--per-effect goes with neither -o nor --baseline");
    std::erase(options.algorithms, nullptr);
    options.run.render.execution = options.executions.front();
    options.run.render.effects = options.effects.front();
    options.run.render.simd = options.simds.front();
    check_simd(options.run.render.simd);
    return show_effects(open_scenes(options).front(), options.repetitions.timed, options.json);
}

int bench(BenchOptions& options) {
    options.run.algorithms = options.algorithms;
    std::erase(options.run.algorithms, nullptr);  // the depth pass
    complete(options.run);
    check_outputs({{"-o", options.output, {".json"}}});
    if (options.per_effect) return show_effects_of(options);
    // The baseline is read first, so that a wrong file ends the command before any measurement.
    const Baseline baseline = options.baseline.empty() ? Baseline{} : load_baseline(options.baseline);
    const std::vector<BenchScene> scenes = open_scenes(options);
    const auto results = measure(jobs_of(options, scenes), options.repetitions);
    const std::string document =
        to_json(results, baseline).dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + '\n';
    if (!options.output.empty()) scenes::write_file(options.output, document);
    print(options.json ? document : to_table(results) + (options.baseline.empty() ? "" : to_ratios(results, baseline)));
    return exit_status(results);
}

}  // namespace

Command add_bench(CLI::App& root) {
    auto* app = add_lab_command(root, "bench");
    const auto options = std::make_shared<BenchOptions>();
    options->run.app = app;
    const auto names = job_names();
    options->algorithms = values_of(names);
    app->add_option("SCENE", options->scenes,
                    "one or more scenes: models' files (.gltf, .glb, .obj, .ply, .stl, .off), or built-in ones")
        ->required()
        ->type_name("...");
    add_options(*app, options->run, OptionGroup::reading);
    add_choices(
        *app, options->algorithms, "--algorithm", names, values_of(names),
        "algorithms, separated by commas, or depth for one opaque depth pass (default: all; with --per-effect: dual)");
    add_profile_option(*app, options->run.profile);
    for (const OptionGroup group : {OptionGroup::depth, OptionGroup::targets, OptionGroup::algorithm})
        add_options(*app, options->run, group);
    add_options(*app, options->run, OptionGroup::order);
    add_options(*app, options->run, OptionGroup::view);
    add_choices(*app, options->executions, "--execution", executions, values_of(executions),
                "ways of running (default replay)");
    add_choices(*app, options->simds, "--simd", simds, available_simd(), "instruction sets (default best)");
    add_choices(*app, options->effects, "--effects", effects, values_of(effects),
                "needed, all, or needed,all (default needed)");
    add_memory_option(*app, options->run);
    add_options(*app, options->run, OptionGroup::resources);
    add_option(*app, options->repetitions.timed,
               {"--repeat", "N", "runs of each job (default 5)", "a whole number from 1"}, to_positive);
    add_option(*app, options->repetitions.warm_up,
               {"--warm-up", "S", "how long a job runs before it is timed (default 0.3)", "seconds from 0 to 3600"},
               to_seconds);
    app->add_flag("--counters", options->repetitions.counters,
                  "also count the fragments and bytes of the passes, in a literal run of each job");
    app->add_flag("--per-effect", options->per_effect,
                  "which effects a run simulates, which pass asks for each, and what it costs, instead of times");
    add_path(*app, options->output,
             {"-o,--output", "FILE.json", "the times as JSON, next to the table", "a file name"});
    app->add_flag("--json", options->json, "one JSON document instead of the table");
    add_path(*app, options->baseline,
             {"--baseline", "FILE", "what -o or --json wrote before: also print old/new", "a file name"});
    app->footer(
        footer("  strata bench teapot --size 200x150 --algorithm depth,dual --execution all --repeat 3\n"
               "  strata bench volume-beam:slices=4 random:triangles=300 --size 64x64 --warm-up 0 --repeat 1 -o "
               "times.json\n"
               "  strata bench teapot --per-effect --size 200x150\n"));
    return {app, [app, options] {
                if (options->per_effect && app->count("--algorithm") == 0)
                    options->algorithms = {peeling::find_algorithm("dual")};
                return bench(*options);
            }};
}

}  // namespace strata::tools
