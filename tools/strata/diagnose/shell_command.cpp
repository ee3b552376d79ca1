#include "tools/strata/diagnose/shell_command.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <future>

#include "scenes/files/system_error.h"
#include "scenes/files/unfinished_files.h"

namespace strata::tools {

namespace {

// Both ends of a pipe; child processes do not inherit them, except by the file actions of start().
class Pipe {
  public:
    Pipe() {
        if (::pipe2(ends_, O_CLOEXEC) != 0) throw SystemError("a pipe", "make", std::strerror(errno));
    }
    Pipe(const Pipe&) = delete;
    Pipe& operator=(const Pipe&) = delete;
    ~Pipe() {
        for (const int end : ends_) ::close(end);
    }
    [[nodiscard]] int read_end() const noexcept { return ends_[0]; }
    void say_go() const noexcept { static_cast<void>(!::write(ends_[1], "\n", 1)); }

  private:
    int ends_[2];
};

// Starts the shell in its own process group and returns its process number, which is also the group's. The shell waits
// for a line on its input before it runs the command, so a signal cannot leave a command running before this process
// knows the group.
pid_t start(const std::string& line, const Pipe& go) {
    posix_spawn_file_actions_t files;
    posix_spawn_file_actions_init(&files);
    posix_spawn_file_actions_adddup2(&files, go.read_end(), STDIN_FILENO);
    for (const int stream : {STDOUT_FILENO, STDERR_FILENO})
        posix_spawn_file_actions_addopen(&files, stream, "/dev/null", O_WRONLY, 0);
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    posix_spawnattr_setpgroup(&attributes, 0);
    sigset_t ignored_here;  // exec() resets handled signals to their defaults, but not ignored ones
    sigemptyset(&ignored_here);
    sigaddset(&ignored_here, SIGXFSZ);
    posix_spawnattr_setsigdefault(&attributes, &ignored_here);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGDEF);
    std::string shell = "sh", option = "-c", waiting = "read -r go && exec sh -c \"$1\" </dev/null", text = line;
    char* words[] = {shell.data(), option.data(), waiting.data(), shell.data(), text.data(), nullptr};
    pid_t child = 0;
    const int error = ::posix_spawn(&child, "/bin/sh", &files, &attributes, words, environ);
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&files);
    if (error != 0) throw SystemError(line, "start the command", std::strerror(error));
    return child;
}

// Leaves the child a zombie, so the system cannot give its number to another process before the group is killed.
void wait_without_reaping(pid_t child) {
    siginfo_t info{};
    while (::waitid(P_PID, static_cast<id_t>(child), &info, WEXITED | WNOWAIT) != 0 && errno == EINTR) {
    }
}

}  // namespace

EndOfCommand run_in_shell(const std::string& line, double seconds) {
    const Pipe go;
    const pid_t child = start(line, go);
    scenes::kill_group_on_interrupt(child);
    go.say_go();
    bool is_late = false;
    try {
        const std::future<void> ended = std::async(std::launch::async, wait_without_reaping, child);
        is_late = ended.wait_for(std::chrono::duration<double>(seconds)) == std::future_status::timeout;
        if (is_late) ::kill(-child, SIGKILL);
    } catch (const std::system_error&) {  // no thread is available: run without a time limit
        wait_without_reaping(child);
    }
    scenes::kill_group_on_interrupt(0);
    ::kill(-child, SIGKILL);
    int status = 0;
    while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    using enum EndOfCommand::Way;
    if (is_late) return {timed_out, 0};
    return WIFEXITED(status) ? EndOfCommand{exited, WEXITSTATUS(status)} : EndOfCommand{killed, WTERMSIG(status)};
}

}  // namespace strata::tools
