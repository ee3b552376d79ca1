// tools/strata/lab.cpp - finds strata-lab beside the program and starts it for the experiments (lab.h).
#include "tools/strata/lab.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>

#include "scenes/files/system_error.h"

namespace strata::tools {

namespace {

struct Experiment {
    std::string_view name, description;
};
constexpr std::array experiments{
    Experiment{"cost", "measure what each choice costs in accuracy and in time"},
    Experiment{"invariance", "peel with two depths that ought to be equal, and measure what goes wrong"},
    Experiment{"multisampling",
               "count what peels lose at the samples of a pixel, by where programs run and what they load"},
    Experiment{"hard-cases",
               "run every algorithm on scenes that are hard for rasterizers and peels, and judge the outcome"},
    Experiment{"reproduce", "a paper's figures and tables next to our own: one page, CSV and pictures"},
    Experiment{"bench", "time algorithms from a loaded scene to finished pixels in memory"},
    Experiment{"hardware-check", "compare a profile with pictures that a real chip drew"},
    Experiment{"probe", "write scenes that measure a device, or answer them as a profile would"},
    Experiment{"infer", "find the profile that explains a device's answers to the kit"},
};

const Experiment* experiment(std::string_view name) {
    const auto found = std::ranges::find(experiments, name, &Experiment::name);
    return found == experiments.end() ? nullptr : found;
}

// Empty if the system does not report the path of this program's file.
std::filesystem::path lab_program() {
    std::error_code failed;
    const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", failed);
    return failed ? std::filesystem::path{} : program.parent_path() / "strata-lab";
}

bool is_lab_there() { return ::access(lab_program().c_str(), X_OK) == 0; }

// The index of the command, after any message options; words.size() if there is no command.
std::size_t command_at(const std::vector<std::string>& words) {
    std::size_t at = 0;
    while (at < words.size() && words[at].starts_with('-')) at += words[at] == "--color" ? 2 : 1;
    return std::min(at, words.size());
}

}  // namespace

CLI::App* add_lab_command(CLI::App& root, std::string_view name) {
    return root.add_subcommand(std::string{name}, std::string{experiment(name)->description});
}

bool is_for_lab(const std::vector<std::string>& words) {
    const std::size_t at = command_at(words);
    if (at >= words.size()) return false;
    if (experiment(words[at]) != nullptr) return true;
    if (words[at] == "help") return at + 1 < words.size() && experiment(words[at + 1]) != nullptr;
    return words[at] == "completions" && is_lab_there();
}

void run_lab(const std::vector<std::string>& words) {
    const std::string program = lab_program();
    if (!is_lab_there())
        throw SystemError(program, "run the experiments",
                          "no such program; cmake --build --preset release --target strata_lab builds it");
    std::vector<char*> arguments{const_cast<char*>(program.c_str())};
    for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
    arguments.push_back(nullptr);
    ::execv(program.c_str(), arguments.data());
    throw SystemError(program, "run the experiments", std::strerror(errno));
}

}  // namespace strata::tools
