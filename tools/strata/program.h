// tools/strata/program.h - the whole program as a function: from the words of the command line to the exit status.
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

// Arguments: main()'s, and the experiments that this program contains: all of them in strata-lab, none in strata.
[[nodiscard]] int run_program(int count, char** words, const std::vector<NamedCommand>& experiments);

}  // namespace strata::tools
