// tools/strata/manual/manual.cpp - strata help and completions: the commands that describe commands.
#include "tools/strata/manual/manual.h"

#include <algorithm>
#include <memory>

#include "tools/strata/command.h"
#include "tools/strata/options/option.h"
#include "tools/strata/table.h"

namespace strata::tools {

namespace {

struct About {
    std::string command, amount;
};

// The command of that name; the root for an empty name.
CLI::App& command_named(CLI::App& root, const std::string& name) {
    if (name.empty()) return root;
    std::vector<std::string> names;
    for (CLI::App* command : commands_of(root)) {
        if (command->get_name() == name) return *command;
        names.push_back(command->get_name());
    }
    throw CLI::ValidationError("COMMAND", "expected " + one_of(names) + ", found " + found_but_near(name, names));
}

}  // namespace

Command add_help(CLI::App& root) {
    auto* app = root.add_subcommand("help", "show a command's options; with all behind it the rare ones, too");
    const auto about = std::make_shared<About>();
    app->add_option("COMMAND", about->command, "a command; without one, the list of them")->type_name("");
    app->add_option("AMOUNT", about->amount, "all")->type_name("")->check([](const std::string& given) -> std::string {
        return given == "all" ? "" : "expected all, found '" + given + "'";
    });
    app->footer(footer("  strata help render\n  strata help render all\n"));
    return {app, [&root, about] {
                CLI::App& command = command_named(root, about->command);
                print(help_of(command, about->amount.empty() ? HelpDetail::usual : HelpDetail::all));
                return 0;
            }};
}

Command add_completions(CLI::App& root) {
    auto* app =
        root.add_subcommand("completions", "write a bash script that completes commands, options and their values");
    // zsh reads the script after `autoload -U bashcompinit && bashcompinit`.
    app->footer(footer("  strata completions > strata.bash\n  strata completions | bash -n\n"));
    return {app, [&root] {
                print(completions(root));
                return 0;
            }};
}

}  // namespace strata::tools
