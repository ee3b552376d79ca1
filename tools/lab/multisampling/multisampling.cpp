// tools/lab/multisampling/multisampling.cpp - strata multisampling: counts what peels lose at the samples of a pixel,
// by where programs run and what they load.
#include <fmt/format.h>

#include <array>
#include <chrono>
#include <memory>
#include <nlohmann/json.hpp>

#include "peeling/registry.h"
#include "peeling/sample_hazard.h"
#include "tools/lab/commands.h"
#include "tools/lab/sweep/csv.h"
#include "tools/lab/sweep/sweep.h"
#include "tools/request/choices.h"
#include "tools/strata/options/option.h"
#include "tools/strata/options/options.h"
#include "tools/strata/render/memory.h"
#include "tools/strata/render/run.h"
#include "tools/strata/table.h"

namespace strata::tools {

namespace {

using nlohmann::ordered_json;
using pipeline::LoadedSample;
using rasterizer::Interpolation;

struct MultisamplingOptions {
    RunOptions run;
    std::vector<std::string> scenes;
    Shard shard;
    bool json = false;
};

// One way in which a port may draw.
struct Port {
    Interpolation interpolation = Interpolation::sample;
    LoadedSample loads = LoadedSample::own;
};
constexpr std::array ports{Port{},
                           Port{Interpolation::sample, LoadedSample::zero},
                           Port{Interpolation::sample, LoadedSample::resolved},
                           Port{Interpolation::centre, LoadedSample::own},
                           Port{Interpolation::centre, LoadedSample::zero},
                           Port{Interpolation::centre, LoadedSample::resolved},
                           Port{Interpolation::centroid, LoadedSample::own}};

std::string shading_of(const Port& port) {
    return port.interpolation == Interpolation::sample ? "sample" : name_of(interpolations, port.interpolation);
}

// The rows in the order scene, algorithm, port; the last changes fastest. A scene is opened for its first row.
struct HazardSweep {
    const MultisamplingOptions& options;
    std::size_t opened = 0;  // the number of the session's scene, from 1
    Session session{};

