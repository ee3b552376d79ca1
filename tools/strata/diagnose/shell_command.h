// tools/strata/diagnose/shell_command.h - a command of the user's, run by the shell until it ends or its time is over.
//
// Rule     It is a process group of its own, reads nothing and shows nothing. When its shell has ended, or the time is
//          over, or a signal ends this process, the whole group gets SIGKILL.
// Tests    tests/tools/reduce_command_test.cpp
#pragma once
#include <string>

namespace strata::tools {

struct EndOfCommand {
    enum class Way { exited, killed, timed_out };
    Way way = Way::exited;
    int number = 0;  // the exit status or the signal
};

// `seconds` from the start. SystemError if the shell does not start.
[[nodiscard]] EndOfCommand run_in_shell(const std::string& line, double seconds);

}  // namespace strata::tools
