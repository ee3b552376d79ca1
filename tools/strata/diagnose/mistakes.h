// tools/strata/diagnose/mistakes.h - strata diagnose --list: prints the catalogue of known mistakes and the suite of
// scenes that shows them.
#pragma once
#include <CLI/CLI.hpp>
#include <string>

namespace strata::tools {

struct MistakesOptions {
    bool list = false, suite = false;
    std::string output;  // empty: standard output
};

void add_mistakes_options(CLI::App& app, MistakesOptions& options);
// Returns the exit status.
int show_mistakes(const MistakesOptions& options, bool json);

}  // namespace strata::tools
