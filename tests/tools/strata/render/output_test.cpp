// Tests that files and digests of runs that must not differ are equal.
#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/support/skip.h"
#include "tests/tools/program.h"

using namespace strata::test;
using nlohmann::ordered_json;

namespace {

const std::vector<std::string> small{"volume-beam:slices=4", "--size", "40x24"};

CommandResult render(const Folder& folder, std::vector<std::string> more, const Setting& setting = {}) {
    more.insert(more.begin(), small.begin(), small.end());
    more.insert(more.begin(), "render");
    return run_strata(folder, more, setting);
}

std::string digest_line(const Folder& folder, const std::string& file) {
    return run_strata(folder, {"info", "--digests", file}).out;
}

}  // namespace

TEST_CASE("strata info --digests of an image prints the digest that its statistics contain") {
    const auto [format, ending] =
        GENERATE(table<std::string, std::string>({{"rgba8", ".exr"},
                                                  {"rgba8", ".png"},
                                                  {"rgba16f", ".exr"},
                                                  {"rgba32f", ".exr"},
                                                  {"rgb10_a2", ".exr"}}));  // PNG files hold codes
    const Folder folder;
    const CommandResult ended = render(folder, {"--color-format", format, "--stats", "-", "-o", "out" + ending});
    REQUIRE(ended.status == 0);
    const auto row = ordered_json::parse(ended.out)[0];
    INFO(digest_line(folder, "out" + ending));
    CHECK(digest_line(folder, "out" + ending).find(row["digest"]["color"].get<std::string>()) != std::string::npos);
    if (ending == ".exr")
        CHECK(digest_line(folder, "out.exr").find(row["digest"]["depth"].get<std::string>()) != std::string::npos);
}

TEST_CASE("strata info --digests prints files that it can read and reports those it cannot and exits with status 1") {
    const Folder folder;
    CHECK(render(folder, {"-o", "a.exr"}).status == 0);
    CHECK(render(folder, {"-o", "b.png"}).status == 0);
    const std::string both = digest_line(folder, "a.exr") + digest_line(folder, "b.png");
    const CommandResult ended = run_strata(folder, {"info", "--digests", "a.exr", "none.exr", "b.png"});
    CHECK(ended.status == 2);
    CHECK(ended.err == "strata: none.exr: no such file\n");
    REQUIRE(lines_of(ended.out).size() == 4);
    for (const std::string& line : lines_of(ended.out)) CHECK(both.find(line.substr(0, 32)) != std::string::npos);
    const CommandResult json = run_strata(folder, {"info", "--digests", "--json", "none.exr", "b.png"});
    CHECK(json.status == 2);
    CHECK(ordered_json::parse(json.out).size() == 1);
}

TEST_CASE("strata info --digests of a deep EXR depends on each of its fragments") {
    const Folder folder;
    const auto deep = [&](const std::string& file, const std::string& alpha) {
        CHECK(run_strata(folder, {"layers", small[0], small[1], small[2], "--alpha", alpha, "--deep", file}).status ==
              0);
        const CommandResult ended = run_strata(folder, {"info", "--digests", "--json", file});
        INFO(ended.err);
        REQUIRE(ended.status == 0);
        return ordered_json::parse(ended.out)[0];
    };
    const auto first = deep("a.exr", "1"), again = deep("b.exr", "1"), other = deep("c.exr", "0.5");
    CHECK(first["target"] == "fragments");
    CHECK(first["format"] == "deep");
    CHECK(first["width"] == 40);
    CHECK(first["digest"] == again["digest"]);
    CHECK(first["digest"] != other["digest"]);
    CHECK(content_of(folder / "a.exr").find(first["digest"].get<std::string>()) != std::string::npos);
}

