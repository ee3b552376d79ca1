// tools/strata/diagnose/mistakes.cpp - strata mistakes: the catalogue that diagnose tries, and the suite that shows it.
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "scenes/files/atomic_file.h"
#include "tools/oracle/mistakes/catalogue.h"
#include "tools/oracle/mistakes/mistake_table.h"
#include "tools/strata/command.h"
#include "tools/strata/options/option.h"
#include "tools/strata/progress.h"
#include "tools/strata/table.h"

namespace strata::tools {

namespace {

struct MistakesOptions {
    bool suite = false, table = false, json = false;
    std::string output;
};

std::string list_mistakes(bool json) {
    nlohmann::ordered_json document = nlohmann::ordered_json::array();
    Table table{{{"mistake"}, {"a picture has it if its pixels are those of"}}, {}};
    for (const oracle::Mistake& mistake : oracle::catalogue()) {
        table.rows.push_back({std::string(mistake.name), std::string(mistake.sentence)});
        document.push_back({{"name", mistake.name}, {"sentence", mistake.sentence}});
    }
    return json ? document.dump(2) + '\n' : to_text(table);
}

std::string list_suite(bool json) {
    nlohmann::ordered_json document = nlohmann::ordered_json::array();
    Table table{{{"scene"}, {"what it is for"}, {"command"}}, {}};
    for (const oracle::SuiteScene& scene : oracle::suite()) {
        table.rows.push_back({scene.name, scene.why, command_of(scene)});
        document.push_back({{"name", scene.name}, {"why", scene.why}, {"command", command_of(scene)}});
    }
    return json ? document.dump(2) + '\n' : to_text(table);
}

std::vector<oracle::TableColumn> all_columns() {
    Progress progress("scenes of the suite");
    std::vector<oracle::TableColumn> columns;
    for (const oracle::SuiteScene& scene : oracle::suite()) {
        columns.push_back(oracle::table_column(scene));
        progress.show(static_cast<double>(columns.size()) / static_cast<double>(oracle::suite().size()));
    }
    return columns;
}

// A page that is a file has its drawing beside it: MISTAKES.md and MISTAKES.svg.
std::string make_page(const std::string& path) {
    const auto columns = all_columns();
    if (!path.ends_with(".md")) return to_page(columns, "");
    const auto plot = std::filesystem::path(path).replace_extension(".svg");
    scenes::write_file(plot.string(), to_svg(columns));
    return to_page(columns, plot.filename().string());
}

int mistakes(const MistakesOptions& options) {
    const std::string text = options.table   ? make_page(options.output)
                             : options.suite ? list_suite(options.json)
                                             : list_mistakes(options.json);
    if (options.output.empty())
        print(text);
    else
        scenes::write_file(options.output, text);
    return 0;
}

}  // namespace

Command add_mistakes(CLI::App& root) {
    auto* app = root.add_subcommand("mistakes", "list the mistakes that diagnose knows, and the scenes that show them");
    const auto options = std::make_shared<MistakesOptions>();
    app->add_flag("--suite", options->suite, "list the scenes of the suite, each as a command");
    app->add_flag("--table", options->table,
                  "diagnose every mistake on every scene of the suite: a page in Markdown, and beside FILE.md a "
                  "drawing, FILE.svg");
    add_path(*app, options->output,
             {"-o", "FILE", "gets the list or the page (default: standard output)", "a file name"});
    app->add_flag("--json", options->json, "lists as one JSON document");
    app->footer(footer("  strata mistakes\n  strata mistakes --suite\n"));
    return {app, [options] { return mistakes(*options); }};
}

}  // namespace strata::tools
