// Tests the help texts: every example that they print must run.
#include <catch2/catch.hpp>

#include "tests/tools/program.h"
#include "tools/request/option_fields.h"

using namespace strata::test;

namespace {

std::vector<std::string> examples_of(const std::string& help) {
    std::vector<std::string> examples;
    bool inside = false;
    for (const std::string& line : lines_of(help)) {
        if (line == "Examples:")
            inside = true;
        else if (inside && line.starts_with("  strata "))
            examples.push_back(line.substr(2));
        else
            inside = false;
    }
    return examples;
}

}  // namespace

TEST_CASE("every example of every --help runs as printed", "[long]") {
    // The examples of hardware-check need hardware captures.
    const std::string verb =
        GENERATE(filter([](const std::string& name) { return name != "hardware-check"; }, from_range(commands())));
    const Folder folder;
    const CommandResult help = run_strata(folder, {verb, "--help"});
    CHECK(help.status == 0);
    const auto examples = examples_of(help.out);
    CHECK(examples.size() >= 2);
    CHECK(examples.size() <= 3);
    for (const std::string& example : examples) {
        const CommandResult ended = shell(folder, example);
        INFO(example << "\n" << ended.err);
        CHECK(ended.status == 0);
    }
}

TEST_CASE("strata without arguments lists its commands and an example that runs and where to find more") {
    const Folder folder;
    const CommandResult ended = run_strata(folder, {});
    CHECK(ended.status == 0);
    CHECK(ended.err.empty());
    // One line per command, one per group, and a few others.
    CHECK(lines_of(ended.out).size() <= commands().size() + 9);
    std::size_t before = 0;
    for (const std::string word : {"\nRender and look", "\n  render ", "\n  report ", "\nCheck a port", "\n  compare ",
                                   "\nExperiments", "\n  cost ", "\nDevices", "\n  probe ", "\nLists and help"}) {
        const std::size_t at = ended.out.find(word);
        CHECK((at != std::string::npos && at > before));
        before = at;
    }
    for (const std::string& verb : commands()) CHECK(ended.out.find("\n  " + verb + " ") != std::string::npos);
    const std::size_t example = ended.out.find("strata render");
    REQUIRE(example != std::string::npos);
    CHECK(shell(folder, ended.out.substr(example, ended.out.find('\n', example) - example)).status == 0);
    CHECK(ended.out.find("strata COMMAND --help") != std::string::npos);
}

TEST_CASE("the options --help and --version succeed and write to standard output only") {
    const auto word = GENERATE(as<std::string>{}, "--help", "--version");
    const Folder folder;
    const CommandResult ended = run_strata(folder, {word});
    CHECK(ended.status == 0);
    CHECK(ended.out.find("strata") != std::string::npos);
    CHECK(ended.err.empty());
}

TEST_CASE("render has every option of the table in its help and a message for a value that is none") {
    const Folder folder;
    const std::string help = run_strata(folder, {"render", "--help", "all"}).out;
    for (const strata::tools::OptionField& field : strata::tools::option_fields()) {
        INFO(field.name);
        CHECK(help.find("\n  " + field.option() + " ") != std::string::npos);
        CHECK(help.find(field.help.substr(0, 20)) != std::string::npos);
    }
    const CommandResult ended = run_strata(folder, {"render", "teapot", "--nodes", "9"});
    CHECK(ended.status == 2);
    CHECK(ended.err.find("--nodes: expected a whole number from 1 to 8, found '9'") != std::string::npos);
}
