// tools/strata/program.h - a whole run of the command: words in, exit status out.
#pragma once
#include <string_view>
#include <vector>

namespace CLI {
class App;
}

namespace strata::tools {

struct Command;

struct NamedCommand {
    std::string_view name;
    Command (*add)(CLI::App& root);
};

// main()'s arguments, and the experiments that this program holds: all of them, or none, and then strata-lab runs them.
[[nodiscard]] int run_program(int count, char** words, const std::vector<NamedCommand>& experiments);

}  // namespace strata::tools
