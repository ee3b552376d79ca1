// Tests that the documentation lists what the command-line parser accepts: every option of every command is in its
// help and in the completions. bash itself completes.
#include <catch2/catch.hpp>
#include <cstdlib>
#include <fstream>
#include <set>

#include "tests/support/skip.h"
#include "tests/tools/program.h"

using namespace strata::test;

namespace {

// The long options that --help all lists.
std::set<std::string> listed_options(const Folder& folder, const std::string& verb) {
    std::set<std::string> names;
    for (const std::string& line : lines_of(run_strata(folder, {verb, "--help", "all"}).out)) {
        const std::size_t at = line.find("--");
        if (line.starts_with("  -") && at < 8) names.insert(line.substr(at, line.find_first_of(" ,", at) - at));
    }
    return names;
}

}  // namespace

TEST_CASE("help of a command is its --help and all adds the rare options") {
    const Folder folder;
    const CommandResult usual = run_strata(folder, {"help", "render"}),
                        all = run_strata(folder, {"help", "render", "all"});
    CHECK(usual.status == 0);
    CHECK(usual.out == run_strata(folder, {"render", "--help"}).out);
    CHECK(all.out == run_strata(folder, {"render", "--help", "all"}).out);
    for (const std::string rare : {"--depth-path", "--termination", "--simd"}) {
        CHECK(usual.out.find("  " + rare) == std::string::npos);
        CHECK(all.out.find("  " + rare) != std::string::npos);
    }
    CHECK(usual.out.find("strata render --help all") != std::string::npos);
    CHECK(all.out.find("left out") == std::string::npos);
    CHECK(run_strata(folder, {"help", "rendr"}).err.find("did you mean 'render'") != std::string::npos);
    CHECK(run_strata(folder, {"help", "render", "everything"}).status == 2);
}

TEST_CASE("no help text contains an unusual word or a short option without its long one") {
    const Folder folder;
    std::string wrong;
    for (const std::string& verb : commands()) {
        const std::string help = " " + run_strata(folder, {verb, "--help", "all"}).out;
        for (const char* word : {" tell ", " tells ", " anew", " beside ", " of mine"})
            if (help.find(word) != std::string::npos) wrong += verb + ":" + word + "\n";
        if (help.find("\n  -o ") != std::string::npos) wrong += verb + ": -o without --output\n";
    }
    CHECK(wrong == "");
}

TEST_CASE("completions have every command and every option and bash and zsh read them") {
    const Folder folder;
    const std::string text = run_strata(folder, {"completions"}).out;
    for (const std::string& verb : commands()) {
        INFO(verb);
        CHECK(text.find(verb) != std::string::npos);
        for (const std::string& option : listed_options(folder, verb)) CHECK(text.find(option) != std::string::npos);
    }
    // LC_ALL is set because bash warns of a locale that the machine lacks, such as that of a remote user.
    CHECK(shell(folder, "strata completions > file && LC_ALL=C bash -n file").err.empty());
    if (std::system("command -v zsh >/dev/null 2>&1") != 0) {
        skip("zsh was not found: it does not load the completions");
        return;
    }
    const CommandResult loaded =
        shell(folder, "zsh -fc 'autoload -U compinit bashcompinit && compinit -u && bashcompinit && source ./file'");
    CHECK(loaded.err == "");
    CHECK(loaded.status == 0);
}

TEST_CASE("bash completes commands and their options and values") {
    const Folder folder;
    const auto completed = [&](const std::string& line) {
        const CommandResult ended =
            shell(folder, "LC_ALL=C bash -c 'source <(strata completions); COMP_WORDS=(" + line +
                              "); COMP_CWORD=$((${#COMP_WORDS[@]} - 1)); _strata; echo \"${COMPREPLY[@]}\"'");
        INFO(ended.err);
        CHECK(ended.err.empty());
        return ended.out;
    };
    CHECK(completed("strata rend") == "render\n");
    CHECK(completed("strata render --depth-p") == "--depth-path\n");
    CHECK(completed("strata render --depth-format d2") == "d24 d24f\n");
    CHECK(completed("strata render --algorithm dual_i") == "dual_independent\n");
    CHECK(completed("strata render tea") == "teapot\n");
}

TEST_CASE("a picture stores the command that made it and that command makes the same file again") {
    const Folder folder;
    const std::string ending = GENERATE("png", "exr");
    const std::string file = "a." + ending, copy = "b." + ending;
    REQUIRE(run_strata(folder, {"render", "planes:count=3", "--size", "24x16", "--alpha", "0.25", "-o", file}).status ==
            0);
    const CommandResult told = run_strata(folder, {"info", file});
    CHECK(told.status == 0);
    CHECK(lines_of(told.out).at(0).starts_with("strata render planes:count=3 "));
    CHECK(lines_of(told.out).at(0).find("--alpha 0.25") != std::string::npos);
    REQUIRE(run_strata(folder, {"render", "--from", file, "-o", copy}).status == 0);
    CHECK(content_of(folder / file) == content_of(folder / copy));
    CHECK(
        run_strata(folder, {"layers", "--from=" + file, "-o", "c.exr"}).err.find("found a command of strata render") !=
        std::string::npos);
    CHECK(run_strata(folder, {"render", "--from"}).status == 2);
}

