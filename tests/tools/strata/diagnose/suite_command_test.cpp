// Compares the suite with packs that `golden` writes from the commands that suite.json lists, and its table of mistakes
// with the diagnosis of images from `render --mistake`.
#include <catch2/catch.hpp>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/tools/program.h"
#include "tests/tools/strata/diagnose/named.h"

using namespace strata::test;
using Catch::Contains;
using nlohmann::json;

namespace {

json json_in(const std::string& path) { return json::parse(content_of(path)); }

bool names(const json& list, const std::string& name) {
    return std::find(list.begin(), list.end(), name) != list.end();
}

}  // namespace

TEST_CASE("golden --suite writes the packs of the listed commands and the mistakes that each scene detects") {
    const Folder folder;
    const std::string scene = "planes.front_to_back";
    REQUIRE(run_strata(folder, {"golden", scene, "--suite", "-q", "-o", "set"}).status == 0);
    const json list = json_in(folder / "set/suite.json");
    REQUIRE(list["scenes"].size() == 1);
    const std::string command = list["scenes"][0]["command"];
    REQUIRE(shell(folder, command + " -o right.exr && strata golden" + command.substr(command.find(' ', 7)) + " -o own")
                .status == 0);
    const json in_set = json_in(folder / ("set/" + scene + "/manifest.json")),
               own = json_in(folder / "own/manifest.json");
    for (const char* key : {"scene", "view", "state", "draws", "results", "files"}) CHECK(in_set[key] == own[key]);
    CHECK(run_strata(folder, {"compare", "set/" + scene, "right.exr"}).status == 0);
    int shown = 0, hidden = 0;
    for (const json& mistake : list["mistakes"]) {
        const std::string name = mistake["name"];
        const bool is_first = names(mistake["named_first"], scene), is_hidden = names(mistake["does_not_show"], scene);
        CHECK(mistake["named_otherwise"].empty());
        if ((!is_first || shown == 1) && (!is_hidden || hidden == 1)) continue;
        ++(is_first ? shown : hidden);
        INFO(name);
        REQUIRE(shell(folder, command + " --mistake " + name + " -o wrong.exr").status == 0);
        const CommandResult said = run_strata(folder, {"diagnose", "set/" + scene, "wrong.exr"});
        CHECK(said.status == (is_first ? 1 : 0));
        CHECK_THAT(said.out, Catch::StartsWith(is_first ? "wrong: " : "right: "));
        CHECK_THAT(named_emulation(said), Contains(is_first ? "(" + name + ")" : "a correct implementation"));
    }
    CHECK(shown + hidden == 2);
    const CommandResult check = run_strata(folder, {"golden", "--check", "set", "--simd", "scalar"});
    CHECK(check.status == 0);
    CHECK(check.out == "set: all files match\n");

    REQUIRE(shell(folder, "printf '\\007' | dd of=set/" + scene +
                              "/expected/front_to_back/picture.npy bs=1 seek=200 conv=notrunc && "
                              "sed -i 's/eight planes/nine planes/' set/suite.json")
                .status == 0);
    const CommandResult spoiled = run_strata(folder, {"golden", "--check", "set/suite.json"});
    CHECK(spoiled.status == 1);
    CHECK_THAT(
        spoiled.out,
        Contains(scene + "/expected/front_to_back/picture.npy: byte 200, row 0, column 18, channel 0: expected "));
    CHECK_THAT(spoiled.out, Contains("suite.json: line 7: differs from the list that strata derives again\n"));
}

TEST_CASE("golden --suite rejects options of single packs and unknown scene names") {
    const Folder folder;
    const auto fails = [&](const std::vector<std::string>& words, const std::string& message) {
        const CommandResult ended = run_strata(folder, words);
        CHECK(ended.status == 2);
        CHECK(ended.err == "strata: " + message + "\n");
    };
    fails({"golden", "--suite", "-o", "set", "--algorithm", "dual"},
          "--algorithm has no effect with --suite, whose scenes have their own options");
    fails({"golden", "teapot", "--suite", "-o", "set"},
          "SCENE: expected a scene of the suite (strata diagnose --list --suite shows them), found 'teapot'");
    fails({"golden", "--suite"}, "-o is missing: the folder for the pack");
    CHECK(folder.files().empty());
    std::ofstream{folder / "suite.json"} << R"({"format":"strata-suite","version":1,"scenes":[{"name":"moon.dual"}]})";
    fails({"golden", "--check", "suite.json"},
          "./suite.json: /scenes/0/name: expected a scene of the suite (strata diagnose --list --suite shows them), "
          "found "
          "'moon.dual'");
    std::ofstream{folder / "suite.json"} << R"({"format":"strata-suite","version":2,"scenes":[]})";
    fails({"golden", "--check", "suite.json"}, "./suite.json: /version: expected 1, found 2");
}
