// tools/strata/golden.cpp - strata golden: writes or checks a golden pack, which contains all inputs of a port and all
// results that it must produce.
#include "tools/oracle/pack/golden.h"

#include <fmt/format.h>

#include <filesystem>
#include <memory>

#include "peeling/render.h"
#include "scenes/packs/new_folder.h"
#include "tools/oracle/suite/suite_packs.h"
#include "tools/strata/command.h"
#include "tools/strata/messages.h"
#include "tools/strata/options/option.h"
#include "tools/strata/options/option_readers.h"
#include "tools/strata/options/pack_options.h"
#include "tools/strata/progress.h"
#include "tools/strata/render/memory.h"
#include "tools/strata/render/run.h"
#include "tools/strata/table.h"

namespace strata::tools {

namespace {

// The options of the command line.
struct GoldenOptions {
    RunOptions run;
    std::string check;
    bool suite = false, exr = false;
    [[nodiscard]] oracle::Copies copies() const { return exr ? oracle::Copies::exr : oracle::Copies::none; }
};

int check(const std::string& path, Simd simd) {
    check_simd(simd);
    const auto checked = [&] {
        if (!oracle::is_suite(path)) return oracle::check_pack(path, simd);
        Progress bar("scenes of the suite");
        return oracle::check_suite(path, simd, [&](double share) { bar.show(share); });
    };
    const std::vector<oracle::PackFault> faults = checked();
    for (const oracle::PackFault& fault : faults) print(fault.file + ": " + fault.message + '\n');
    if (faults.empty()) print(path + ": all files match\n");
    return faults.empty() ? 0 : 1;
}

// Algorithms that the profile cannot run are left out; their reasons are reported.
// `progress` gets the share of the algorithms that were tried.
oracle::Golden golden_of(RunOptions& options, const std::function<void(double share)>& progress) {
    Session session = open_session(options);
    check_literal_memory(options, session);
    oracle::Golden golden{.scene = std::move(session.scene),
                          .color_space = options.scene_options.color_space,
                          .profile = std::move(session.profile),
                          .options = options.render,
                          .command = canonical_command("golden", options, options.algorithms)};
    golden.scene.own_view = session.view;
    peeling::RenderOptions tried = golden.options;
    tried.audit = false;
    peeling::Renderer renderer{golden.request().with(tried)};
    for (std::size_t i = 0; i < options.algorithms.size(); ++i) {
        progress(static_cast<double>(i) / static_cast<double>(options.algorithms.size()));
        const peeling::Algorithm* const algorithm = options.algorithms[i];
        const peeling::RenderResult result = renderer.render(*algorithm);
        if (result.outcome == peeling::Outcome::done)
            golden.algorithms.push_back(algorithm);
        else
            say_error(algorithm->name + ": " + result.refusal->message(golden.profile));
    }
    return golden;
}

// Prints the summary, such as "pack: 41 files, 212 KiB, of 2 algorithms". `judges`: the command for a port's pictures.
void say_written(const std::string& folder, const std::string& what, std::string_view judges) {
    if (is_quiet()) return;
    std::uintmax_t files = 0, bytes = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
        if (entry.is_regular_file()) ++files, bytes += entry.file_size();
    print(fmt::format("{}: {} files, {} KiB, of {}; strata {} {} FOLDER judges a port's pictures of it\n", folder,
                      files, (bytes + 1023) / 1024, what, judges, folder));
}

// Writes all scenes of the suite, or only the named one.
int write_suite(const GoldenOptions& options) {
    std::vector<const oracle::SuiteScene*> scenes;
    for (const oracle::SuiteScene& scene : oracle::suite())
        if (options.run.scene.empty() || scene.name == options.run.scene) scenes.push_back(&scene);
    if (scenes.empty())
        throw CLI::ValidationError(
            "SCENE", "expected a scene of the suite (strata diagnose --list --suite shows them), found '" +
                         options.run.scene + "'");
    Progress bar("scenes of the suite");
    oracle::write_suite(
        options.run.output, scenes, [&](double share) { bar.show(share); }, options.copies());
    say_written(options.run.output, fmt::format("{} scene{}", scenes.size(), scenes.size() == 1 ? "" : "s"),
                "diagnose");
    return 0;
}

// A pack to check has its own options, as have the scenes of the suite.
void refuse_without_effect(const CLI::App& app, const GoldenOptions& options) {
    if (!options.check.empty())
        refuse_others(app, {"--check", "--simd", "--max-memory"}, "with --check");
    else if (options.suite)
        refuse_others(app, {"--suite", "--exr", "--output", "SCENE"},
                      "with --suite, whose scenes have their own options");
}

int golden(GoldenOptions& options) {
    if (!options.check.empty()) return check(options.check, options.run.render.simd);
    if (options.run.scene.empty() && !options.suite)
        throw CLI::ValidationError("SCENE is missing; --check PACK needs none");
    if (options.run.output.empty()) throw CLI::ValidationError("-o is missing: the folder for the pack");
    scenes::check_new_folder(options.run.output);
    if (options.suite) return write_suite(options);
    complete(options.run);
    // To try whether an algorithm runs takes far less time than to write its passes.
    constexpr double tried = 0.2;
    std::optional<Progress> bar("pack");
    const oracle::Golden made = golden_of(options.run, [&](double share) { bar->show(tried * share); });
    if (made.algorithms.empty()) return 2;
    oracle::write_pack(made, options.run.output, options.copies(),
                       [&](double share) { bar->show(tried + (1 - tried) * share); });
    bar.reset();
    say_written(options.run.output,
                fmt::format("{} algorithm{}", made.algorithms.size(), made.algorithms.size() == 1 ? "" : "s"),
                "compare");
    return 0;
}

}  // namespace

Command add_golden(CLI::App& root) {
    auto* app = root.add_subcommand(
        "golden", "write everything that a port needs and must produce, or check such a pack byte by byte");
    const auto options = std::make_shared<GoldenOptions>();
    add_picture_options(*app, options->run);
    add_memory_option(*app, options->run);
    app->get_option("SCENE")->required(false);
    add_path(*app, options->run.output,
             {"-o,--output", "PACK", "the folder to write; it must not exist or be empty", "a folder's name"});
    add_path(
        *app, options->check,
        {"--check", "PACK", "derive a pack, or a suite of them, again, and name what differs", "a folder with a pack"});
    app->add_flag(
        "--suite", options->suite,
        "write the standard set: small scenes in which every known mistake shows; SCENE may name one of them");
    app->add_flag("--exr", options->exr, "next to the arrays, EXR files of the picture, the layers and every pass");
    add_option_of_table(*app, options->run, "simd");
    app->footer(
        "Examples:\n"
        "  strata golden teapot --size 64x48 --algorithm front_to_back,dual -o pack && strata golden --check pack\n"
        "  strata golden planes:count=3 --size 32x32 -o three && strata render three -o three.png\n"
        "  strata golden random.dual --suite -o set && strata golden --check set\n"
        "Exit status: 0 done, 1 --check found differences, 2 bad input or usage, 3 the system failed, 130 "
        "interrupted.");
    return {app, [app, options] {
                refuse_without_effect(*app, *options);
                return golden(*options);
            }};
}

}  // namespace strata::tools
