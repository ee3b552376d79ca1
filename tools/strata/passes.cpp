// tools/strata/passes.cpp - strata passes: writes every target of an algorithm after every pass.
#include "tools/oracle/passes/passes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>

#include "pipeline/device/check.h"
#include "scenes/exr/parts.h"
#include "scenes/files/atomic_file.h"
#include "scenes/files/image_io.h"
#include "scenes/files/load_module.h"
#include "scenes/packs/new_folder.h"
#include "tools/oracle/passes/contact_sheet.h"
#include "tools/strata/command.h"
#include "tools/strata/messages.h"
#include "tools/strata/options/option.h"
#include "tools/strata/render/memory.h"
#include "tools/strata/render/run.h"
#include "tools/strata/report/plain_page.h"
#include "tools/strata/table.h"

namespace strata::tools {

namespace {

using nlohmann::ordered_json;

struct PassesOptions {
    RunOptions run;
    std::string report;  // --report; empty: none
};

std::string with_spaces(const std::vector<std::string>& words) {
    std::string text;
    for (const std::string& word : words) text += (text.empty() ? "" : " ") + word;
    return text.empty() ? "-" : text;
}

ordered_json to_json(const oracle::PassReport& pass, const std::string& file) {
    ordered_json document{{"number", pass.number},
                          {"kind", oracle::name(pass.kind)},
                          {"iteration", pass.iteration},
                          {"before", pass.before},
                          {"reads", pass.reads},
                          {"writes", pass.writes},
                          {"passed", pass.passed},
                          {"tallied", pass.tallied},
                          {"file", file}};
    document["targets"] = ordered_json::array();
    for (const oracle::NamedImage& target : pass.targets)
        document["targets"].push_back({{"name", target.name},
                                       {"format", pipeline::info(target.image.format).name},
                                       {"samples", target.image.samples},
                                       {"digest", pipeline::digest(target.image)}});
    document["queries"] = ordered_json::array();
    for (const oracle::Query& query : pass.queries)
        document["queries"].push_back({{"count", query.count}, {"goes_on", query.goes_on}});
    return document;
}

std::vector<std::string> pass_row(const oracle::PassReport& pass) {
    std::string queries;
    for (const oracle::Query& query : pass.queries)
        queries += fmt::format("{}{}: {}", queries.empty() ? "" : ", ", query.count, query.goes_on ? "on" : "stop");
    return {std::to_string(pass.number),    std::string(oracle::name(pass.kind)),
            std::to_string(pass.iteration), with_spaces(pass.reads),
            with_spaces(pass.writes),       std::to_string(pass.passed),
            queries.empty() ? "-" : queries};
}

// Writes one algorithm's files, whose names begin with the algorithm's if there are several, and adds its section to
// the page.
void show(const RunOptions& options, const Session& session, const peeling::Algorithm& algorithm, PlainPage& page) {
    const std::string prefix = options.algorithms.size() == 1 ? "" : algorithm.name + ".";
    const auto path = [&](const std::string& name) {
        return (std::filesystem::path(options.output) / (prefix + name)).string();
    };
    ordered_json document{{"command", canonical_command("passes", options, algorithm)},
                          {"algorithm", algorithm.name},
                          {"profile", session.profile.name},
                          {"passes", ordered_json::array()}};
    Table table{{{"pass", Align::right},
                 {"kind"},
                 {"iteration", Align::right},
                 {"reads"},
                 {"writes"},
                 {"passed", Align::right},
                 {"query"}},
                {}};
    oracle::ContactSheet sheet;
    const peeling::FrameRequest input = session.request(options.render);
    oracle::passes(input, algorithm, [&](oracle::PassReport&& pass) {
        const std::string name = fmt::format("pass.{:03}.exr", pass.number);
        oracle::write_targets(path(name), pass.targets);
        sheet.add(pass);
        document["passes"].push_back(to_json(pass, prefix + name));
        table.rows.push_back(pass_row(pass));
    });
    scenes::write_image(path("contact.png"), {.color = sheet.image()});
    scenes::write_file(path("passes.json"), document.dump(2) + '\n');
    page.heading(algorithm.name);
    page.lead(fmt::format("{} draws {} in {} passes: {}.", algorithm.name, options.scene, table.rows.size(),
                          algorithm.summary));
    page.table(table, "The passes of " + algorithm.name);
    page.picture_with_letters(
        sheet.image(),
        "Every target of " + algorithm.name +
            " after every pass: a row a pass, a column a target; a light frame is round what the pass has written.");
    print((prefix.empty() ? "" : algorithm.name + ":\n") + titled(to_text(table)));
}

// True for the names of the files of passes, with or without an algorithm's name: pass.012.exr.
bool is_pass_file(const std::string& name) {
    const std::size_t at = name.rfind("pass.");
    if (at == std::string::npos || !name.ends_with(".exr") || name.find('/') != std::string::npos) return false;
    const std::string number = name.substr(at + 5, name.size() - at - 9);
    return (at == 0 || name[at - 1] == '.') && !number.empty() &&
           std::ranges::all_of(number, [](unsigned char c) { return std::isdigit(c) != 0; });
}

// The files of passes that lists in the folder name.
std::set<std::string> listed_passes(const std::filesystem::path& folder) {
    std::set<std::string> files;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        if (!entry.path().filename().string().ends_with("passes.json")) continue;
        std::ifstream in(entry.path());
        const auto list = nlohmann::json::parse(in, nullptr, false);
        if (!list.is_object() || !list.contains("passes") || !list["passes"].is_array()) continue;
        for (const auto& pass : list["passes"])
            if (pass.is_object() && pass.contains("file") && pass["file"].is_string() &&
                is_pass_file(pass["file"].get<std::string>()))
                files.insert(pass["file"].get<std::string>());
    }
    return files;
}

// A folder under the name of a file would end the run when some files are written.
void check_no_folders(const std::filesystem::path& place) {
    for (const auto& entry : std::filesystem::directory_iterator(place)) {
        const std::string name = entry.path().filename().string();
        const bool is_ours = is_pass_file(name) || name.ends_with("contact.png") || name.ends_with("passes.json");
        if (is_ours && entry.is_directory()) throw InputError(entry.path().string(), "is a folder, not a file");
    }
}

// Removes the passes of an earlier run that this one has not written again, so that a series is of one run.
void remove_earlier(const std::filesystem::path& folder, const std::set<std::string>& earlier) {
    const std::set<std::string> now = listed_passes(folder);
    for (const std::string& name : earlier)
        if (!now.contains(name)) std::filesystem::remove(folder / name);
}

// An algorithm that the profile refuses writes no files; the status is 2 if all are refused.
int passes(PassesOptions& command) {
    RunOptions& options = command.run;
    complete(options);
    check_outputs({{"--report", command.report, {".html"}}});
    if (options.output.empty()) throw CLI::ValidationError("-o is missing: the folder for the files");
    static_cast<void>(scenes::exr::start_threads());
    const Session session = open_session(options);
    check_literal_memory(options, session);
    const scenes::FolderClaim claim{options.output};
    check_no_folders(options.output);
    const std::set<std::string> earlier = listed_passes(options.output);
    int status = 2;
    PlainPage page{"Passes of " + options.scene, canonical_command("passes", options, options.algorithms)};
    for (const peeling::Algorithm* algorithm : options.algorithms) try {
            show(options, session, *algorithm, page);
            status = 0;
        } catch (const pipeline::Refused& refused) {
            say_error(algorithm->name + ": " + refused.what());
        }
    if (status == 0) remove_earlier(options.output, earlier);
    if (status == 0) write_page(command.report, page);
    return status;
}

}  // namespace

Command add_passes(CLI::App& root) {
    auto* app =
        root.add_subcommand("passes", "write every target of an algorithm after every pass, and a contact sheet");
    const auto options = std::make_shared<PassesOptions>();
    add_picture_options(*app, options->run);
    add_memory_option(*app, options->run);
    add_report_option(*app, options->report);
    add_path(*app, options->run.output,
             {"-o,--output", "FOLDER",
              "gets pass.000.exr ..., passes.json and contact.png; NAME.pass.000.exr with several algorithms",
              "a folder's name"});
    app->footer(footer(
        "  strata passes teapot --size 64x48 -o dual\n"
        "  strata passes volume-beam:slices=4 --algorithm front_to_back,weighted_average --size 32x32 -o beam\n"));
    return {app, [options] { return passes(*options); }};
}

}  // namespace strata::tools
