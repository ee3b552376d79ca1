// tools/lab/invariance/multisampling.cpp - strata multisampling: counts what peels lose at the samples of a pixel, by
// where programs run and what they load.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <memory>
#include <nlohmann/json.hpp>

#include "peeling/registry.h"
#include "peeling/sample_hazard.h"
#include "tools/lab/commands.h"
#include "tools/strata/options/choices.h"
#include "tools/strata/options/option.h"
#include "tools/strata/options/options.h"
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

struct MultisamplingRow {
    std::string scene, algorithm;
    Port port;
    peeling::SampleHazard hazard;
};

std::vector<MultisamplingRow> rows_of(const MultisamplingOptions& options, const std::string& scene) {
    RunOptions run = options.run;
    run.scene = scene;
    const Session session = open_session(run);
    std::vector<MultisamplingRow> rows;
    for (const peeling::Algorithm* algorithm : run.algorithms)
        for (const Port& port : ports) {
            peeling::RenderOptions render = run.render;
            render.raster.interpolation = port.interpolation;
            rows.push_back({scene, algorithm->name, port,
                            peeling::measure_samples(session.scene.list, session.view, session.profile, render,
                                                     *algorithm, {.samples = run.samples, .loads = port.loads})});
        }
    return rows;
}

std::string to_table(const std::vector<MultisamplingRow>& rows) {
    Table table{{{"scene"},
                 {"algorithm"},
                 {"programs at"},
                 {"load"},
                 {"layers", Align::right},
                 {"lost", Align::right},
                 {"doubled", Align::right},
                 {"misplaced", Align::right},
                 {"silhouette", Align::right},
                 {"inner edge", Align::right},
                 {"inside", Align::right},
                 {"passes", Align::right},
                 {"programs", Align::right}},
                {}};
    for (const auto& [scene, algorithm, port, h] : rows) {
        if (h.refusal) continue;
        const auto text = [](std::uint64_t n) { return fmt::format("{}", n); };
        table.rows.push_back({scene, algorithm, shading_of(port), name_of(loaded_samples, port.loads), text(h.layers),
                              text(h.lost), text(h.doubled), text(h.misplaced), text(h.at_silhouettes),
                              text(h.at_inner_edges), text(h.inside),
                              fmt::format("{}{}", h.passes, h.ended ? "" : ", no end"), text(h.programs)});
    }
    return to_text(table);
}

std::string to_json(const std::vector<MultisamplingRow>& rows) {
    ordered_json documents = ordered_json::array();
    for (const auto& [scene, algorithm, port, h] : rows)
        documents.push_back({{"scene", scene},
                             {"algorithm", algorithm},
                             {"programs_at", shading_of(port)},
                             {"load", name_of(loaded_samples, port.loads)},
                             {"refusal", h.refusal ? ordered_json(h.refusal->feature) : ordered_json(nullptr)},
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
    return documents.dump(2, ' ', false, ordered_json::error_handler_t::replace) + '\n';
}

int multisampling(MultisamplingOptions& options) {
    if (options.run.samples == 1) throw CLI::ValidationError("--samples", "expected 2, 4 or 8, found 1");
    complete(options.run);
    std::vector<MultisamplingRow> rows;
    for (const std::string& scene : options.scenes) {
        std::vector<MultisamplingRow> more = rows_of(options, scene);
        std::move(more.begin(), more.end(), std::back_inserter(rows));
    }
    print(options.json ? to_json(rows) : titled(to_table(rows)));
    const bool is_any = std::ranges::any_of(rows, [](const MultisamplingRow& row) { return !row.hazard.refusal; });
    return is_any ? 0 : 2;
}

}  // namespace

Command add_multisampling(CLI::App& root) {
    auto* app = add_lab_command(root, "multisampling");
    const auto options = std::make_shared<MultisamplingOptions>();
    options->scenes = {"teapot", "planes", "volume-beam:slices=8", "random:triangles=200", "showroom"};
    options->run.default_algorithm = "front_to_back,dual,dual_independent,depth_units";
    options->run.profile = "ideal";
    options->run.samples = 4;
    options->run.render.width = 64, options->run.render.height = 48;
    options->run.render.alpha = 0.5f;
    app->add_option("SCENE", options->scenes,
                    "scenes: models' files, or built-in ones (default teapot planes volume-beam:slices=8 "
                    "random:triangles=200 showroom)")
        ->type_name("...");
    add_reading_options(*app, options->run.scene_options);
    app->add_option_function<std::string>(
           "--algorithm",
           [options](const std::string& text) {
               for (const std::string& name : split(text, ',')) options->run.algorithms.push_back(to_algorithm(name));
           },
           "algorithms with commas between (default " + options->run.default_algorithm + ")")
        ->type_name("NAME[,NAME...]");
    add_choice(*app, options->run.samples, "--samples", sample_counts, "samples per pixel, 2, 4 or 8 (default 4)");
    add_profile_option(*app, options->run.profile);
    add_machine_options(*app, options->run);
    add_view_options(*app, options->run);
    app->add_flag("--json", options->json, "one JSON document instead of the table");
    app->footer(
        footer("  strata multisampling\n"
               "  strata multisampling teapot --size 32x24 --algorithm front_to_back\n"));
    return {app, [options] { return multisampling(*options); }};
}

}  // namespace strata::tools
