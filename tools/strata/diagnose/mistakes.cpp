#include "tools/strata/diagnose/mistakes.h"

#include <nlohmann/json.hpp>

#include "scenes/files/atomic_file.h"
#include "tools/oracle/emulations/catalogue.h"
#include "tools/oracle/suite/suite.h"
#include "tools/strata/options/option.h"
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

}  // namespace

int show_mistakes(const MistakesOptions& options, bool json) {
    const std::string text = options.suite ? list_suite(json) : list_mistakes(json);
    if (options.output.empty())
        print(text);
    else
        scenes::write_file(options.output, text);
    return 0;
}

void add_mistakes_options(CLI::App& app, MistakesOptions& options) {
    app.add_flag("--list", options.list, "list the mistakes that are known, instead of a diagnosis");
    app.add_flag("--suite", options.suite, "with --list: the scenes that show them, each as a command");
    add_path(app, options.output,
             {"-o,--output", "FILE", "with --list: gets the list (default: standard output)", "a file name"});
}

}  // namespace strata::tools
