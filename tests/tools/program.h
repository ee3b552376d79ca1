// tests/tools/program.h - runs the built `strata` as a user does: takes arguments, returns exit status, output and
// files.
#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace strata::test {

// Every command, in the order of the help.
[[nodiscard]] inline std::vector<std::string> commands() {
    return {
        "render", "report",   "explain", "passes",         "layers",     "scene",         "info",        "compare",
        "golden", "diagnose", "reduce",  "cost",           "invariance", "multisampling", "hard-cases",  "reproduce",
        "bench",  "probe",    "infer",   "hardware-check", "list",       "help",          "completions",
    };
}

// A folder with a unique name, deleted when the test ends.
class Folder {
  public:
    Folder();
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;
    ~Folder();

    [[nodiscard]] const std::filesystem::path& path() const { return path_; }
    [[nodiscard]] std::string operator/(const std::string& name) const { return (path_ / name).string(); }
    [[nodiscard]] std::vector<std::string> files() const;  // file names, sorted, including hidden files

  private:
    std::filesystem::path path_;
};

struct CommandResult {
    int status = -1;  // the exit status, or 128 + the signal's number
    std::string out, err;
};

struct Setting {
    std::vector<std::pair<std::string, std::string>> environment{};
    std::string out{};                        // file for standard output; empty: stored in CommandResult
    std::optional<int> interrupt_after_ms{};  // SIGINT
    std::optional<int> max_file_bytes{};      // writes beyond this size fail, as on a full disk
};

// Both run in `folder`. The first overload runs strata, the second a shell line with strata in its PATH.
[[nodiscard]] CommandResult run_strata(const Folder& folder, const std::vector<std::string>& words,
                                       const Setting& setting = {});
// The peak of strata's resident set in bytes; 0 if its exit status is not 0.
[[nodiscard]] std::uint64_t peak_of_strata(const Folder& folder, const std::vector<std::string>& words, int status = 0);
[[nodiscard]] CommandResult shell(const Folder& folder, const std::string& line, const Setting& setting = {});

[[nodiscard]] std::string content_of(const std::string& path);
[[nodiscard]] std::vector<std::string> lines_of(const std::string& text);

}  // namespace strata::test
