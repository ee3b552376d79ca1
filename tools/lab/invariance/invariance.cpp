// tools/lab/invariance/invariance.cpp - strata invariance: measures the effect on a peel of two depths that should be
// equal but are computed differently, and of each remedy.
#include <fmt/format.h>

#include <chrono>
#include <filesystem>
#include <memory>

#include "scenes/files/text_file.h"
#include "tools/lab/commands.h"
#include "tools/lab/invariance/invariance_cell.h"
#include "tools/lab/invariance/invariance_images.h"
#include "tools/lab/invariance/invariance_row.h"
#include "tools/lab/invariance/invariance_summary.h"
#include "tools/lab/sweep/sweep.h"
#include "tools/strata/options/choices.h"
#include "tools/strata/options/options.h"
#include "tools/strata/render/run.h"
#include "tools/strata/report/plain_page.h"

namespace strata::tools {

namespace {

// The command line. `keys` are the options that are keys of a plan. Of `run` the scene and its reading options, the
// resources and the output folder are used.
struct InvarianceOptions {
    RunOptions run;
    KeyValues keys;
    std::string plan, report;
    Shard shard;
    int merge = 0;
    bool dry_run = false, images = true, hypotheses = false;
};

// depth_format becomes --depth-format.
std::string option_of(const PlanKey& key) {
    std::string name = "--" + key.name;
    std::replace(name.begin() + 2, name.end(), '_', '-');
    return name;
}

// Declares the option of a key. Each value is tried on a temporary cell; the real cells are set when the plan is
// expanded.
void add_key(CLI::App& app, InvarianceOptions& options, const PlanKey& key) {
    const auto fill = [&options, key](const std::string& given) {
        const auto values = key.is_list ? split(given, ',') : std::vector{given};
        for (const std::string& value : values) {
            Cell cell;
            if (!key.set(cell, value))
                throw CLI::ValidationError(option_of(key), "expected " + key.expected + ", found '" + value + "'");
        }
        options.keys[key.name] = values;
    };
    const std::string help = key.help + " (default " + key.fallback + ")";
    app.add_option_function<std::string>(option_of(key), fill, help)
        ->type_name(key.is_list ? "VALUE[,VALUE...]" : "VALUE");
}

// Throws CLI::ValidationError for mutually exclusive options.
void check_usage(const InvarianceOptions& options) {
    if (options.run.output.empty() && !options.dry_run)
        throw CLI::ValidationError("-o is missing: the folder for the results");
    if (options.merge > 0 && options.shard.count > 1) throw CLI::ValidationError("--merge excludes --shard");
}

std::vector<Cell> all_cells(const InvarianceOptions& options, CellRunner& runner) {
    const auto cells = options.plan.empty()
                           ? cells_of(options.keys)
                           : parse_plan(scenes::read_text_file(options.plan), options.plan, options.keys);
    return runner.expanded(cells);
}

MeasuredCell measured(std::size_t number, const Cell& cell, CellRunner& runner, const std::string& image_folder) {
    const auto start = std::chrono::steady_clock::now();
    const CellResult result = runner.run(cell);
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
    if (!image_folder.empty()) write_cell_images(image_folder, number, result);
    return {.line = to_line(number, cell, result),
            .timing = {{"cell", number}, {"seconds", taken.count()}, {"peel_seconds", result.measured.seconds}},
            .seconds = taken.count()};
}

// `cells` and `runner` must outlive the result.
Work work_of(const InvarianceOptions& options, const std::vector<Cell>& cells, CellRunner& runner) {
    const auto described = [&](std::size_t i) { return description(i, cells[i], runner.view(cells[i])); };
    const std::string folder = options.run.output;
    return {.name = "invariance",
            .cells = cells.size(),
            .description = described,
            .keys = line_keys(),
            .measure = [&, image_folder = options.images && !options.dry_run ? folder : ""](
                           std::size_t i) { return measured(i, cells[i], runner, image_folder); },
            .csv = csv_of,
            .summary = [folder](const Lines& lines) { return summary(lines, folder); },
            .timing_class =
                [described](std::size_t i) {
                    const nlohmann::ordered_json line = described(i);
                    return json_text({line["scene"], line["width"], line["height"], line["algorithm"]});
                }};
}

// "images/0003.errors.png" is of the cell with number 3.
std::string caption_of(const std::string& name, const Lines& lines) {
    const std::string file = std::filesystem::path(name).filename().string();
    const auto number = to_int<std::size_t>(std::string_view(file).substr(0, file.find('.')));
    if (!number || *number >= lines.size()) return name;
    const std::string label = label_of(lines[*number], knobs_of(lines, Knobs::varying));
    if (file.ends_with(".difference.png")) return label + ": four times its difference from the exact picture";
    if (file.ends_with(".errors.png"))
        return label + ": its errors, where red is composited twice, blue lost, magenta both";
    return label + ": its picture";
}

int invariance(InvarianceOptions& options) {
    check_usage(options);
    check_outputs({{"--report", options.report, {".html"}}});
    if (!options.run.scene.empty()) options.keys["scene"] = {options.run.scene};
    if (options.hypotheses) options.keys["hypothesis"] = {"all"};
    CellRunner runner(options.run.scene_options, options.run.render);
    const std::vector<Cell> cells = all_cells(options, runner);
    for (const Cell& cell : cells) runner.check(cell);
    Work work = work_of(options, cells, runner);
    work.report = options.report;
    work.findings = [](const Lines& lines) {
        return Findings{summary_text(lines),
                        summary_table(lines),
                        "A row a cell: what varies, and what was found",
                        {same_everywhere(lines)}};
    };
    work.caption = caption_of;
    if (options.dry_run) return dry_run(work, options.shard), 0;
    const std::string& folder = options.run.output;
    if (options.merge > 0) return merge_shards(work, folder, static_cast<std::size_t>(options.merge));
    return run_sweep(work, folder, options.shard);
}

void add_sweep_options(CLI::App& app, InvarianceOptions& options) {
    add_path(app, options.plan, {"--plan", "FILE", "a JSON plan of cells (tools/invariance/README.md)", "a file name"});
    add_path(app, options.run.output,
             {"-o,--output", "FOLDER", "a folder: results.jsonl, results.csv, timings.jsonl, images/", "a folder"});
    add_report_option(app, options.report);
    add_option(app, options.shard,
               {"--shard", "I/N", "only the cells I, I + N, ... (from 1)", "I/N with I from 1 to N"}, to_shard);
    add_option(app, options.merge, {"--merge", "N", "put the results of N shards together", "a whole number from 1"},
               to_positive);
    app.add_flag("--hypotheses", options.hypotheses, "every hypothesis about the device: the same as --hypothesis all");
    app.add_flag("--dry-run", options.dry_run, "print the cells and how long they would take");
    app.add_flag_callback(
        "--no-images", [&options] { options.images = false; }, "no pictures of cells with errors");
}

}  // namespace

Command add_invariance(CLI::App& root) {
    auto* app = add_lab_command(root, "invariance");
    const auto options = std::make_shared<InvarianceOptions>();
    app->add_option("SCENE", options->run.scene,
                    "a model's file (.gltf, .glb, .obj, .ply, .stl, .off), or a built-in scene (strata list scenes)")
        ->type_name("");
    add_reading_options(*app, options->run.scene_options);
    for (const PlanKey& key : plan_keys())
        if (key.name != "scene") add_key(*app, *options, key);
    add_sweep_options(*app, *options);
    add_resource_options(*app, options->run);
    app->footer(
        footer("  strata invariance teapot --size 64x48 --profile ideal --algorithm front_to_back --pair "
               "float32:perspective_rq "
               "--depth-format d24 --remedy none,epsilon:1ulp -o results\n"
               "  strata invariance planes:gap=8 --size 64x48 --remedy none,bias:4 --dry-run\n"));
    return {app, [options] { return invariance(*options); }};
}

}  // namespace strata::tools
