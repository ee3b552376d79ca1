// Tests the spellings of version 0.1.0 against the current ones that replace them.
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "tests/tools/program.h"

using namespace strata::test;

namespace {

// Checks that both print the same, apart from the warning.
void same(const Folder& folder, const std::string& old, const std::string& now, const std::string& warning = "") {
    const CommandResult before = shell(folder, "strata " + old), after = shell(folder, "strata " + now);
    INFO(old << ": " << before.err << "; " << now << ": " << after.err);
    CHECK(before.status == 0);
    CHECK(after.status == 0);
    CHECK(before.out == after.out);
    CHECK_FALSE(after.out.empty());
    CHECK(before.err == (warning.empty() ? "" : "strata: warning: " + warning + "\n"));
    CHECK(after.err.empty());
}

}  // namespace

TEST_CASE("an option's old spelling has the new meaning and warns unless -q is given") {
    const Folder folder;
    const std::string render = "render planes:count=2 --size 8x8 --profile ideal --stats - --no-audit ";
    const auto digests = [&](const std::string& words) {
        return nlohmann::json::parse(shell(folder, "strata " + render + words).out).at(0).at("digest");
    };
    CHECK(digests("--depth d16") == digests("--depth-format d16"));
    CHECK(digests("--colour=linear") == digests("--color-space linear"));
    CHECK(digests("--colour=linear") != digests(""));
    CHECK(shell(folder, "strata " + render + "--depth d16").err ==
          "strata: warning: --depth is an old spelling, which goes with version 0.3: --depth-format\n");
    CHECK(shell(folder, "strata " + render + "--depth=d16 -q").err.empty());
    CHECK(run_strata(folder, {"render", "planes", "--depth", "d25"}).err.starts_with("strata: --depth-format: "));
}

TEST_CASE("a command that became part of another one works under its old name with its options and its help") {
    const Folder folder;
    REQUIRE(run_strata(folder, {"render", "planes:count=2", "--size", "8x8", "-o", "a.exr"}).status == 0);
    same(folder, "algorithms", "list algorithms");
    same(folder, "profiles geforce3", "list profiles geforce3");
    same(folder, "profiles --json ideal", "list profiles ideal --json");
    same(folder, "scenes --json", "list scenes --json");
    same(folder, "digest a.exr", "info --digests a.exr");
    same(folder, "digest --channels --json a.exr", "info a.exr --json --digests --channels");
    same(folder, "mistakes", "diagnose --list");
    same(folder, "mistakes --suite --json", "diagnose --list --suite --json");
    same(folder, "digest --help", "info --help");
    same(folder, "help effects", "help bench");
    same(folder, "man mistakes", "man diagnose");
    const std::string effects = "planes:count=2 --size 16x16 --repeat 1 --json";
    const auto names = [&](const std::string& command) {
        std::string text;
        for (const auto& row :
             nlohmann::json::parse(shell(folder, "strata " + command + effects).out).at(0).at("effects"))
            text += row.at("effect").get<std::string>() + row.at("why").get<std::string>();
        return text;
    };
    CHECK(names("effects ") == names("bench --per-effect "));
}

TEST_CASE("bench accepts a file after --json") {
    const Folder folder;
    const std::string bench = "bench planes:count=2 --size 8x8 --algorithm unsorted --repeat 1 --warm-up 0 --json ";
    const CommandResult file = shell(folder, "strata " + bench + "old.json");
    CHECK(file.status == 0);
    CHECK(file.err ==
          "strata: warning: --json old.json is an old spelling, which goes with version 0.3: -o old.json\n");
    CHECK(nlohmann::json::parse(content_of(folder / "old.json")).contains("jobs"));
    const CommandResult standard = shell(folder, "strata " + bench + "-");
    CHECK(standard.err == "strata: warning: --json - is an old spelling, which goes with version 0.3: --json\n");
    CHECK(nlohmann::json::parse(standard.out).contains("jobs"));
    CHECK(shell(folder, "strata " + bench).err.empty());
}

TEST_CASE("no help text contains an old spelling or an unusual word") {
    const Folder folder;
    std::string wrong;
    for (const std::string& verb : commands()) {
        const std::string help = " " + run_strata(folder, {verb, "--help", "all"}).out;
        for (const char* word : {" --colour", " --depth ", " tell ", " tells ", " anew", " beside ", " of mine"})
            if (help.find(word) != std::string::npos) wrong += verb + ":" + word + "\n";
        if (help.find("\n  -o ") != std::string::npos) wrong += verb + ": -o without --output\n";
    }
    CHECK(wrong == "");
}
