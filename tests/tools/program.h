// tests/tools/program.h - runs the built `strata` as a person would: words in, exit status, output and files out.
#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace strata::test {

// Every command, in the order in which the help tells them.
[[nodiscard]] inline std::vector<std::string> commands() {
    return {
        "render", "report",   "explain",        "passes", "layers",     "scene",      "info",        "compare",
        "golden", "diagnose", "reduce",         "cost",   "invariance", "hard-cases", "reproduce",   "bench",
        "probe",  "infer",    "hardware-check", "list",   "help",       "man",        "completions",
    };
}

// A folder of its own that goes when the test does.
class Folder {
  public:
    Folder();
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;
    ~Folder();

    [[nodiscard]] const std::filesystem::path& path() const { return path_; }
    [[nodiscard]] std::string operator/(const std::string& name) const { return (path_ / name).string(); }
    [[nodiscard]] std::vector<std::string> files() const;  // names, sorted; hidden ones too

  private:
    std::filesystem::path path_;
};

struct Ended {
    int status = -1;  // the exit status, or 128 + the signal's number
    std::string out, err;
};

struct Setting {
    std::vector<std::pair<std::string, std::string>> environment{};
    std::string out{};                        // where standard output goes; empty: into Ended
    std::optional<int> interrupt_after_ms{};  // SIGINT
    std::optional<int> max_file_bytes{};      // a write beyond it fails, as on a full disk
};

// Runs in `folder`. The first overload runs strata, the second one a line of shell that finds strata in its PATH.
[[nodiscard]] Ended run_strata(const Folder& folder, const std::vector<std::string>& words,
                               const Setting& setting = {});
// The peak of strata's resident set, bytes; 0 if it does not end with status 0.
[[nodiscard]] std::uint64_t peak_of_strata(const Folder& folder, const std::vector<std::string>& words);
[[nodiscard]] Ended shell(const Folder& folder, const std::string& line, const Setting& setting = {});

[[nodiscard]] std::string content_of(const std::string& path);
[[nodiscard]] std::vector<std::string> lines_of(const std::string& text);

}  // namespace strata::test
