// tools/strata/command.h - a subcommand: its options, and what runs once they are parsed. Each has a file of its own.
#pragma once
#include <CLI/CLI.hpp>
#include <functional>
#include <string>

namespace strata::tools {

// A subcommand as main() sees it. `app` belongs to the root.
struct Command {
    CLI::App* app = nullptr;
    // Runs with the parsed options and answers the exit status. A failure is an exception.
    std::function<int()> run;
};

// Each adds its subcommand to the root. The options live as long as the Command.
[[nodiscard]] Command add_render(CLI::App& root);
[[nodiscard]] Command add_layers(CLI::App& root);
[[nodiscard]] Command add_passes(CLI::App& root);
[[nodiscard]] Command add_explain(CLI::App& root);
[[nodiscard]] Command add_report(CLI::App& root);
[[nodiscard]] Command add_diagnose(CLI::App& root);
[[nodiscard]] Command add_reduce(CLI::App& root);
[[nodiscard]] Command add_golden(CLI::App& root);
[[nodiscard]] Command add_scene(CLI::App& root);
[[nodiscard]] Command add_compare(CLI::App& root);
[[nodiscard]] Command add_list(CLI::App& root);
[[nodiscard]] Command add_info(CLI::App& root);
[[nodiscard]] Command add_help(CLI::App& root);
[[nodiscard]] Command add_man(CLI::App& root);
[[nodiscard]] Command add_completions(CLI::App& root);

// The end of a --help: examples that run as printed, one a line, then the exit statuses.
[[nodiscard]] inline std::string footer(const std::string& examples) {
    return "Examples:\n" + examples +
           "Exit status: 0 done, 2 bad input or usage, 3 the system failed, 130 interrupted.";
}

}  // namespace strata::tools
