#include "tests/tools/program.h"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <thread>

namespace strata::test {

namespace {

void redirect(int descriptor, const std::string& path) {
    const int file = open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    if (file < 0 || dup2(file, descriptor) < 0) _exit(126);
    close(file);
}

// Blocks SIGINT during its lifetime. Between fork and exec the test's own handler must not run: it is not
// async-signal-safe, and the child would deadlock if the signal interrupts an allocation.
class InterruptsWait {
  public:
    InterruptsWait() {
        sigemptyset(&interrupts_);
        sigaddset(&interrupts_, SIGINT);
        sigprocmask(SIG_BLOCK, &interrupts_, nullptr);
    }
    InterruptsWait(const InterruptsWait&) = delete;
    InterruptsWait& operator=(const InterruptsWait&) = delete;
    ~InterruptsWait() { sigprocmask(SIG_UNBLOCK, &interrupts_, nullptr); }

  private:
    sigset_t interrupts_;
};

// Runs in the child and never returns. Restores the default SIGINT handler.
[[noreturn]] void become(const Folder& folder, const std::vector<std::string>& words, const Setting& setting,
                         const Folder& captured) {
    if (chdir(folder.path().c_str()) != 0) _exit(126);
    redirect(STDOUT_FILENO, setting.out.empty() ? captured / "out" : setting.out);
    redirect(STDERR_FILENO, captured / "err");
    for (const auto& [name, value] : setting.environment) setenv(name.c_str(), value.c_str(), 1);
    if (setting.max_file_bytes) {
        const auto bytes = static_cast<rlim_t>(*setting.max_file_bytes);
        const rlimit limit{bytes, bytes};
        if (setrlimit(RLIMIT_FSIZE, &limit) != 0) _exit(126);
    }
    std::vector<char*> arguments;
    for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
    arguments.push_back(nullptr);
    execv(arguments[0], arguments.data());
    _exit(127);
}

pid_t start(const Folder& folder, const std::vector<std::string>& words, const Setting& setting,
            const Folder& captured) {
    pid_t child = -1;
    {
        const InterruptsWait waiting;
        child = fork();
        if (child == 0) std::signal(SIGINT, SIG_DFL);
    }
    if (child < 0) throw std::runtime_error("fork failed");
    if (child == 0) become(folder, words, setting, captured);
    return child;
}

CommandResult run(const Folder& folder, const std::vector<std::string>& words, const Setting& setting) {
    const Folder captured;
    const pid_t child = start(folder, words, setting, captured);
    if (setting.interrupt_after_ms) {
        std::this_thread::sleep_for(std::chrono::milliseconds(*setting.interrupt_after_ms));
        kill(child, SIGINT);
    }
    int status = 0;
    if (waitpid(child, &status, 0) != child) throw std::runtime_error("waitpid failed");
    const int code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    return {code, setting.out.empty() ? content_of(captured / "out") : "", content_of(captured / "err")};
}

}  // namespace

Folder::Folder() {
    std::string name = (std::filesystem::temp_directory_path() / "strata-test-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("cannot make a folder like " + name);
    path_ = name;
}

Folder::~Folder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
}

std::vector<std::string> Folder::files() const {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(path_))
        names.push_back(entry.path().filename().string());
    std::sort(names.begin(), names.end());
    return names;
}

CommandResult run_strata(const Folder& folder, const std::vector<std::string>& words, const Setting& setting) {
    std::vector<std::string> all{STRATA_PROGRAM};
    all.insert(all.end(), words.begin(), words.end());
    return run(folder, all, setting);
}

// Started through a small process, because a fork of this one, which is linked with all libraries, would count their
// pages, too.
std::uint64_t peak_of_strata(const Folder& folder, const std::vector<std::string>& words, int status) {
    std::vector<std::string> all{PEAK_OF, STRATA_PROGRAM};
    all.insert(all.end(), words.begin(), words.end());
    const CommandResult ended = run(folder, all, {});
    return ended.status == status ? std::stoull(lines_of(ended.err).back()) * 1024 : 0;
}

CommandResult shell(const Folder& folder, const std::string& line, const Setting& setting) {
    const std::string bin = std::filesystem::path(STRATA_PROGRAM).parent_path().string();
    const char* path = std::getenv("PATH");
    Setting with_path = setting;
    with_path.environment.emplace_back("PATH", bin + ":" + (path != nullptr ? path : ""));
    return run(folder, {"/bin/sh", "-c", line}, with_path);
}

std::string content_of(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    std::ostringstream content;
    content << file.rdbuf();
    return content.str();
}

std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    return lines;
}

}  // namespace strata::test
