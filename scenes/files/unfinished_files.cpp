#include "scenes/files/unfinished_files.h"

#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <csignal>
#include <cstring>
#include <iterator>

#include "scenes/files/system_error.h"

namespace strata::scenes {
namespace {

// A path where a signal handler may read it: fixed storage and lock-free flags.
// A path is written while its slot is `claimed`, when the handler passes it over, and read only while `active`.
// 16 slots: a run writes a few files at a time.
struct Slot {
    std::atomic<int> state{empty};
    char path[4096];
    enum State : int { empty, claimed, active };
};
Slot slots[16];
static_assert(std::atomic<int>::is_always_lock_free);

// Two sentences in turn: one is written while the handler may read the other.
struct Sentence {
    std::size_t size = 0;
    char text[1000] = {};
};
Sentence sentences[2];
std::atomic<int> current{0};
bool starts_line = false;  // standard error is a terminal

// A new line first, where a terminal has "^C" or a bar on its line.
void say_interrupted() noexcept {
    const Sentence& sentence = sentences[current];
    const bool is_empty = sentence.size == 0;
    const auto put = [](const char* text, std::size_t size) { static_cast<void>(!::write(STDERR_FILENO, text, size)); };
    constexpr std::string_view begin = "strata: interrupted", between = "; ";
    if (starts_line) put("\n", 1);
    put(begin.data(), begin.size());
    if (!is_empty) put(between.data(), between.size());
    put(sentence.text, sentence.size);
    put("\n", 1);
}

// Async-signal-safe calls alone: write, unlink and _exit. 128 + the signal is what a shell reports for a process that
// a signal ended.
extern "C" void on_interrupt(int signal) {
    remove_unfinished_files();
    if (signal == SIGINT || signal == SIGTERM || signal == SIGHUP) say_interrupted();
    ::_exit(128 + signal);
}

// SA_RESETHAND has put the system's own handler back: it ends the process once this one returns.
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

// SA_SIGINFO marks a handler of another signature, which is neither of the system's two.
bool is_at(int signal, void (*handler)(int)) noexcept {
    struct sigaction now {};
    ::sigaction(signal, nullptr, &now);
    return (now.sa_flags & SA_SIGINFO) == 0 && now.sa_handler == handler;
}

void handle_interrupt(int signal) noexcept {
    if (!is_at(signal, SIG_IGN)) handle(signal, on_interrupt, 0);
}

}  // namespace

int enter_unfinished_file(const std::string& path) {
    if (path.size() >= sizeof(Slot::path)) throw SystemError(path, "write", "the name is too long");
    for (int i = 0; i < static_cast<int>(std::size(slots)); ++i) {
        int expected = Slot::empty;
        if (!slots[i].state.compare_exchange_strong(expected, Slot::claimed)) continue;
        std::memcpy(slots[i].path, path.c_str(), path.size() + 1);
        slots[i].state = Slot::active;
        return i;
    }
    throw SystemError(path, "write", "too many files are being written at once");
}

void forget_unfinished_file(int place) noexcept { slots[place].state = Slot::empty; }

void remove_unfinished_files() noexcept {
    for (const Slot& slot : slots) {
        if (slot.state == Slot::active) ::unlink(slot.path);
    }
}

void tell_when_interrupted(std::string_view sentence) noexcept {
    const int next = 1 - current;
    Sentence& to = sentences[next];
    to.size = std::min(sentence.size(), sizeof to.text);
    std::transform(sentence.begin(), sentence.begin() + static_cast<std::ptrdiff_t>(to.size), to.text,
                   [](char c) { return (c >= 0 && c < 0x20) || c == 0x7f ? '?' : c; });
    current = next;
}

void remove_unfinished_files_when_interrupted() noexcept {
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