TEST_CASE("equal runs write equal bytes for any tile size or thread count or execution or effects") {
    const auto ending = GENERATE(as<std::string>{}, ".exr", ".png");
    const Folder folder;
    CHECK(render(folder, {"-o", "first" + ending}).status == 0);
    const std::string first = content_of(folder / ("first" + ending));
    REQUIRE_FALSE(first.empty());
    const std::vector<std::vector<std::string>> settings{{},
                                                         {"--threads", "1"},
                                                         {"--tile", "8"},
                                                         {"--execution", "literal"},
                                                         {"--execution", "replay", "--fragment-memory", "0"},
                                                         {"--execution", "replay", "--fragment-memory", "4K"},
                                                         {"--simd", "scalar"},
                                                         {"--simd", "best"},
                                                         {"--effects", "all"},
                                                         {"--no-audit"}};
    for (const auto& setting : settings) {
        auto words = setting;
        words.insert(words.end(), {"-o", "again" + ending});
        CHECK(render(folder, words).status == 0);
        INFO((setting.empty() ? "the same again" : setting.front()));
        CHECK((content_of(folder / ("again" + ending)) == first));
    }
}

TEST_CASE("layers and deep files have the same bytes in every run") {
    const Folder folder;
    for (const std::string name : {"a", "b"}) {
        CHECK(run_strata(folder,
                         {"layers", small[0], small[1], small[2], "-o", name + ".exr", "--deep", name + ".deep.exr"})
                  .status == 0);
    }
    CHECK((content_of(folder / "a.exr") == content_of(folder / "b.exr")));
    CHECK((content_of(folder / "a.deep.exr") == content_of(folder / "b.deep.exr")));
    CHECK(folder.files() == std::vector<std::string>{"a.deep.exr", "a.exr", "b.deep.exr", "b.exr"});
}

TEST_CASE("a hard case rendered with its own frame and depth range has the digest in its list entry") {
    const Folder folder;
    const CommandResult cases = run_strata(folder, {"hard-cases", "narrow-range", "--algorithm", "dual", "--profile",
                                                    "geforce8", "--depth-format", "d24", "--json", "-o", "cases"});
    REQUIRE(cases.status == 0);
    const std::string digest = ordered_json::parse(cases.out)[0]["digest"];
    const auto digest_of = [&](const std::string& range) {
        const CommandResult ended =
            run_strata(folder, {"render", "hard:case=narrow-range", "--size", "32x32", "--depth-format", "d24",
                                "--depth-range", range, "--stats", "-", "-o", "out.exr"});
        REQUIRE(ended.status == 0);
        return ordered_json::parse(ended.out)[0]["digest"]["color"].get<std::string>();
    };
    CHECK(digest_of("0.5,0.50006103515625") == digest);  // depth range 1/2 to 1/2 + 2^-14
    // A hundredth of that range is narrower than one code: the layers merge.
    CHECK(digest_of("0.5,0.5000000596") != digest);
    const CommandResult reversed = run_strata(folder, {"render", "hard:case=narrow-range", "--depth-range", "1,0"});
    CHECK(reversed.status == 2);
    CHECK(reversed.err.find("reversed depth range") != std::string::npos);
}

TEST_CASE("a repeated hard case or device or algorithm is rejected and nothing is written") {
    const Folder folder;
    const auto told = [&](std::vector<std::string> words) {
        words.insert(words.begin(), {"hard-cases", "frame-1x1", "-o", "out"});
        const CommandResult ended = run_strata(folder, words);
        return ended.status == 2 ? ended.err : "exit status " + std::to_string(ended.status);
    };
    CHECK(told({"frame-1x1"}) == "strata: NAME: 'frame-1x1' is named twice\n");
    CHECK(told({"--profile", "ideal,ideal"}) == "strata: --profile: 'ideal' is named twice\n");
    CHECK(told({"--algorithm", "dual,painter,dual"}) == "strata: --algorithm: 'dual' is named twice\n");
    CHECK(folder.files().empty());
}

TEST_CASE("no output contains a path or a host name or a user name") {
    const Folder folder;
    CHECK(shell(folder, "cp " STRATA_PROGRAM
                        " here && mkdir -p deep/er && strata render teapot --size 16x16 -o deep/er/out.exr")
              .status == 0);
    const std::string bytes = content_of(folder / "deep/er/out.exr");
    CHECK(bytes.find("deep/er") == std::string::npos);
    CHECK(bytes.find(folder.path().string()) == std::string::npos);
    CHECK(bytes.find("strata render teapot --algorithm dual --profile geforce8 --size 16x16 --orbit 30,20") !=
          std::string::npos);
}

