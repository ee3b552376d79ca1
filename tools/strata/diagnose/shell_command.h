// tools/strata/diagnose/shell_command.h - runs a user's command in the shell until it ends or a time limit is reached.
//
// Rule     The command has its own process group, its input is empty, and its output is discarded. The whole group gets
//          SIGKILL when its shell has ended, at the time limit, or when a signal ends this process.
// Tests    tests/tools/strata/diagnose/reduce_command_test.cpp
#pragma once
#include <string>

namespace strata::tools {

struct EndOfCommand {
    enum class Way { exited, killed, timed_out };
    Way way = Way::exited;
    int number = 0;  // the exit status or the signal
};

// `seconds` is the time limit, from the start. Throws SystemError if the shell cannot be started.
[[nodiscard]] EndOfCommand run_in_shell(const std::string& line, double seconds);

}  // namespace strata::tools
