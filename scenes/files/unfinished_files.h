// scenes/files/unfinished_files.h - a table of the files and folders being written, which a signal handler removes.
//
// Rule     Before a signal ends the process, its handler kills the commands that the process runs, then removes the
//          files and folders. SIGKILL and SIGSTOP cannot be caught.
// Tests    tests/scenes/files/unfinished_files_test.cpp, tests/tools/strata/program/interrupt_test.cpp
#pragma once
#include <string>
#include <string_view>

namespace strata::scenes {

// Enters a path into the table and returns its slot. SystemError if the table is full or the path too long.
[[nodiscard]] int enter_unfinished_file(const std::string& path);

// The same for a folder, which is removed with its contents; links in it are not followed.
[[nodiscard]] int enter_unfinished_folder(const std::string& path);

// Removes the file or folder in slot `slot` from the table; the file or folder itself is not changed.
void forget_unfinished_file(int slot) noexcept;

// The process group that is sent SIGKILL first, because it may write to those folders. There is one at a time; 0: none.
void kill_group_on_interrupt(int group) noexcept;

// Removes every file and folder of the table. Async-signal-safe. Afterwards no more can be entered.
void remove_unfinished_files() noexcept;

// Sets the message that is printed to standard error when an interrupt (SIGINT, SIGTERM, SIGHUP) ends the process:
// "strata: interrupted; ...", one line of at most 1,000 bytes; control characters become '?'. Replaces the previous
// message; an empty one gives "strata: interrupted".
void set_interrupt_message(std::string_view message) noexcept;

// Installs signal handlers. For a signal that asks the process to end (SIGINT, SIGTERM, SIGALRM, SIGUSR1, real-time
// signals and similar ones): remove_unfinished_files(), then _exit(128 + signal), which is 130 for SIGINT; a signal
// that is ignored at the start (nohup) stays ignored. For a signal of a program fault (SIGABRT, SIGSEGV, ...): the
// same, then the system's default action with its core file, unless a sanitizer has a handler there. SIGXFSZ is
// ignored, so that a write beyond the file size limit fails like one on a full disk.
void install_interrupt_handlers() noexcept;

}  // namespace strata::scenes
