#include "tools/strata/diagnose/mistakes.h"

#include <filesystem>
#include <nlohmann/json.hpp>

#include "scenes/files/atomic_file.h"
#include "tools/oracle/emulations/catalogue.h"
#include "tools/oracle/suite/mistake_table.h"
#include "tools/strata/options/option.h"
#include "tools/strata/progress.h"
#include "tools/strata/table.h"

namespace strata::tools {

namespace {

std::string list_mistakes(bool json) {
    nlohmann::ordered_json document = nlohmann::ordered_json::array();
    Table table{{{"mistake"}, {"a picture has it if its pixels are those of"}}, {}};
    for (const oracle::Mistake& mistake : oracle::catalogue()) {
        table.rows.push_back({std::string(mistake.name), std::string(mistake.description)});
        document.push_back({{"name", mistake.name}, {"sentence", mistake.description}});
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

// A page that is written to a file has its drawing in the same folder: MISTAKES.md and MISTAKES.svg.
std::string make_page(const std::string& path) {
    const auto columns = all_columns();
    if (!path.ends_with(".md")) return to_page(columns, "");
    const auto plot = std::filesystem::path(path).replace_extension(".svg");
    scenes::write_file(plot.string(), to_svg(columns));
    return to_page(columns, plot.filename().string());
}

}  // namespace

int show_mistakes(const MistakesOptions& options, bool json) {
    const std::string text = options.table   ? make_page(options.output)
                             : options.suite ? list_suite(json)
                                             : list_mistakes(json);
    if (options.output.empty())
        print(text);
    else
        scenes::write_file(options.output, text);
    return 0;
}

void add_mistakes_options(CLI::App& app, MistakesOptions& options) {
    app.add_flag("--list", options.list, "list the mistakes that are known, instead of a diagnosis");
    app.add_flag("--suite", options.suite, "with --list: the scenes that show them, each as a command");
    app.add_flag("--table", options.table,
                 "with --list: diagnose every mistake on every scene of the suite: a page in Markdown, and next to "
                 "FILE.md a drawing, FILE.svg");
    add_path(
        app, options.output,
        {"-o,--output", "FILE", "with --list: gets the list or the page (default: standard output)", "a file name"});
}

}  // namespace strata::tools
