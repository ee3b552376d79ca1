// tools/strata/diagnose/diagnose.cpp - strata diagnose: finds the known mistake, or the other option, that produced a
// candidate picture.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "peeling/algorithms/algorithm.h"
#include "rasterizer/base/input_error.h"
#include "scenes/files/profile_json.h"
#include "scenes/packs/pack_scene.h"
#include "tools/oracle/diagnosis/scenes_diagnosis.h"
#include "tools/oracle/judge/judge.h"
#include "tools/oracle/pack/manifest_value.h"
#include "tools/oracle/pack/pack_pictures.h"
#include "tools/oracle/picture/stored_like.h"
#include "tools/strata/command.h"
#include "tools/strata/compare/compare_pages.h"
#include "tools/strata/compare/compare_scene.h"
#include "tools/strata/compare/tolerances.h"
#include "tools/strata/diagnose/diagnosis_page.h"
#include "tools/strata/diagnose/mistakes.h"
#include "tools/strata/messages.h"
#include "tools/strata/options/option.h"
#include "tools/strata/options/option_readers.h"
#include "tools/strata/options/pack_options.h"
#include "tools/strata/progress.h"
#include "tools/strata/recorded_command.h"
#include "tools/strata/render/run.h"

namespace strata::tools {

namespace {

struct DiagnoseOptions {
    RunOptions run;
    std::string candidate;
    std::optional<oracle::RawLayout> layout{};
    oracle::Tolerances tolerances{};
    std::optional<oracle::AlphaForm> alpha_form{};
    int limit = 0;                        // geometry passes after which the candidate's algorithm stops
    std::vector<std::string> profiles{};  // files or names, tried in addition to the built-in ones
    std::string report;
    MistakesOptions mistakes{};
    bool json = false;
};

// Uses the pack's algorithm if the user names none.
void choose_algorithm(RunOptions& run) {
    if (!run.algorithms.empty() || scenes::is_procedural(run.scene) || !scenes::is_pack(run.scene)) return;
    const std::string folder = scenes::pack_folder(run.scene), file = folder + "/manifest.json";
    const nlohmann::json manifest = scenes::read_manifest(folder);
    const auto results = oracle::ManifestValue{manifest, file}.list("results");
    if (!results.empty()) run.default_algorithm = results[0].algorithm("algorithm");
}

// Reads the picture from a candidate's folder or from another pack.
oracle::Picture read_candidate(const DiagnoseOptions& options, const std::string& algorithm) {
    namespace fs = std::filesystem;
    if (!fs::is_directory(options.candidate)) return oracle::read_picture(options.candidate, options.layout);
    for (const fs::path& folder : {fs::path(options.candidate), fs::path(options.candidate) / "expected"})
        if (const fs::path picture = folder / algorithm / "picture.npy"; fs::exists(picture))
            return oracle::read_picture(picture.string());
    throw InputError(options.candidate, "files", "a picture of " + algorithm + ", " + algorithm + "/picture.npy",
                     "none");
}

// Reads the passes from a candidate's folder or another pack; empty unless the scene is a pack.
std::vector<oracle::PassPicture> read_passes(const DiagnoseOptions& options, const std::string& algorithm) {
    if (!std::filesystem::is_directory(options.candidate) || scenes::is_procedural(options.run.scene) ||
        !scenes::is_pack(options.run.scene))
        return {};
    for (oracle::PackPictures& pictures : oracle::candidate_pictures(options.run.scene, options.candidate))
        if (pictures.algorithm == algorithm) return std::move(pictures.passes);
    return {};
}

// A scene, the candidate picture of it, and the emulated renderers with one mistake each.
struct OpenCase {
    DiagnoseOptions options;
    oracle::Picture candidate{};
    std::vector<oracle::PassPicture> passes{};
    Session session{};
    std::optional<oracle::MistakeRenderer> mistake_renderer{};
    std::optional<oracle::MistakeImages> mistake_images{};