    [[nodiscard]] std::size_t rows() const {
        return options.scenes.size() * options.run.algorithms.size() * ports.size();
    }
    [[nodiscard]] ordered_json description(std::size_t row) const;
    [[nodiscard]] MeasuredRow measure(std::size_t row);
};

ordered_json HazardSweep::description(std::size_t row) const {
    const auto& algorithms = options.run.algorithms;
    const Port& port = ports[row % ports.size()];
    return {{"scene", options.scenes[row / ports.size() / algorithms.size()]},
            {"algorithm", algorithms[row / ports.size() % algorithms.size()]->name},
            {"programs_at", shading_of(port)},
            {"load", name_of(loaded_samples, port.loads)}};
}

MeasuredRow HazardSweep::measure(std::size_t row) {
    const auto start = std::chrono::steady_clock::now();
    const auto& algorithms = options.run.algorithms;
    const std::size_t scene = row / ports.size() / algorithms.size();
    RunOptions run = options.run;
    run.scene = options.scenes[scene];
    if (opened != scene + 1) session = open_session(run);
    opened = scene + 1;
    const peeling::Algorithm& algorithm = *algorithms[row / ports.size() % algorithms.size()];
    check_memory(run, session, algorithm);
    const Port& port = ports[row % ports.size()];
    run.render.raster.interpolation = port.interpolation;
    run.render.sampling = {.samples = run.sampling.samples, .loads = port.loads};
    const peeling::SampleHazard h = peeling::measure_samples(session.request(run.render), algorithm);
    ordered_json line = description(row);
    line.update({{"outcome", h.refusal ? "refused" : "done"},
                 {"refusal", h.refusal ? h.refusal->feature : ""},
                 {"layers", h.layers},
                 {"lost", h.lost},
                 {"doubled", h.doubled},
                 {"misplaced", h.misplaced},
                 {"samples", h.samples},
                 {"at_silhouettes", h.at_silhouettes},
                 {"at_inner_edges", h.at_inner_edges},
                 {"inside", h.inside},
                 {"passes", h.passes},
                 {"ended", h.ended},
                 {"programs", h.programs}});
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
    return {.line = line, .timing = {{"row", row}, {"seconds", taken.count()}}, .seconds = taken.count()};
}

// The column's title and the key of its values.
constexpr std::array<std::array<const char*, 2>, 12> shown_columns{{{"scene", "scene"},
                                                                    {"algorithm", "algorithm"},
                                                                    {"programs at", "programs_at"},
                                                                    {"load", "load"},
                                                                    {"layers", "layers"},
                                                                    {"lost", "lost"},
                                                                    {"doubled", "doubled"},
                                                                    {"misplaced", "misplaced"},
                                                                    {"silhouette", "at_silhouettes"},
                                                                    {"inner edge", "at_inner_edges"},
                                                                    {"inside", "inside"},
                                                                    {"programs", "programs"}}};

std::string to_table(const Lines& lines) {
    Table table;
    for (const auto& [title, key] : shown_columns)
        table.columns.push_back({title, table.columns.size() < 4 ? Align::left : Align::right});
    table.columns.push_back({"passes", Align::right});
    for (const ordered_json& line : lines) {
        if (line["outcome"] == "refused") continue;
        std::vector<std::string> row;
        for (const auto& [title, key] : shown_columns)
            row.push_back(line[key].is_string() ? line[key].get<std::string>() : line[key].dump());
        row.push_back(line["passes"].dump() + (line["ended"].get<bool>() ? "" : ", no end"));
        table.rows.push_back(std::move(row));
    }
    return titled(to_text(table));
}

std::string to_csv(const Lines& lines) {
    std::vector<std::string> pointers;
    for (const auto& [title, key] : shown_columns) pointers.push_back(std::string("/") + key);
    for (const char* key : {"/passes", "/ended", "/outcome", "/refusal"}) pointers.emplace_back(key);
    return csv_of_columns(pointers, lines);
}

int multisampling(MultisamplingOptions& options) {
    if (options.run.sampling.samples == 1) throw CLI::ValidationError("--samples", "expected 2, 4 or 8, found 1");
    if (options.shard.count > 1 && options.run.output.empty()) throw CLI::ValidationError("--shard needs -o");
    complete(options.run);
    HazardSweep rows{options};
    const auto summary = [json = options.json](const Lines& lines, const Lines&) {
        return json ? ordered_json(lines).dump(2, ' ', false, ordered_json::error_handler_t::replace) + '\n'
                    : to_table(lines);
    };
    const Sweep sweep{.name = "multisampling",
                      .rows = rows.rows(),
                      .description = [&](std::size_t row) { return rows.description(row); },
                      .measure = [&](std::size_t row) { return rows.measure(row); },
                      .csv = to_csv,
                      .summary = summary,
                      .timing_class = [&](std::size_t row) { return json_text(rows.description(row)); }};
    return run_sweep(sweep, options.run.output, options.shard);
}

}  // namespace

Command add_multisampling(CLI::App& root) {
    auto* app = add_lab_command(root, "multisampling");
    const auto options = std::make_shared<MultisamplingOptions>();
    options->run.app = app;
    options->scenes = {"teapot", "planes", "volume-beam:slices=8", "random:triangles=200", "showroom"};
    options->run.default_algorithm = "front_to_back,dual,dual_independent,depth_units";
    options->run.profile = "ideal";
    options->run.sampling.samples = 4;
    options->run.render.width = 64, options->run.render.height = 48;
    options->run.render.alpha = 0.5f;
    app->add_option("SCENE", options->scenes,
                    "scenes: models' files, or built-in ones (default teapot planes volume-beam:slices=8 "
                    "random:triangles=200 showroom)")
        ->type_name("...");
    add_options(*app, options->run, OptionGroup::reading);
    app->add_option_function<std::string>(
           "--algorithm",
           [options](const std::string& text) {
               for (const std::string& name : split(text, ',')) options->run.algorithms.push_back(to_algorithm(name));
           },
           "algorithms with commas between (default " + options->run.default_algorithm + ")")
        ->type_name("NAME[,NAME...]");
    add_option_of_table(*app, options->run, "samples")->description("samples per pixel, 2, 4 or 8 (default 4)");
    add_profile_option(*app, options->run.profile);
    for (const OptionGroup group : {OptionGroup::depth, OptionGroup::targets, OptionGroup::algorithm})
        add_options(*app, options->run, group);
    add_options(*app, options->run, OptionGroup::view);
    add_path(*app, options->run.output,
             {"-o,--output", "FOLDER", "folder for results.jsonl, results.csv and timings.jsonl", "a folder"});
    add_shard_option(*app, options->shard);
    add_memory_option(*app, options->run);
    app->add_flag("--json", options->json, "one JSON document instead of the table");
    app->footer(
        footer("  strata multisampling\n"
               "  strata multisampling teapot --size 32x24 --algorithm front_to_back\n"));
    return {app, [options] { return multisampling(*options); }};
}

}  // namespace strata::tools
