// tools/lab/hard_cases/hard_cases.cpp - strata hard-cases: runs every algorithm on scenes that are hard for rasterizers
// and peels.
#include <fmt/format.h>

#include <memory>

#include "peeling/registry.h"
#include "scenes/files/profile_json.h"
#include "scenes/procedural/hard_cases/hard_case.h"
#include "tools/lab/commands.h"
#include "tools/lab/hard_cases/hard_sweep.h"
#include "tools/request/choices.h"
#include "tools/strata/options/options.h"
#include "tools/strata/render/memory.h"
#include "tools/strata/render/run.h"
#include "tools/strata/table.h"

namespace strata::tools {

namespace {

using nlohmann::ordered_json;

struct HardOptions {
    RunOptions run;  // --max-memory
    std::vector<std::string> names;
    std::string folder;
    std::vector<std::string> profiles{"geforce3", "geforce8", "ideal", "llvmpipe"};
    std::vector<std::string> formats{"d16", "d24", "d32f"};
    std::vector<std::string> algorithms;  // empty: all
    Shard shard;
    bool list = false, json = false, dry_run = false, moves = true;
};

int list_cases(const HardOptions& options) {
    ordered_json document = ordered_json::array();
    Table table{{{"case"}, {"frame", Align::right}, {"layers", Align::right}, {"what is hard"}}, {}};
    for (const scenes::HardCase& hard : scenes::hard_cases()) {
        document.push_back({{"name", hard.name},
                            {"hard", hard.hard},
                            {"answer", hard.answer},
                            {"width", hard.width},
                            {"height", hard.height},
                            {"depth_range", {hard.depth_near, hard.depth_far}},
                            {"fragments", hard.counts.fragments},
                            {"deepest", hard.counts.deepest},
                            {"layers", hard.counts.layers},
                            {"tied_pixels", hard.counts.tied_pixels}});
        table.rows.push_back({std::string{hard.name}, fmt::format("{}x{}", hard.width, hard.height),
                              fmt::format("{}", hard.counts.layers), std::string{hard.hard}});
    }
    print(options.json ? document.dump(2) + '\n' : titled(to_text(table)));
    return 0;
}

std::vector<const scenes::HardCase*> cases_of(const std::vector<std::string>& names) {
    std::vector<const scenes::HardCase*> cases;
    std::vector<std::string> known;
    for (const scenes::HardCase& hard : scenes::hard_cases()) {
        known.emplace_back(hard.name);
        if (names.empty()) cases.push_back(&hard);
    }
    for (const std::string& name : names) {
        const scenes::HardCase* const hard = scenes::find_hard_case(name);
        if (hard == nullptr)
            throw CLI::ValidationError("NAME", "expected a hard case (strata hard-cases --list names them), found " +
                                                   found_but_near(name, known));
        if (std::find(cases.begin(), cases.end(), hard) != cases.end())
            throw CLI::ValidationError("NAME", "'" + name + "' is named twice");
        cases.push_back(hard);
    }
    return cases;
}

HardSweep chosen(const HardOptions& options) {
    HardSweep sweep{.cases = cases_of(options.names), .profiles = {}, .formats = {}, .algorithms = {}};
    for (const std::string& name : options.profiles) sweep.profiles.push_back(scenes::load_profile(name));
    for (const std::string& name : options.formats)
        for (const auto& format : depth_formats)
            if (format.name == name) sweep.formats.push_back(format.value);
    for (const peeling::Algorithm& algorithm : peeling::algorithms()) {
        const auto& chosen = options.algorithms;
        if (chosen.empty() || std::find(chosen.begin(), chosen.end(), algorithm.name) != chosen.end())
            sweep.algorithms.push_back(&algorithm);
    }
    return sweep;
}

// With --max-memory: refuses all cases if one of them needs more.
void check_memory_of(const RunOptions& options, const HardSweep& sweep) {
    if (!options.max_memory) return;
    for (const scenes::HardCase* hard : sweep.cases)
        for (const pipeline::DeviceProfile& profile : sweep.profiles) {
            if (hard->depth_near > hard->depth_far) continue;  // every frame is refused
            RunOptions run = options;
            run.scene = "hard:case=" + std::string{hard->name};
            run.profile = profile.name;
            run.render = hard_options(*hard, {});
            const Session session = open_session(run);
            for (const peeling::Algorithm* algorithm : sweep.algorithms) check_memory(run, session, *algorithm);
        }
}

int hard_cases_command(const HardOptions& options) {
    if (options.list) return list_cases(options);
    if (options.folder.empty() && !options.dry_run)
        throw CLI::ValidationError("-o is missing: the folder for the results");
    const HardSweep cases = chosen(options);
    check_memory_of(options.run, cases);
    Sweep sweep = sweep_of(cases);
    if (options.json)
        sweep.summary = [](const Lines& lines, const Lines&) { return ordered_json(lines).dump(2) + '\n'; };
    if (options.dry_run) return dry_run(sweep, options.shard), 0;
    return run_sweep(sweep, options.folder, options.shard);
}

// Comma-separated values, each of them a name in `known`.
void add_names(CLI::App& app, const std::string& option, std::vector<std::string>& target,
               const std::vector<std::string>& known, const std::string& help) {
    const auto fill = [&target, known, option](const std::string& given) {
        target.clear();
        for (const std::string& name : split(given, ',')) {
            if (std::find(known.begin(), known.end(), name) == known.end())
                throw CLI::ValidationError(option,
                                           "expected " + one_of(known) + ", found " + found_but_near(name, known));
            if (std::find(target.begin(), target.end(), name) != target.end())
                throw CLI::ValidationError(option, "'" + name + "' is named twice");
            target.push_back(name);
        }
    };
    app.add_option_function<std::string>(option, fill, help)->type_name("NAME[,NAME...]");
}

}  // namespace

Command add_hard_cases(CLI::App& root) {
    auto* app = add_lab_command(root, "hard-cases");
    const auto options = std::make_shared<HardOptions>();
    app->add_option("NAME", options->names, "hard cases (default all)")->type_name("");
    add_path(*app, options->folder,
             {"-o,--output", "FOLDER", "folder for results.jsonl, results.csv and timings.jsonl", "a folder"});
    app->add_flag("--list", options->list, "name the cases and say what is hard about each");
    app->add_flag("--json", options->json, "one JSON document instead of the table");
    std::vector<std::string> profiles;
    for (const auto& profile : pipeline::builtin_profiles()) profiles.push_back(profile.name);
    add_names(*app, "--profile", options->profiles, profiles, "devices (default geforce3,geforce8,ideal,llvmpipe)");
    add_names(*app, "--depth-format", options->formats, names_of(depth_formats),
              "depth formats (default d16, d24 and d32f)");
    add_names(*app, "--algorithm", options->algorithms, algorithm_names(), "algorithms (default all)");
    add_shard_option(*app, options->shard);
    add_memory_option(*app, options->run);
    app->add_flag_callback(
        "--no-moves", [options] { options->moves = false; }, "do not measure stability and flicker");
    app->add_flag("--dry-run", options->dry_run, "print the rows and how long they would take, without measuring them");
    app->footer(
        "Examples:\n"
        "  strata hard-cases --list\n"
        "  strata hard-cases cyclic-overlap coincident --algorithm dual,painter -o hard\n"
        "Exit status: 0 done, 1 a combination failed or is unstable, 2 bad input or usage, 3 the system failed, 130 "
        "interrupted.");
    return {app, [options] { return hard_cases_command(*options); }};
}

}  // namespace strata::tools
