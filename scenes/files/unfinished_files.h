// scenes/files/unfinished_files.h - the files and folders that are being written, where a signal handler finds them.
//
// Rule     A signal that ends the process removes them first, after it has ended the commands that the process runs.
//          SIGKILL and SIGSTOP cannot be caught.
// Tests    tests/scenes/files/unfinished_files_test.cpp, tests/tools/interrupt_test.cpp
#pragma once
#include <string>
#include <string_view>

namespace strata::scenes {

// Enters a path into the table and answers its place there. SystemError if the table is full or the path too long.
[[nodiscard]] int enter_unfinished_file(const std::string& path);

// The same of a folder, which goes with everything in it; links in it are not followed.
[[nodiscard]] int enter_unfinished_folder(const std::string& path);

// Takes either out again; the file or folder is left as it is.
void forget_unfinished_file(int place) noexcept;

// A process group that gets SIGKILL first, for it may write to those folders: one at a time, 0 for none.
void end_group_when_interrupted(int group) noexcept;

// Removes every file and folder of the table. Async-signal-safe. After it no further one is entered.
void remove_unfinished_files() noexcept;

// What standard error is told when an interrupt (SIGINT, SIGTERM, SIGHUP) ends the process: "strata: interrupted; ...",
// one line of at most 1,000 bytes; control characters become '?'. The last call counts; an empty sentence leaves
// "strata: interrupted".
void tell_when_interrupted(std::string_view sentence) noexcept;

// On a signal that asks the process to end (SIGINT, SIGTERM, SIGALRM, SIGUSR1, real-time signals and their kin):
// remove_unfinished_files(), then _exit(128 + signal), which is 130 for SIGINT; one that the process was told to ignore
// (nohup) stays ignored. On a signal of a fault of our own (SIGABRT, SIGSEGV, ...): the same, then the system's way to
// end, with its core file, unless a sanitizer has a handler there. SIGXFSZ is ignored, so that a write beyond the limit
// of file sizes fails like one on a full disk.
void remove_unfinished_files_when_interrupted() noexcept;

}  // namespace strata::scenes
