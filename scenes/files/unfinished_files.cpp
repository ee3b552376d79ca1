// scenes/files/unfinished_files.cpp - the table of unfinished files and the signal handlers that remove them
// (unfinished_files.h).
#include "scenes/files/unfinished_files.h"

#include <dirent.h>
#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstddef>
#include <cstring>
#include <iterator>

#include "scenes/files/system_error.h"

namespace strata::scenes {
namespace {

// A path that a signal handler can read: fixed storage and lock-free flags. A path is written while its slot is
// `claimed`, when the handler skips it, and read only while `active`. 16 slots suffice, because a command writes a few
// files at a time.
struct Slot {
    std::atomic<int> state{empty};
    bool is_folder = false;
    char path[4096];
    enum State : int { empty, claimed, active };
};
Slot slots[16];
static_assert(std::atomic<int>::is_always_lock_free);
std::atomic<int> group{0};           // the process group to kill; 0: none
std::atomic<bool> is_ending{false};  // set when a handler removes files: other threads must not create new ones

// Does not use the C library's directory streams, which allocate. Entries that other processes add meanwhile are found
// in another round. The deepest folder that the program writes is scene/ in a pack in a suite; a command run by the
// user may create deeper ones.
void remove_tree(int parent, const char* name, int levels) noexcept {
    if (::unlinkat(parent, name, 0) == 0 || levels == 0) return;
    const int folder = ::openat(parent, name, O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
    if (folder < 0) return;
    alignas(std::max_align_t) char entries[2048];
    for (int round = 0; round < 100 && ::unlinkat(parent, name, AT_REMOVEDIR) != 0; ++round) {
        ::lseek(folder, 0, SEEK_SET);
        for (ssize_t size = 0; (size = ::getdents64(folder, entries, sizeof entries)) > 0;)
            for (ssize_t at = 0; at < size;) {
                const auto* const entry = reinterpret_cast<const dirent64*>(entries + at);
                const std::string_view inside = entry->d_name;
                if (inside != "." && inside != "..") remove_tree(folder, entry->d_name, levels - 1);
                at += entry->d_reclen;
            }
    }
    ::close(folder);
}

int enter(const std::string& path, bool is_folder) {
    while (is_ending) ::pause();  // the handler's thread ends the process
    if (path.size() >= sizeof(Slot::path)) throw SystemError(path, "write", "the name is too long");
    for (int i = 0; i < static_cast<int>(std::size(slots)); ++i) {
        int expected = Slot::empty;
        if (!slots[i].state.compare_exchange_strong(expected, Slot::claimed)) continue;
        std::memcpy(slots[i].path, path.c_str(), path.size() + 1);
        slots[i].is_folder = is_folder;
        slots[i].state = Slot::active;
        return i;
    }
    throw SystemError(path, "write", "too many files are being written at once");
}

// Two messages: one can be written while the handler reads the other.
struct Message {
    std::size_t size = 0;
    char text[1000] = {};
};
Message messages[2];
std::atomic<int> current{0};
bool starts_line = false;  // standard error is a terminal

// Prints a line end first on a terminal, which may show "^C" or a progress bar on the line.
void say_interrupted() noexcept {
    const Message& message = messages[current];
    const bool is_empty = message.size == 0;
    const auto put = [](const char* text, std::size_t size) { static_cast<void>(!::write(STDERR_FILENO, text, size)); };
    constexpr std::string_view begin = "strata: interrupted", between = "; ";
    if (starts_line) put("\n", 1);
    put(begin.data(), begin.size());
    if (!is_empty) put(between.data(), between.size());
    put(message.text, message.size);
    put("\n", 1);
}

// Only async-signal-safe calls: kill, write, unlinkat, openat, the system call getdents64 and _exit. A shell reports
// 128 + signal for a process ended by a signal.
extern "C" void on_interrupt(int signal) {
    remove_unfinished_files();
    if (signal == SIGINT || signal == SIGTERM || signal == SIGHUP) say_interrupted();
    ::_exit(128 + signal);
}

// SA_RESETHAND has restored the system's default action, which ends the process when this handler returns.
extern "C" void on_fault(int signal) {
    remove_unfinished_files();
    ::raise(signal);
}

void handle(int signal, void (*handler)(int), int flags) noexcept {
    struct sigaction action {};
    action.sa_handler = handler;
    action.sa_flags = flags;
    ::sigaction(signal, &action, nullptr);
}

// SA_SIGINFO means a handler of another type, which is neither SIG_DFL nor SIG_IGN.
bool is_at(int signal, void (*handler)(int)) noexcept {
    struct sigaction now {};
    ::sigaction(signal, nullptr, &now);
    return (now.sa_flags & SA_SIGINFO) == 0 && now.sa_handler == handler;
}

void handle_interrupt(int signal) noexcept {
    if (!is_at(signal, SIG_IGN)) handle(signal, on_interrupt, 0);
}

}  // namespace

int enter_unfinished_file(const std::string& path) { return enter(path, false); }
int enter_unfinished_folder(const std::string& path) { return enter(path, true); }

void forget_unfinished_file(int slot) noexcept { slots[slot].state = Slot::empty; }

void kill_group_on_interrupt(int of_command) noexcept { group = of_command; }

void remove_unfinished_files() noexcept {
    constexpr int most_folders = 64;
    is_ending = true;
    if (const int of_command = group; of_command > 0) ::kill(-of_command, SIGKILL);
    for (const Slot& slot : slots)
        if (slot.state == Slot::active) remove_tree(AT_FDCWD, slot.path, slot.is_folder ? most_folders : 0);
}

void set_interrupt_message(std::string_view message) noexcept {
    const int next = 1 - current;
    Message& to = messages[next];
    to.size = std::min(message.size(), sizeof to.text);
    std::transform(message.begin(), message.begin() + static_cast<std::ptrdiff_t>(to.size), to.text,
                   [](char c) { return (c >= 0 && c < 0x20) || c == 0x7f ? '?' : c; });
    current = next;
}

void install_interrupt_handlers() noexcept {
    starts_line = ::isatty(STDERR_FILENO) == 1;
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGPIPE, SIGXCPU, SIGALRM, SIGVTALRM, SIGPROF, SIGUSR1,
                             SIGUSR2, SIGIO, SIGPWR, SIGSTKFLT})
        handle_interrupt(signal);
    for (int signal = SIGRTMIN; signal <= SIGRTMAX; ++signal) handle_interrupt(signal);
    for (const int signal : {SIGABRT, SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGTRAP, SIGSYS})
        if (is_at(signal, SIG_DFL)) handle(signal, on_fault, static_cast<int>(SA_RESETHAND));
    std::signal(SIGXFSZ, SIG_IGN);
}

}  // namespace strata::scenes
