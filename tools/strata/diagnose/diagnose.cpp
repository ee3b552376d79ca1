// tools/strata/diagnose/diagnose.cpp - strata diagnose: which known mistake made a picture.
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "peeling/algorithms/algorithm.h"
#include "rasterizer/base/input_error.h"
#include "scenes/packs/pack_scene.h"
#include "tools/oracle/drawings.h"
#include "tools/oracle/mistakes/diagnosis_report.h"
#include "tools/oracle/pack/pack_pictures.h"
#include "tools/strata/command.h"
#include "tools/strata/options/option.h"
#include "tools/strata/progress.h"
#include "tools/strata/render/run.h"
#include "tools/strata/report/plain_page.h"
#include "tools/strata/table.h"
#include "tools/strata/tolerances.h"

namespace strata::tools {

namespace {

struct DiagnoseOptions {
    RunOptions run;
    std::string candidate;
    std::optional<oracle::RawLayout> layout{};
    oracle::Tolerances tolerances{};
    int limit = 0;  // geometry passes after which the candidate gives up
    std::string report;
    bool json = false;
};

bool has_depth(const oracle::Picture& picture) {
    return std::ranges::find(picture.targets, oracle::Meaning::depth, &oracle::Target::meaning) !=
           picture.targets.end();
}

// A pack's own algorithm, if the user names none.
void choose_algorithm(RunOptions& run) {
    if (!run.algorithms.empty() || scenes::is_procedural(run.scene) || !scenes::is_pack(run.scene)) return;
    const nlohmann::json manifest = scenes::read_manifest(scenes::pack_folder(run.scene));
    const nlohmann::json& results = manifest.at("results");
    if (!results.empty()) run.default_algorithm = results[0].at("algorithm").get<std::string>();
}

// The picture in a candidate's folder, or in another pack's.
oracle::Picture read_candidate(const DiagnoseOptions& options, const std::string& algorithm) {
    namespace fs = std::filesystem;
    if (!fs::is_directory(options.candidate)) return oracle::read_picture(options.candidate, options.layout);
    for (const fs::path& folder : {fs::path(options.candidate), fs::path(options.candidate) / "expected"})
        if (const fs::path picture = folder / algorithm / "picture.npy"; fs::exists(picture))
            return oracle::read_picture(picture.string());
    throw InputError(options.candidate, "files", "a picture of " + algorithm + ", " + algorithm + "/picture.npy",
                     "none");
}

// The passes in a candidate's folder, or another pack's: empty unless the scene is a pack.
std::vector<oracle::PassPicture> read_passes(const DiagnoseOptions& options, const std::string& algorithm) {
    if (!std::filesystem::is_directory(options.candidate) || scenes::is_procedural(options.run.scene) ||
        !scenes::is_pack(options.run.scene))
        return {};
    for (oracle::PackPictures& pictures : oracle::candidate_pictures(options.run.scene, options.candidate))
        if (pictures.algorithm == algorithm) return std::move(pictures.passes);
    return {};
}

// Right: 0. Whatever else made the picture, known or not: 1.
int diagnose(DiagnoseOptions& options) {
    check_outputs({{"--report", options.report, {".html"}}});
    choose_algorithm(options.run);
    complete(options.run);
    if (options.run.algorithms.size() != 1)
        throw CLI::ValidationError("--algorithm", "expected one algorithm, found several");
    const oracle::Picture candidate = read_candidate(options, options.run.algorithms[0]->name);
    // The machines draw at the candidate's size.
    options.run.render.width = candidate.targets[0].width;
    options.run.render.height = candidate.targets[0].height;
    const Session session = open_session(options.run);
    const oracle::Laboratory laboratory{{session.scene.list, session.view, session.profile, options.run.render},
                                        *options.run.algorithms[0],
                                        has_depth(candidate) ? oracle::Depths::made : oracle::Depths::left_out,
                                        options.limit};
    const auto shown_by = [](Progress& bar) { return [&bar](double share) { bar.show(share); }; };
    Progress machines("wrong machines");
    const oracle::Lineup lineup{laboratory, shown_by(machines)};
    Progress pairs("pairs of mistakes");
    const std::vector<oracle::PassPicture> passes = read_passes(options, options.run.algorithms[0]->name);
    const oracle::Diagnosis found =
        lineup.diagnose(candidate, options.tolerances, shown_by(pairs), passes.empty() ? nullptr : &passes);
    const oracle::Comparison comparison = oracle::compare(laboratory.right(), candidate, options.tolerances);
    if (!options.report.empty()) {
        PlainPage page{"Diagnosis", canonical_command("render", options.run, options.run.algorithms)};
        page.heading("What was found");
        page.lines(to_text(found, comparison));
        page.heading("Pictures");
        page.picture(oracle::as_shown(laboratory.right()), "As it should be");
        page.picture(oracle::as_shown(candidate), "The candidate");
        page.picture(oracle::heat_map(comparison),
                     "Where they differ: black is equal, a colour is a kind, and the brighter the further apart");
        write_page(options.report, page);
    }
    print(options.json ? to_json(found, comparison) : to_text(found, comparison));
    return found.verdict == oracle::Verdict::right ? 0 : 1;
}

}  // namespace

Command add_diagnose(CLI::App& root) {
    auto* app = root.add_subcommand("diagnose", "tell which known mistake, or which two, made a picture of a scene");
    const auto options = std::make_shared<DiagnoseOptions>();
    add_picture_options(*app, options->run);
    app->add_option("CANDIDATE", options->candidate,
                    "an .exr, .png or .npy file, bare numbers with --layout, or a candidate's folder (PACK.md)")
        ->required()
        ->type_name("");
    add_layout_option(*app, options->layout);
    add_tolerance_option(*app, options->tolerances);
    add_option(*app, options->limit,
               {"--limit", "PASSES", "geometry passes after which the candidate gives up, of mistakes that never end",
                "a whole number, at least 1"},
               [](std::string_view text) {
                   const auto number = to_int<int>(text);
                   return number && *number >= 1 ? number : std::nullopt;
               });
    add_report_option(*app, options->report);
    app->add_flag("--json", options->json, "one JSON document instead of text");
    app->footer(
        "The scene is drawn at the candidate's size, whatever --size says; strata mistakes lists what is tried.\n"
        "Examples:\n"
        "  strata render showroom --size 64x64 -o mine.png && strata diagnose showroom mine.png\n"
        "  strata golden showroom --size 64x64 -o room && strata diagnose room room --json\n"
        "Exit status: 0 right, 1 a mistake or none of mine, 2 bad input or usage, 3 the system failed, 130 "
        "interrupted.");
    return {app, [options] { return diagnose(*options); }};
}

}  // namespace strata::tools