TEST_CASE("a picture of another program has no stored command") {
    const Folder folder;
    // A black pixel, written by hand: IHDR, IDAT and IEND.
    const unsigned char png[] = {0x89, 'P',  'N',  'G',  13,   10,  26,  10,  0,   0,    0,    13,   'I',  'H',
                                 'D',  'R',  0,    0,    0,    1,   0,   0,   0,   1,    8,    2,    0,    0,
                                 0,    0x90, 0x77, 0x53, 0xde, 0,   0,   0,   12,  'I',  'D',  'A',  'T',  0x78,
                                 0x9c, 0x63, 0x60, 0x60, 0x60, 0,   0,   0,   4,   0,    1,    0xf6, 0x17, 0x38,
                                 0x55, 0,    0,    0,    0,    'I', 'E', 'N', 'D', 0xae, 0x42, 0x60, 0x82};
    std::ofstream(folder / "other.png", std::ios::binary).write(reinterpret_cast<const char*>(png), sizeof png);
    const CommandResult ended = run_strata(folder, {"info", "other.png"});
    CHECK(ended.status == 0);
    REQUIRE(lines_of(ended.out).size() == 3);
    CHECK(lines_of(ended.out)[0] == "no command of strata in it");
    CHECK(lines_of(ended.out)[2].find("1x1") != std::string::npos);
    const CommandResult from = run_strata(folder, {"render", "--from", "other.png", "-o", "copy.png"});
    CHECK(from.status == 2);
    CHECK(from.err.find("other.png: strata:command: expected a picture with the command that strata recorded in it") !=
          std::string::npos);
}

TEST_CASE("an expected digest that no file has gives status 1") {
    const Folder folder;
    REQUIRE(run_strata(folder, {"render", "planes:count=2", "--size", "8x8", "-o", "a.png"}).status == 0);
    const std::string digest = lines_of(run_strata(folder, {"info", "--digests", "a.png"}).out).at(1).substr(0, 32);
    CHECK(run_strata(folder, {"info", "--digests", "--expect", digest, "a.png"}).status == 0);
    const std::string other = (digest[0] == '0' ? "1" : "0") + digest.substr(1);
    const CommandResult ended = run_strata(folder, {"info", "--digests", "--expect", other, "a.png"});
    CHECK(ended.status == 1);
    CHECK(ended.err == "strata: --expect: no target has the digest " + other + "\n");
    CHECK(run_strata(folder, {"info", "--digests", "--expect", "zz", "a.png"}).status == 2);
}

TEST_CASE("channels have separate digests that identify where two pictures differ") {
    const Folder folder;
    REQUIRE(run_strata(folder, {"render", "planes:count=1", "--background", "0,0,0", "--size", "8x8", "-o", "a.exr"})
                .status == 0);
    REQUIRE(run_strata(folder, {"render", "planes:count=1", "--background", "0,0,1", "--size", "8x8", "-o", "b.exr"})
                .status == 0);
    const auto of = [&](const std::string& file) {
        return lines_of(run_strata(folder, {"info", "--digests", "--channels", file}).out);
    };
    const auto a = of("a.exr"), b = of("b.exr");
    REQUIRE(a.size() == b.size());
    REQUIRE(a.size() >= 5);
    CHECK(a.at(1).substr(0, 32) == b.at(1).substr(0, 32));  // red
    CHECK(a.at(3).substr(0, 32) != b.at(3).substr(0, 32));  // blue
}

TEST_CASE("statistics written to /dev/stdout are those written to -") {
    const Folder folder;
    const std::vector<std::string> words{"render", "planes:count=1", "--size", "8x8", "--no-audit", "--stats"};
    auto to_dash = words, to_device = words;
    to_dash.emplace_back("-");
    to_device.emplace_back("/dev/stdout");
    const auto digests = [&](const std::vector<std::string>& command) {
        const std::string out = run_strata(folder, command).out;
        return out.substr(out.find("\"digest\""), 100);
    };
    CHECK(digests(to_dash) == digests(to_device));
}

TEST_CASE("a scene may be read from standard input") {
    const Folder folder;
    std::ofstream(folder / "scene.gltf") << R"({"asset":{"version":"2.0"},"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]}],
"bufferViews":[{"buffer":0,"byteLength":36}],
"buffers":[{"byteLength":36,"uri":"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]})";
    const std::string rest = " --size 16x16 --alpha 0.5 --no-audit --stats - 2>&1 | grep -A2 digest";
    const CommandResult file = shell(folder, "strata render scene.gltf" + rest);
    const CommandResult piped = shell(folder, "strata render - < scene.gltf" + rest);
    CHECK(file.out.find("color") != std::string::npos);
    CHECK(piped.out == file.out);
    CHECK(shell(folder, "strata render - < /dev/null").status == 2);
}

TEST_CASE("an unsupported extension that a file requires is rejected with a workaround") {
    const Folder folder;
    for (const auto& [extension, way] :
         {std::pair<std::string, std::string>{"KHR_draco_mesh_compression", "gltf-transform copy"},
          {"EXT_meshopt_compression", "gltf-transform copy"},
          {"KHR_texture_basisu", "gltf-transform ktxdecompress"},
          {"KHR_materials_transmission", "alphaMode BLEND"}}) {
        std::ofstream(folder / "x.gltf") << R"({"asset":{"version":"2.0"},"extensionsUsed":[")" << extension
                                         << R"("],"extensionsRequired":[")" << extension << R"("]})";
        const CommandResult ended = run_strata(folder, {"scene", "x.gltf"});
        INFO(ended.err);
        CHECK(ended.status == 2);
        CHECK(ended.err.find(way) != std::string::npos);
    }
}
