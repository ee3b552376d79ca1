// tools/strata/manual/manual.cpp - strata help, man and completions: the commands that describe commands.
#include "tools/strata/manual/manual.h"

#include <algorithm>
#include <filesystem>
#include <memory>

#include "scenes/files/atomic_file.h"
#include "tools/strata/command.h"
#include "tools/strata/options/option.h"
#include "tools/strata/table.h"

namespace strata::tools {

namespace {

struct About {
    std::string command, amount, folder;
    Shell shell = Shell::bash;
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

int write_pages(CLI::App& root, const std::string& folder) {
    std::filesystem::create_directories(folder);
    const auto write = [&](const std::string& name, CLI::App& command) {
        scenes::write_file((std::filesystem::path(folder) / (name + ".1")).string(), man_page(root, command));
    };
    write("strata", root);
    for (CLI::App* command : commands_of(root)) write("strata-" + command->get_name(), *command);
    return 0;
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

Command add_man(CLI::App& root) {
    auto* app = root.add_subcommand("man", "write the manual: a page in the language of man, or all of them");
    const auto about = std::make_shared<About>();
    app->add_option("COMMAND", about->command, "a command; without one, the program's own page")->type_name("");
    add_path(*app, about->folder, {"-o,--output", "FOLDER", "gets strata.1 and a page a command", "a folder's name"});
    app->footer(footer("  strata man render\n  strata man -o man1\n"));
    return {app, [&root, about] {
                if (!about->folder.empty()) return write_pages(root, about->folder);
                print(man_page(root, command_named(root, about->command)));
                return 0;
            }};
}

Command add_completions(CLI::App& root) {
    auto* app = root.add_subcommand("completions", "write what a shell needs to complete commands and options");
    const auto about = std::make_shared<About>();
    const std::vector<Choice<Shell>> shells{{"bash", Shell::bash}, {"zsh", Shell::zsh}, {"fish", Shell::fish}};
    add_choice(*app, about->shell, "SHELL", shells, "bash, zsh or fish")->required();
    app->footer(footer("  strata completions bash > strata.bash\n  strata completions fish > strata.fish\n"));
    return {app, [&root, about] {
                print(completions(root, about->shell));
                return 0;
            }};
}

}  // namespace strata::tools
