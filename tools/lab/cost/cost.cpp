// tools/lab/cost/cost.cpp - strata cost: measures the error of each choice against the scene's exact image, and its
// time.
//
// Rule     Rows: scenes/reference/reports.md 10.2. Times are only in timings.jsonl.
// Tests    tests/tools/lab/cost/cost_test.cpp
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "peeling/registry.h"
#include "peeling/truth/chain_list.h"
#include "tools/lab/bench/spread.h"
#include "tools/lab/commands.h"
#include "tools/lab/cost/cost_run.h"
#include "tools/lab/cost/cost_table.h"
#include "tools/lab/sweep/csv.h"
#include "tools/lab/sweep/sweep.h"
#include "tools/request/choices.h"
#include "tools/strata/render/memory.h"
#include "tools/strata/render/run.h"

namespace strata::tools {

namespace {

using nlohmann::ordered_json;

constexpr std::array cost_columns{"/cell",
                                  "/scene",
                                  "/knob",
                                  "/value",
                                  "/opened",
                                  "/outcome",
                                  "/max_difference",
                                  "/rmse",
                                  "/psnr",
                                  "/pixels_differ",
                                  "/ssim",
                                  "/sorted_rmse",
                                  "/order_errors",
                                  "/from_default",
                                  "/layers",
                                  "/geometry_passes",
                                  "/full_screen_passes",
                                  "/vertices",
                                  "/fragments",
                                  "/bytes",
                                  "/bytes_per_pixel",
                                  "/modelled_seconds",
                                  "/printed_seconds"};

template <class T>
[[nodiscard]] ordered_json or_null(const std::optional<T>& value) {
    return value ? ordered_json(*value) : ordered_json(nullptr);
}

[[nodiscard]] ordered_json to_json(const std::vector<double>& values) {
    if (values.empty()) return nullptr;
    const Spread spread = spread_of(values);
    return {
        {"median", spread.median}, {"least", spread.least}, {"greatest", spread.greatest}, {"rounds", values.size()}};
}

// The oracle is not a device's algorithm, sorting triangles is work of the CPU, and what programs read and write in
// buffers is not counted: the card's rates do not apply.
[[nodiscard]] bool runs_on_a_card(const peeling::Algorithm& algorithm) {
    const bool has_buffers =
        std::ranges::find(algorithm.features, pipeline::Feature::unordered_access) != algorithm.features.end();
    return !algorithm.is_oracle && !has_buffers && algorithm.order != peeling::ListOrder::back_to_front;
}

ordered_json cost_description(std::size_t number, const CostScene& scene, const CostCell& cell) {
    const peeling::ChainScene asked{scene.session.scene.list, scene.session.view, cell.profile, cell.options};
    const bool has_limit = cell.options.termination.rule == pipeline::TerminationRule::fixed;
    return {{"cell", number},
            {"scene", scene.name},
            {"width", cell.options.width},
            {"height", cell.options.height},
            {"profile", cell.profile.name},
            {"knob", cell.knob},
            {"value", cell.value},
            {"opened", cell.opened},
            {"algorithm", cell.algorithm->name},
            {"subpixel_bits", cell.profile.raster.subpixel_bits},
            {"depth_format", name_of(depth_formats, asked.depth().format)},
            {"depth_path", name_of(depth_paths(), asked.depth().path)},
            {"color_format", name_of(color_formats, asked.color_format())},
            {"average_count", name_of(count_formats, cell.options.average_count)},
            {"peels", has_limit ? cell.options.termination.passes : 0},
            {"execution", name_of(executions, cell.options.execution)},
            {"effects", name_of(effects, cell.options.effects)}};
}

ordered_json cost_line(std::size_t number, const CostScene& scene, const CostCell& cell, const CostResult& result) {
    ordered_json line = cost_description(number, scene, cell);
    const bool ran = result.refusal.empty(), is_drawn = ran && !cell.chain;
    const auto if_drawn = [&](const ordered_json& value) { return is_drawn ? value : ordered_json(nullptr); };
    const auto if_ran = [&](const ordered_json& value) { return ran ? value : ordered_json(nullptr); };
    line["outcome"] = ran ? "done" : "refused";
    line["refusal"] = result.refusal;
    line["max_difference"] = if_ran(result.error.max_difference);
    line["rmse"] = if_ran(result.error.rmse);
    line["psnr"] = or_null(result.error.psnr);
    line["pixels_differ"] = if_ran(result.error.pixels);
    line["ssim"] = if_ran(result.error.ssim);
    line["sorted_rmse"] = or_null(result.sorted_rmse);
    line["order_errors"] = or_null(result.order_errors);
    line["from_default"] = if_ran(result.from_default);
    line["layers"] = if_drawn(result.layers);
    line["geometry_passes"] = if_drawn(result.passes.geometry);
    line["full_screen_passes"] = if_drawn(result.passes.full_screen);
    line["vertices"] = if_drawn(result.work.vertices);
    line["fragments"] = if_drawn(result.work.fragments);
    line["bytes"] = if_drawn(result.work.bytes);
    line["bytes_per_pixel"] = if_drawn(result.bytes_per_pixel);
    line["modelled_seconds"] =
        is_drawn && runs_on_a_card(*cell.algorithm) ? ordered_json(result.modelled) : ordered_json(nullptr);
    line["printed_seconds"] = or_null(is_drawn ? printed_seconds(scene.name, cell.algorithm->name) : std::nullopt);
    return line;
}

ordered_json cost_timing(std::size_t number, const CostTimes& times) {
    return {{"cell", number},
            {"seconds", to_json(times.seconds)},
            {"default", to_json(times.ratios)},
            {"literal", to_json(times.literal)}};
}

// Errors and counts of all cells; null is an empty field.
std::string cost_csv(const Lines& lines) { return csv_of_columns({cost_columns.begin(), cost_columns.end()}, lines); }

struct CostOptions {
    RunOptions run;
    std::vector<std::string> scenes;
    std::vector<std::string> knobs = cost_knobs();
    CostTiming timing;
    Shard shard;
    bool dry_run = false;
};

const std::vector<Choice<CostClock>> cost_clocks{{"wall", CostClock::wall}, {"processor", CostClock::processor}};

// The opened scenes and their cells.
struct CostSweep {
    std::vector<CostScene> scenes;
    std::vector<CostCell> cells;
};

[[nodiscard]] std::string name_of_scene(const std::string& name) {
    return scenes::is_procedural(name) ? name : std::filesystem::path(name).filename().string();
}

// The simplest exact peel that the profile can run. It compares stored codes, so that every depth format has an effect.
[[nodiscard]] const peeling::Algorithm* default_algorithm(const pipeline::DeviceProfile& profile) {
    const peeling::Algorithm* const peel = peeling::find_algorithm("front_to_back");
    return peeling::refusal(*peel, profile) ? peeling::find_algorithm("depth_units") : peel;
}

[[nodiscard]] CostSweep planned(const CostOptions& options) {
    CostSweep sweep;
    for (const std::string& name : options.scenes) {
        RunOptions run = options.run;
        run.scene = name;
        CostScene& scene = sweep.scenes.emplace_back();
        scene.name = name_of_scene(name);
        for (std::size_t i = 0; i + 1 < sweep.scenes.size(); ++i)
            if (sweep.scenes[i].name == scene.name)
                throw CLI::ValidationError("SCENE", "'" + scene.name + "' is the name of two scenes");
        scene.session = open_session(run);
        scene.base = {.scene = sweep.scenes.size() - 1,
                      .profile = scene.session.profile,
                      .options = run.render,
                      .algorithm = default_algorithm(scene.session.profile)};
        for (const pipeline::Instance& instance : scene.session.scene.list.instances)
            scene.vertices += scene.session.scene.list.meshes[instance.mesh].positions.size();
        scene.base.layers = layers_of(scene.session, scene.base);
        const auto cells = cost_cells(scene.base, options.knobs);
        for (const CostCell& cell : cells) {
            run.render = cell.options;
            check_memory(run, scene.session, *cell.algorithm);
        }
        sweep.cells.insert(sweep.cells.end(), cells.begin(), cells.end());
    }
    return sweep;
}

[[nodiscard]] MeasuredRow measured(CostSweep& sweep, std::size_t number, const CostTiming& timing) {
    const auto start = std::chrono::steady_clock::now();
    const CostCell& cell = sweep.cells[number];
    CostScene& scene = sweep.scenes[cell.scene];
    // The truth is rendered once, when the first cell needs it.
    if (scene.truth.rgb.empty()) complete(scene);
    const CostResult result = run_cell(scene, cell);
    const bool is_timed = result.refusal.empty() && !cell.chain;
    const CostTimes times = is_timed ? time_cell(scene, cell, timing) : CostTimes{};
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
    return {
        .line = cost_line(number, scene, cell, result), .timing = cost_timing(number, times), .seconds = taken.count()};
}

[[nodiscard]] std::string summary(const Lines& lines, const Lines& timings, const std::string& folder) {
    return titled(to_text(ranked_table(lines, timings))) + '\n' + best_rows(lines, timings) +
           fmt::format(
               "RMSE in 1/255: from sorted, the error of the choice alone (against the A-buffer of the same device); "
               "from "
               "exact, with what the device rounds. ?: the rounds overlap those of the default, or are fewer than {}.\n"
               "Rows: {}/results.csv. Page with plots: tools/lab/cost/page.py {} -o FILE.md\n",
               least_runs, folder, folder);
}

[[nodiscard]] Sweep sweep_of(const CostOptions& options, CostSweep& cells) {
    const auto described = [&](std::size_t i) {
        return cost_description(i, cells.scenes[cells.cells[i].scene], cells.cells[i]);
    };
    return {.name = "cost",
            .rows = cells.cells.size(),
            .description = described,
            .measure = [&](std::size_t i) { return measured(cells, i, options.timing); },
            .csv = cost_csv,
            .summary = [folder = options.run.output](const Lines& lines,
                                                     const Lines& timings) { return summary(lines, timings, folder); },
            .timing_class =
                [&](std::size_t i) {
                    const CostCell& cell = cells.cells[i];
                    return fmt::format("{} {} {}", cell.scene, cell.chain.has_value(), cell.algorithm->name);
                }};
}

int cost(CostOptions& options) {
    if (options.run.output.empty() && !options.dry_run)
        throw CLI::ValidationError("-o is missing: the folder for the results");
    complete(options.run);
    CostSweep cells = planned(options);
    const Sweep sweep = sweep_of(options, cells);
    if (options.dry_run) return dry_run(sweep, options.shard), 0;
    return run_sweep(sweep, options.run.output, options.shard);
}

[[nodiscard]] std::vector<Choice<std::string>> knob_choices() {
    std::vector<Choice<std::string>> choices;
    for (const std::string& knob : cost_knobs()) choices.push_back({knob, knob});
    return choices;
}

}  // namespace

Command add_cost(CLI::App& root) {
    auto* app = add_lab_command(root, "cost");
    const auto options = std::make_shared<CostOptions>();
    options->run.render.width = options->run.render.height = 512;
    app->add_option("SCENE", options->scenes,
                    "one or more scenes: models' files (.gltf, .glb, .obj, .ply, .stl, .off), or built-in ones")
        ->required()
        ->type_name("...");
    add_options(*app, options->run, OptionGroup::reading);
    add_choices(*app, options->knobs, "--knob", knob_choices(), cost_knobs(),
                "knobs with commas between, or all (default all)");
    add_profile_option(*app, options->run.profile);
    add_options(*app, options->run, OptionGroup::view);
    add_memory_option(*app, options->run);
    add_options(*app, options->run, OptionGroup::resources);
    add_option(*app, options->timing.rounds,
               {"--repeat", "N",
                "rounds in which a cell is timed next to the default (default 5, and up to 25 while they last under 2 "
                "s: short "
                "runs vary most)",
                "a whole number from 1"},
               to_positive);
    add_choice(*app, options->timing.clock, "--clock", cost_clocks,
               "a time as a user waits, or what all threads took of the processor, which other processes hardly change "
               "(default wall)");
    add_path(*app, options->run.output,
             {"-o,--output", "FOLDER", "folder for results.jsonl, results.csv and timings.jsonl", "a folder"});
    add_shard_option(*app, options->shard);
    app->add_flag("--dry-run", options->dry_run, "print the rows and how long they would take, without measuring them");
    app->footer(
        footer("  strata cost teapot --size 64x48 --knob subpixel_bits,peels,chain --repeat 1 -o teapot-costs\n"
               "  strata cost random:seed=1,triangles=40 --size 32x24 --knob average_count --repeat 1 --dry-run\n"));
    return {app, [options] { return cost(*options); }};
}

}  // namespace strata::tools