TEST_CASE("pictures of several algorithms have the algorithm's name before the file ending") {
    const Folder folder;
    CHECK(render(folder, {"--algorithm", "dual,unsorted", "-o", "out.png"}).status == 0);
    CHECK(folder.files() == std::vector<std::string>{"out.dual.png", "out.unsorted.png"});
}

TEST_CASE("a table in a pipe has no escape codes and no progress bar") {
    const Folder folder;
    const CommandResult ended = render(folder, {"--algorithm", "all"});
    CHECK(ended.out.find('\x1b') == std::string::npos);
    CHECK(ended.err.find('\r') == std::string::npos);
    CHECK(lines_of(ended.out).size() >= 10);
}

TEST_CASE("a locale with decimal commas changes no byte") {
    const Folder folder, locales;
    const std::string make = "localedef -i de_DE -f UTF-8 " + (locales / "de_DE.UTF-8");
    if (shell(folder, make).status > 1) {  // status 1: written, with warnings
        skip("localedef cannot make de_DE.UTF-8 (package locales): decimal commas are not tested");
        return;
    }
    const Setting german{
        .environment = {{"LOCPATH", locales.path().string()}, {"LC_ALL", "de_DE.UTF-8"}, {"LANG", "de_DE.UTF-8"}}};
    const std::vector<std::string> options{"--alpha",      "0.5",         "--orbit", "12.5,-7.25",
                                           "--background", "0.1,0.2,0.3", "-o"};
    auto plain = options, comma = options;
    plain.emplace_back("plain.exr");
    comma.emplace_back("comma.exr");
    CHECK(render(folder, plain).status == 0);
    CHECK(render(folder, comma, german).status == 0);
    CHECK((content_of(folder / "plain.exr") == content_of(folder / "comma.exr")));
    const auto profile = [&](const Setting& setting) {
        return run_strata(folder, {"list", "profiles", "--json", "geforce3"}, setting).out;
    };
    CHECK(profile({}) == profile(german));
}

TEST_CASE("a result does not replace a file that the command reads") {
    const Folder folder;
    const std::string scene = R"({"positions":[[-1,-1,0],[1,-1,0],[0,1,0]]})";
    for (const std::string name : {"a.png", "b.png"})
        REQUIRE(run_strata(folder, {"render", "planes:count=2", "--size", "8x8", "-o", name}).status == 0);
    REQUIRE(shell(folder, "strata list profiles ideal --json > p.json").status == 0);
    std::ofstream(folder / "t.json") << scene;
    const std::string render = "strata render ", size = " --size 8x8 ";
    for (const auto& [command, file] : std::vector<std::pair<std::string, std::string>>{
             {render + "t.json --stats t.json -o new.png", "t.json"},
             {render + "t.json --stats ./t.json -o new.png", "t.json"},
             {render + "t.json --profile p.json --stats p.json -o new.png", "p.json"},
             {"strata bench t.json --algorithm dual --repeat 1 --warm-up 0 -o t.json", "t.json"},
             {"strata compare a.png b.png --heat b.png", "b.png"},
             {"strata compare t.json a.png --side a.png", "a.png"}}) {
        INFO(command);
        const std::string before = content_of(folder / file);
        const CommandResult ended = shell(folder, command + (command.find("compare a") == command.npos ? size : ""));
        CHECK(ended.status == 2);
        CHECK(ended.err.find(file + ": is a file that this command reads") != std::string::npos);
        CHECK(content_of(folder / file) == before);
    }
    CHECK_FALSE(std::filesystem::exists(folder / "new.png"));
}

TEST_CASE("a picture for a standard output that is closed is an error") {
    const Folder folder;
    const CommandResult ended = shell(folder, "strata render planes:count=2 --size 8x8 -o - >&-");
    CHECK(ended.status == 3);
    CHECK(ended.err == "strata: -: cannot write: Bad file descriptor\n");
}
