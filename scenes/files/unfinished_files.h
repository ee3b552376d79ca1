// scenes/files/unfinished_files.h - the files that are being written, where a signal handler finds them.
//
// Rule     A signal that ends the process removes them first. SIGKILL and SIGSTOP cannot be caught.
// Tests    tests/scenes/files/unfinished_files_test.cpp, tests/tools/interrupt_test.cpp
#pragma once
#include <string>
#include <string_view>

namespace strata::scenes {

// Enters a path into the table and answers its place there. SystemError if the table is full or the path too long.
[[nodiscard]] int enter_unfinished_file(const std::string& path);

// Takes it out again; the file is left as it is.
void forget_unfinished_file(int place) noexcept;

// Unlinks every file of the table. Async-signal-safe.
void remove_unfinished_files() noexcept;

// What standard error is told when an interrupt (SIGINT, SIGTERM, SIGHUP) ends the process: "strata: interrupted; ...", one line of
// at most 1,000 bytes; control characters become '?'. The last call counts; an empty sentence leaves "strata: interrupted".
void tell_when_interrupted(std::string_view sentence) noexcept;

// On a signal that asks the process to end (SIGINT, SIGTERM, SIGALRM, SIGUSR1, real-time signals and their kin):
// remove_unfinished_files(), then _exit(128 + signal), which is 130 for SIGINT; one that the process was told to ignore
// (nohup) stays ignored. On a signal of a fault of our own (SIGABRT, SIGSEGV, ...): the same, then the system's way to end,
// with its core file, unless a sanitizer has a handler there. SIGXFSZ is ignored, so that a write beyond the limit of file
// sizes fails like one on a full disk.
void remove_unfinished_files_when_interrupted() noexcept;

}  // namespace strata::scenes
