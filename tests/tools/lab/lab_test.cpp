// Tests that strata and strata-lab behave as one command, and what strata reports when strata-lab is missing.
#include <catch2/catch.hpp>
#include <filesystem>

#include "tests/tools/program.h"

using namespace strata::test;

namespace {

const std::filesystem::path built = std::filesystem::path{STRATA_PROGRAM}.parent_path();

// Runs a copy of strata in a folder without strata-lab.
CommandResult run_alone(const Folder& folder, const std::string& words) {
    std::filesystem::copy_file(STRATA_PROGRAM, folder / "strata", std::filesystem::copy_options::overwrite_existing);
    return shell(folder, "./strata " + words);
}

const std::vector<std::string> experiments{"cost",  "invariance",     "hard-cases", "reproduce", "multisampling",
                                           "bench", "hardware-check", "probe",      "infer"};

}  // namespace

TEST_CASE("strata runs an experiment as strata-lab does with the same output and errors and status") {
    const Folder folder;
    const auto words = GENERATE(as<std::string>{}, "hard-cases --list", "--color never hard-cases --list", "cost",
                                "bench nothing", "help probe", "help bench all", "help infer", "completions",
                                "bench --help all", "-q bench --algoritm dual");
    const CommandResult here = shell(folder, "strata " + words);
    const CommandResult there = shell(folder, (built / "strata-lab").string() + " " + words);
    INFO(words << "\n" << here.err);
    CHECK(here.out == there.out);
    CHECK(here.err == there.err);
    CHECK(here.status == there.status);
}

TEST_CASE("a command gives the same result in strata and in strata-lab") {
    const Folder folder;
    const auto words = GENERATE(as<std::string>{}, "", "--help", "help", "help render", "list profiles", "nothing");
    const CommandResult here = shell(folder, "strata " + words);
    const CommandResult there = shell(folder, (built / "strata-lab").string() + " " + words);
    CHECK(here.out == there.out);
    CHECK(here.err == there.err);
    CHECK(here.status == there.status);
}

TEST_CASE("without strata-lab an experiment fails with the command that builds it and other commands work") {
    const Folder folder;
    for (const std::string& name : experiments) {
        for (const std::string& words : {name + " --help", "help " + name}) {
            const CommandResult ended = run_alone(folder, words);
            INFO(words);
            CHECK(ended.status == 3);
            CHECK(ended.out.empty());
            CHECK(ended.err == "strata: " + folder.path().string() +
                                   "/strata-lab: cannot run the experiments: no such program; cmake --build --preset "
                                   "release --target strata_lab builds it\n");
        }
    }
    CHECK(run_alone(folder, "").out == run_strata(folder, {}).out);
    const CommandResult bash = run_alone(folder, "completions");
    CHECK(bash.status == 0);
    for (const std::string& name : commands()) CHECK(bash.out.find(name) != std::string::npos);
    CHECK(run_alone(folder, "list profiles").status == 0);
}

TEST_CASE("a strata-lab that cannot be executed is reported with the system's reason") {
    const Folder folder;
    CHECK(shell(folder, "echo x > strata-lab && chmod +x strata-lab").status == 0);
    const CommandResult ended = run_alone(folder, "cost teapot");
    CHECK(ended.status == 3);
    CHECK(ended.err.find("strata-lab: cannot run the experiments: Exec format error") != std::string::npos);
}
