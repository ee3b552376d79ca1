// tools/strata/command.h - declares the subcommands of the program: options, and the function that runs after parsing.
// Each subcommand has its own source file.
#pragma once
#include <CLI/CLI.hpp>
#include <functional>
#include <string>

namespace strata::tools {

// A subcommand as main() uses it. `app` belongs to the root command.
struct Command {
    CLI::App* app = nullptr;
    // Runs with the parsed options and returns the exit status. Failures are thrown as exceptions.
    std::function<int()> run;
};

// Each function adds its subcommand to the root. The options live as long as the Command.
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
[[nodiscard]] Command add_completions(CLI::App& root);

// The end of a --help text: examples that run as printed, one per line, then the exit statuses.
[[nodiscard]] inline std::string footer(const std::string& examples) {
    return "Examples:\n" + examples +
           "Exit status: 0 done, 2 bad input or usage, 3 the system failed, 130 interrupted.";
}

}  // namespace strata::tools
