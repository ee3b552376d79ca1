// tools/strata/diagnose/mistakes.h - strata diagnose --list: the catalogue that diagnose tries, and the suite that
// shows it.
#pragma once
#include <CLI/CLI.hpp>
#include <string>

namespace strata::tools {

struct MistakesOptions {
    bool list = false, suite = false, table = false;
    std::string output;  // empty: standard output
};

void add_mistakes_options(CLI::App& app, MistakesOptions& options);
// The exit status.
int show_mistakes(const MistakesOptions& options, bool json);

}  // namespace strata::tools
