// tools/lab/cost/cost.cpp - strata cost: measures the error of each choice against the scene's exact image, and its
// time.
#include <fmt/format.h>

#include <chrono>
#include <filesystem>
#include <memory>

#include "scenes/files/atomic_file.h"
#include "tools/lab/commands.h"
#include "tools/lab/cost/cost_report.h"
#include "tools/lab/cost/cost_row.h"
#include "tools/lab/cost/cost_run.h"
#include "tools/lab/sweep/sweep.h"
#include "tools/strata/options/choices.h"
#include "tools/strata/render/run.h"
#include "tools/strata/report/plain_page.h"

namespace strata::tools {

namespace {

struct CostOptions {
    RunOptions run;
    std::vector<std::string> scenes;
    std::vector<std::string> knobs = cost_knobs();
    CostTiming timing;
    std::string report;
    Shard shard;
    int merge = 0;
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
        sweep.cells.insert(sweep.cells.end(), cells.begin(), cells.end());
    }
    return sweep;
}

[[nodiscard]] MeasuredCell measured(CostSweep& sweep, std::size_t number, const CostTiming& timing) {
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

// Writes the table, the sentences and the plots; returns the text to print.
[[nodiscard]] std::string report(const Lines& lines, const std::string& folder) {
    const auto in_folder = [&](const std::string& name) { return (std::filesystem::path(folder) / name).string(); };
    const auto rows = cost_rows(lines, read_journal(in_folder("timings.jsonl")).lines);
    scenes::write_file(in_folder("cost.csv"), table_csv(rows));
    std::string descriptions, told;
    for (const std::string& message : descriptions_of(rows)) descriptions += message + '\n';
    scenes::write_file(in_folder("sentences.txt"), descriptions);
    std::string scene;
    for (const CostRow& row : rows) {
        if (row.scene == scene) continue;
        scene = row.scene;
        for (const char* column : {"default", "literal", "modelled"}) {
            const auto points = points_of(rows, scene, column);
            if (points.empty()) continue;
            std::string name = fmt::format("frontier.{}.{}.svg", scene, column);
            std::replace_if(
                name.begin(), name.end(), [](char c) { return c == ':' || c == ',' || c == '='; }, '-');
            scenes::write_file(in_folder(name), frontier_svg(points, fmt::format("{}, {} time", scene, column),
                                                             "time, ratio to the cheapest cell"));
            told +=
                fmt::format("{}: {} of {} cells on the frontier\n", name, frontier_of(points).size(), points.size());
        }
    }
    return descriptions + told +
           fmt::format("All of it: {0}/cost.csv, {0}/sentences.txt, {0}/results.csv and {0}/results.jsonl\n", folder);
}

[[nodiscard]] Work work_of(const CostOptions& options, CostSweep& sweep) {
    const auto described = [&](std::size_t i) {
        return cost_description(i, sweep.scenes[sweep.cells[i].scene], sweep.cells[i]);
    };
    return {.name = "cost",
            .cells = sweep.cells.size(),
            .description = described,
            .keys = cost_keys(),
            .measure = [&](std::size_t i) { return measured(sweep, i, options.timing); },
            .csv = cost_csv,
            .summary = [folder = options.run.output](const Lines& lines) { return report(lines, folder); },
            .timing_class =
                [&](std::size_t i) {
                    const CostCell& cell = sweep.cells[i];
                    return fmt::format("{} {} {}", cell.scene, cell.chain.has_value(), cell.algorithm->name);
                }};
}

// The text of the page of --report; `folder` contains the times.
[[nodiscard]] Findings findings(const Lines& lines, const std::string& folder) {
    const auto rows = cost_rows(lines, read_journal((std::filesystem::path(folder) / "timings.jsonl").string()).lines);
    return {summary_text(rows), choice_table(rows), "Each choice next to the default", {}};
}

// "frontier.teapot.default.svg".
[[nodiscard]] std::string caption_of(const std::string& name, const Lines&) {
    const auto parts = split(name, '.');
    const std::string& column = parts.at(parts.size() - 2);
    return fmt::format("Error over time on {}, {}: the line joins the choices that no other beats in both",
                       name.substr(9, name.size() - column.size() - 14),
                       column == "default"   ? "as it runs by default"
                       : column == "literal" ? "every pass rasterized"
                                             : "as the card's rates would have it");
}

int cost(CostOptions& options) {
    if (options.run.output.empty() && !options.dry_run)
        throw CLI::ValidationError("-o is missing: the folder for the results");
    if (options.merge > 0 && options.shard.count > 1) throw CLI::ValidationError("--merge excludes --shard");
    check_outputs({{"--report", options.report, {".html"}}});
    complete(options.run);
    CostSweep sweep = planned(options);
    Work work = work_of(options, sweep);
    work.report = options.report;
    work.findings = [folder = options.run.output](const Lines& lines) { return findings(lines, folder); };
    work.caption = caption_of;
    if (options.dry_run) return dry_run(work, options.shard), 0;
    const std::string& folder = options.run.output;
    if (options.merge > 0) return merge_shards(work, folder, static_cast<std::size_t>(options.merge));
    return run_sweep(work, folder, options.shard);
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
    add_reading_options(*app, options->run.scene_options);
    add_choices(*app, options->knobs, "--knob", knob_choices(), cost_knobs(),
                "knobs with commas between, or all (default all)");
    add_profile_option(*app, options->run.profile);
    add_view_options(*app, options->run);
    add_resource_options(*app, options->run);
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
    add_path(
        *app, options->run.output,
        {"-o,--output", "FOLDER",
         "a folder: results.jsonl, results.csv, timings.jsonl, cost.csv, sentences.txt, frontier.*.svg", "a folder"});
    add_report_option(*app, options->report);
    add_option(*app, options->shard,
               {"--shard", "I/N", "only the cells I, I + N, ... (from 1)", "I/N with I from 1 to N"}, to_shard);
    add_option(*app, options->merge, {"--merge", "N", "put the results of N shards together", "a whole number from 1"},
               to_positive);
    app->add_flag("--dry-run", options->dry_run, "print the cells and how long they would take");
    app->footer(
        footer("  strata cost teapot --size 64x48 --knob subpixel_bits,peels,chain --repeat 1 -o teapot-costs\n"
               "  strata cost random:seed=1,triangles=40 --size 32x24 --knob average_count --repeat 1 --dry-run\n"));
    return {app, [options] { return cost(*options); }};
}

}  // namespace strata::tools
