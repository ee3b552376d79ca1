// Tests that signals delete unfinished files, by listing the folder after a child process was ended by each signal.
#include "scenes/files/unfinished_files.h"

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <csignal>
#include <filesystem>
#include <string>

#include "scenes/files/atomic_file.h"
#include "scenes/files/system_error.h"
#include "scenes/packs/new_folder.h"
#include "tests/scenes/scenes_support.h"

using strata::SystemError;
using strata::scenes::AtomicFile;
using strata::test::TemporaryFolder;

namespace {

bool is_bare(const TemporaryFolder& folder) { return std::filesystem::is_empty(folder.path); }

// The status that waitpid() returns for a child that runs `body`. The child has the system's default handlers, not the
// test's.
template <class Body>
int end_of_child(Body body) {
    const pid_t child = ::fork();
    if (child == 0) {
        for (int signal = 1; signal <= SIGRTMAX; ++signal) std::signal(signal, SIG_DFL);
        const rlimit none{0, 0};
        ::setrlimit(RLIMIT_CORE, &none);
        body();
        ::_exit(99);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    return status;
}

int end_by(const TemporaryFolder& folder, int signal) {
    return end_of_child([&] {
        strata::scenes::install_interrupt_handlers();
        AtomicFile a{folder / "a.txt"}, b{folder / "b.txt"};
        a.write("x", 1);
        if (!std::filesystem::exists(a.temporary()) || !std::filesystem::exists(b.temporary())) ::_exit(1);
        ::raise(signal);
    });
}

}  // namespace

TEST_CASE("every signal that ends a process deletes its unfinished files first") {
    std::string wrong;
    int ended = 0;
    for (int signal = 1; signal <= SIGRTMAX; ++signal) {
        const bool is_library = signal >= 32 && signal < SIGRTMIN;
        const bool is_stop = signal == SIGSTOP || signal == SIGTSTP || signal == SIGTTIN || signal == SIGTTOU;
        if (is_library || is_stop) continue;
        const int plain = end_of_child([&] { ::raise(signal); });
        // Skips signals that are ignored by default or cannot be caught.
        if (!WIFSIGNALED(plain) || signal == SIGKILL || signal == SIGXFSZ) continue;
        ++ended;
        const TemporaryFolder folder;
        const int status = end_by(folder, signal);
        const bool is_fault = signal == SIGABRT || signal == SIGSEGV || signal == SIGBUS || signal == SIGFPE ||
                              signal == SIGILL || signal == SIGTRAP || signal == SIGSYS;
        const bool is_right = is_fault ? WIFSIGNALED(status) && WTERMSIG(status) == signal
                                       : WIFEXITED(status) && WEXITSTATUS(status) == 128 + signal;
        if (!is_right || !is_bare(folder)) wrong += std::to_string(signal) + " ";
    }
    CHECK(wrong == "");
    CHECK(ended >= 50);  // Linux has 21 standard ones and 31 real-time ones
}

TEST_CASE("a signal deletes an unfinished folder with its content and follows no link and keeps finished files") {
    namespace fs = std::filesystem;
    const TemporaryFolder folder, outside;
    std::ofstream(outside / "kept") << "kept";
    const int status = end_of_child([&] {
        strata::scenes::install_interrupt_handlers();
        strata::scenes::NewFolder finished{folder / "finished"}, half{folder / "half"};
        finished.write("a/b/c.txt", "c");
        finished.keep();
        // More names than one read of a directory returns.
        for (int i = 0; i < 500; ++i) half.write("scene/" + std::string(100, 'x') + std::to_string(i), "x");
        fs::create_directories(folder / "half/a/b/c/d");
        fs::create_directory_symlink(outside.path, folder / "half/link");
        ::raise(SIGTERM);
    });
    CHECK((WIFEXITED(status) && WEXITSTATUS(status) == 128 + SIGTERM));
    CHECK(fs::exists(folder / "finished/a/b/c.txt"));
    CHECK_FALSE(fs::exists(folder / "half"));
    CHECK(fs::exists(outside / "kept"));
}

TEST_CASE("a signal that the process ignores stays ignored and an existing handler of a fault stays") {
    const TemporaryFolder folder;
    const int status = end_of_child([&] {
        std::signal(SIGHUP, SIG_IGN);
        std::signal(SIGUSR1, SIG_IGN);
        std::signal(SIGSEGV, [](int) { ::_exit(7); });
        strata::scenes::install_interrupt_handlers();
        const AtomicFile file{folder / "a.txt"};
        ::raise(SIGHUP);
        ::raise(SIGUSR1);
        if (!std::filesystem::exists(file.temporary())) ::_exit(8);
        ::raise(SIGSEGV);
    });
    CHECK((WIFEXITED(status) && WEXITSTATUS(status) == 7));
}

TEST_CASE("a write beyond the limit of file sizes is an error and not a signal") {
    const TemporaryFolder folder;
    const int status = end_of_child([&] {
        strata::scenes::install_interrupt_handlers();
        const rlimit limit{4096, 4096};
        ::setrlimit(RLIMIT_FSIZE, &limit);
        try {
            strata::scenes::write_file(folder / "a.txt", std::string(5000, 'x'));
        } catch (const SystemError& error) {
            ::_exit(std::string{error.what()}.find("File too large") != std::string::npos ? 3 : 4);
        }
    });
    CHECK((WIFEXITED(status) && WEXITSTATUS(status) == 3));
    CHECK(is_bare(folder));
}