    [[nodiscard]] const std::vector<oracle::PassPicture>* passes_or_null() const {
        return passes.empty() ? nullptr : &passes;
    }
    [[nodiscard]] const peeling::Algorithm& algorithm() const { return *options.run.algorithms[0]; }
    [[nodiscard]] peeling::FrameRequest input() const {
        return session.request(options.run.render, options.run.scene_options.color_space);
    }
    [[nodiscard]] oracle::Comparison comparison() const {
        return oracle::compare(stored_like(mistake_renderer->right(), candidate, input().space), candidate,
                               options.tolerances);
    }
};

std::vector<pipeline::DeviceProfile> more_profiles(const DiagnoseOptions& options) {
    std::vector<pipeline::DeviceProfile> more;
    for (const std::string& file : options.profiles) more.push_back(scenes::load_profile(file));
    return more;
}

std::unique_ptr<OpenCase> open_case(const DiagnoseOptions& given) {
    auto opened = std::make_unique<OpenCase>();
    opened->options = given;
    DiagnoseOptions& options = opened->options;
    check_targets(options.tolerances, {});
    choose_algorithm(options.run);
    complete(options.run);
    if (options.run.algorithms.size() != 1) throw CLI::ValidationError("--algorithm takes one algorithm here");
    const peeling::Algorithm& algorithm = opened->algorithm();
    opened->candidate = read_candidate(options, algorithm.name);
    state_alpha(opened->candidate, options.alpha_form);
    opened->passes = read_passes(options, algorithm.name);
    // The simulated renderers draw at the candidate's size.
    take_size(options.run, opened->candidate.targets[0], opened->candidate.file);
    opened->session = open_session(options.run);
    return opened;
}

// Draws the scene with every mistake. With several scenes only mistakes are tried, because only they have the same
// names in every scene.
void draw_mistakes(OpenCase& opened) {
    opened.mistake_renderer.emplace(
        opened.input(), opened.algorithm(),
        oracle::has_depth(opened.candidate) ? oracle::Depths::made : oracle::Depths::left_out, opened.options.limit);
    opened.mistake_images.emplace(*opened.mistake_renderer);
}

void warn_of_other_command(const OpenCase& opened) {
    warn_of_other_command(opened.candidate.file, opened.options.run, "diagnose");
}

oracle::ShowProgress shown_by(Progress& bar) {
    return [&bar](double share) { bar.show(share); };
}

// The exit status: 0 for a right picture, 1 for any mistake, known or not.
int status_of(oracle::Conclusion conclusion) {
    using enum oracle::Conclusion;
    return conclusion == right || conclusion == other_options || conclusion == right_structure ? 0 : 1;
}

// The bars are wiped before the result is printed.
oracle::Judgement judged(const OpenCase& opened, const DiagnoseOptions& options) {
    const std::vector<pipeline::DeviceProfile> more = more_profiles(options);
    Progress emulations("emulations"), pairs("pairs of mistakes"), layers("verdict by layers");
    return judge(opened.input(),
                 {.candidate = opened.candidate,
                  .is_form_stated = options.alpha_form.has_value(),
                  .has_alpha = options.tolerances.channels == oracle::ColorChannels::all,
                  .algorithm = &opened.algorithm(),
                  .camera = camera_in_words(opened.options.run),
                  .more = more,
                  .tolerances = options.tolerances,
                  .limit = options.limit,
                  .passes = opened.passes_or_null(),
                  .layers = shown_by(layers),
                  .emulations = shown_by(emulations),
                  .pairs = shown_by(pairs)},
                 oracle::Effort::all);
}

int diagnose_one(const DiagnoseOptions& options) {
    const auto opened = open_case(options);
    const oracle::Judgement judgement = judged(*opened, options);
    if (!judgement.is_right) warn_of_other_command(*opened);
    if (!options.report.empty()) {
        const std::string command = canonical_command("render", opened->options.run, opened->options.run.algorithms);
        write_page(options.report, diagnosis_page(command, judgement, opened->candidate));
    }
    print(options.json ? judgement.json : judgement.text);
    return judgement.is_right ? 0 : 1;
}

// The names of the packs in a folder, such as the scenes of the suite, sorted. Empty if the folder is itself a pack, or
// is not a folder.
std::vector<std::string> packs_in(const std::string& folder) {
    std::vector<std::string> names;
    if (scenes::is_procedural(folder) || scenes::is_pack(folder) || !std::filesystem::is_directory(folder))
        return names;
    for (const auto& entry : std::filesystem::directory_iterator(folder))
        if (scenes::is_pack(entry.path().string())) names.push_back(entry.path().filename().string());
    std::ranges::sort(names);
    return names;
}

// The path of the candidate's folder or picture that has the name of the pack. Empty if there is none.
std::string made_of(const std::string& pack, const std::string& folder) {
    for (const char* ending : {"", ".exr", ".npy", ".png", ".ppm", ".tga", ".bmp", ".hdr", ".jpg"})
        if (const std::string path = (std::filesystem::path(folder) / (pack + ending)).string();
            std::filesystem::exists(path))
            return path;
    return "";
}

// Diagnoses together all packs for which the candidate folder contains a result: which mistakes explain all of them?
int diagnose_several(const DiagnoseOptions& options, const std::vector<std::string>& packs) {
    Progress bar("scenes");
    std::vector<std::unique_ptr<OpenCase>> opened;
    std::vector<oracle::SceneEvidence> scenes;
    std::vector<oracle::SceneReport> reports;
    for (const std::string& name : packs) {
        DiagnoseOptions of_scene = options;
        of_scene.run.scene = (std::filesystem::path(options.run.scene) / name).string();
        of_scene.candidate = made_of(name, options.candidate);
        if (of_scene.candidate.empty()) continue;
        take_pack_state(of_scene.run, of_scene.run.scene);
        opened.push_back(open_case(of_scene));
        draw_mistakes(*opened.back());
        const OpenCase& c = *opened.back();
        scenes.push_back({name, &*c.mistake_images, &c.candidate, c.passes_or_null()});
        reports.push_back({name, c.comparison()});
        bar.show(0.5 * static_cast<double>(opened.size()) / static_cast<double>(packs.size()));
    }
    if (scenes.empty())
        throw InputError(options.candidate, "has no picture or folder with the name of a pack, such as " + packs[0]);
    const oracle::ScenesDiagnosis found =
        oracle::diagnose_scenes(scenes, options.tolerances, [&](double share) { bar.show(0.5 + 0.5 * share); });
    if (found.conclusion != oracle::Conclusion::right)
        for (const auto& one : opened) warn_of_other_command(*one);
    print(options.json ? to_json(found, reports) : to_text(found, reports));
    return status_of(found.conclusion);
}

// Rejects options that describe a scene, because every pack of the folder contains its own state.
void check_several(const CLI::App& app) {
    refuse_others(app,
                  {"SCENE", "CANDIDATE", "--algorithm", "--limit", "--tolerance", "--channels", "--candidate-alpha",
                   "--layout", "--json", "--max-memory"},
                  "on a folder of packs, which have their own options");
}

int diagnose(const CLI::App& app, const DiagnoseOptions& options) {
    if (options.mistakes.list) {
        refuse_others(app, {"--list", "--suite", "--output", "--json"}, "with --list");
        return show_mistakes(options.mistakes, options.json);
    }
    for (const char* name : {"SCENE", "CANDIDATE"})
        if (app.count(name) == 0) throw CLI::RequiredError(name);
    for (const char* name : {"--suite", "--output"})
        if (app.count(name) > 0) throw CLI::ValidationError(std::string(name) + " has no effect without --list");
    const std::vector<std::string> packs = packs_in(options.run.scene);
    check_outputs({{"--report", options.report, {".html"}}});
    if (packs.empty()) return diagnose_one(options);
    check_several(app);
    return diagnose_several(options, packs);
}

}  // namespace

Command add_diagnose(CLI::App& root) {
    auto* app = root.add_subcommand("diagnose", "show which known mistake, or which two, made a picture of a scene");
    const auto options = std::make_shared<DiagnoseOptions>();
    options->run.takes_one_algorithm = true;
    options->run.takes_size_of_picture = true;
    add_picture_options(*app, options->run);
    add_memory_option(*app, options->run);
    app->get_option("SCENE")->required(false);  // not needed with --list
    app->add_option(
           "CANDIDATE", options->candidate,
           "an .exr, .png or .npy file, bare numbers with --layout, or a candidate's folder (PACK.md); of a folder of "
           "packs a folder with one of each")
        ->type_name("");
    add_layout_option(*app, options->layout);
    add_tolerance_option(*app, options->tolerances);
    add_channels_option(*app, options->tolerances);
    add_alpha_option(*app, options->alpha_form);
    add_option(*app, options->limit,
               {"--limit", "PASSES", "geometry passes after which the candidate gives up, of mistakes that never end",
                "a whole number, at least 1"},
               [](std::string_view text) {
                   const auto number = to_int<int>(text);
                   return number && *number >= 1 ? number : std::nullopt;
               });
    add_option(*app, options->profiles,
               {"--profiles", "NAMES", "profiles or their files that are tried with the built-in ones",
                "names of profiles or of JSON files with commas between"},
               [](std::string_view text) {
                   auto names = split(text, ',');
                   const bool fits = std::ranges::none_of(names, &std::string::empty);
                   return fits ? std::optional{std::move(names)} : std::nullopt;
               });
    add_report_option(*app, options->report);
    add_mistakes_options(*app, options->mistakes);
    app->add_flag("--json", options->json, "one JSON document instead of text");
    app->footer(
        "The scene is drawn at the candidate's size; strata diagnose --list shows what is tried.\n"
        "A folder of packs, such as a suite, with a folder of pictures or of candidates' folders of the same names is "
        "diagnosed as a whole: "
        "one "
        "port made them all.\n"
        "Examples:\n"
        "  strata render showroom --size 64x64 -o mine.png && strata diagnose showroom mine.png\n"
        "  strata golden showroom --size 64x64 -o room && strata diagnose room room --json\n"
        "Exit status: 0 right, 1 a mistake, known or not, 2 bad input or usage, 3 the system failed, 130 "
        "interrupted.");
    return {app, [app, options] { return diagnose(*app, *options); }};
}

}  // namespace strata::tools
