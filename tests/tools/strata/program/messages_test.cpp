// Tests messages against tools/docs/commands.md: which stream they go to, how many there are, and which bytes they may
// contain. script(1) provides a terminal.
#include "tools/strata/messages.h"

#include <catch2/catch.hpp>
#include <fstream>
#include <regex>

#include "scenes/printable.h"
#include "tests/support/skip.h"
#include "tests/tools/program.h"

using namespace strata::test;

namespace {

constexpr const char* escape = "\x1b";

// Output of the command on a terminal, both streams; "" if script(1) is not installed.
std::string on_terminal(const Folder& folder, const std::string& command, const std::string& no_color = "") {
    const CommandResult ended = shell(folder, "script -qec '" + command + "' /dev/null < /dev/null",
                                      {.environment = {{"TERM", "xterm"}, {"NO_COLOR", no_color}}});
    return ended.status == 127 ? "" : ended.out;
}

std::string warned_scene(const Folder& folder) {
    std::ofstream(folder / "empty.gltf") << R"({"asset":{"version":"2.0"}})";
    return "empty.gltf";
}

}  // namespace

TEST_CASE("quiet omits only warnings and notes and the table next to a picture") {
    const Folder folder;
    const std::string scene = warned_scene(folder);
    CHECK(run_strata(folder, {"render", scene, "--size", "8x8", "-o", "a.png"}).err.find("warning") !=
          std::string::npos);
    const CommandResult quiet = run_strata(folder, {"render", scene, "--size", "8x8", "-q", "-o", "b.png"});
    CHECK(quiet.status == 0);
    CHECK(quiet.err.empty());
    CHECK(quiet.out.empty());
    CHECK(content_of(folder / "a.png") == content_of(folder / "b.png"));
    CHECK(run_strata(folder, {"info", "--digests", "-q", "b.png"}).out ==
          run_strata(folder, {"info", "--digests", "b.png"}).out);
    const CommandResult wrong = run_strata(folder, {"-q", "render", "none.glb"});
    CHECK(wrong.status == 2);
    CHECK(wrong.err.starts_with("strata: none.glb: "));
}

TEST_CASE("a scene without triangles is reported with a suggestion") {
    const Folder folder;
    const CommandResult one = run_strata(folder, {"scene", warned_scene(folder)});
    CHECK(one.status == 0);
    CHECK(one.err ==
          "strata: warning: empty.gltf: nothing would be drawn, because the scene has no triangles, lines or points; "
          "export its meshes, or try a built-in scene: strata list scenes shows them\n");
    std::ofstream(folder / "three.gltf") << R"({"asset":{"version":"2.0"},"scenes":[{},{},{}]})";
    CHECK(run_strata(folder, {"scene", "three.gltf"})
              .err.ends_with("--scene N, 0 to 2, chooses another scene of the file\n"));
    CHECK(run_strata(folder, {"scene", "planes:count=1"}).err.empty());
}

TEST_CASE("verbose reports inputs and outputs and the time of each step and changes no result") {
    const Folder folder;
    const std::vector<std::string> words{"render", "planes:count=2", "--size", "8x8", "-o", "a.png"};
    auto verbose = words;
    verbose.emplace_back("--verbose");
    REQUIRE(run_strata(folder, words).err.empty());
    const std::string before = content_of(folder / "a.png");
    const auto lines = lines_of(run_strata(folder, verbose).err);
    REQUIRE(lines.size() == 5);
    const auto says = [](const std::string& line, const char* pattern) {
        return std::regex_match(line, std::regex{pattern});
    };
    CHECK(says(lines[0], R"(strata: read planes:count=2: meshes: 1, drawn: 1, in \d+\.\d+ s)"));
    CHECK(lines[1] == "strata: wrote a.png");
    CHECK(lines[2] == "strata: dual: resolved");
    CHECK(says(lines[3], R"(strata: dual: \d+\.\d+ s.*)"));
    CHECK(says(lines[4], R"(strata: done in \d+\.\d+ s, with at most \d+ MiB of memory)"));
    CHECK(content_of(folder / "a.png") == before);
}

TEST_CASE("a terminal gets colours unless NO_COLOR or --color disables them and a pipe gets none unless requested") {
    const Folder folder;
    const std::string piped = run_strata(folder, {"rendr"}).err;
    CHECK(piped.find(escape) == std::string::npos);
    CHECK(run_strata(folder, {"--color", "always", "info", "--digests", "none"})
              .err.starts_with("\x1b[1;31mstrata:\x1b[0m none: "));
    const std::string always = run_strata(folder, {"list", "scenes", "--color", "always"}).out;
    CHECK(always.starts_with("\x1b[1mscene"));
    std::string without = always;
    for (const std::string code : {"\x1b[1m", "\x1b[0m"}) without.erase(without.find(code), code.size());
    CHECK(without == run_strata(folder, {"list", "scenes"}).out);
    if (on_terminal(folder, "true") != on_terminal(folder, "echo x")) {
        CHECK(on_terminal(folder, "strata rendr").find("\x1b[1;31mstrata:") != std::string::npos);
        CHECK(on_terminal(folder, "strata rendr", "1").find(escape) == std::string::npos);
        CHECK(on_terminal(folder, "strata --color never digest x").find(escape) == std::string::npos);
        CHECK(on_terminal(folder, "strata render planes --size 8x8 -o -").find("a terminal cannot show") !=
              std::string::npos);
    } else {
        skip("script was not found: no terminal is tried");
    }
}

TEST_CASE("a picture on standard output has the bytes of the file and is appended to earlier output") {
    const Folder folder;
    const std::string render = "strata render planes:count=2 --size 8x8 ";
    REQUIRE(shell(folder, render + "-o a.png && " + render + "-o a.exr").status == 0);
    CHECK(shell(folder, render + "-o - | cmp - a.png").status == 0);
    CHECK(shell(folder, render + "-o - --format exr | cmp - a.exr").status == 0);
    CHECK(shell(folder, "(echo x; " + render + "-o -) > b && tail -c +3 b | cmp - a.png").status == 0);
    CHECK(shell(folder, render + "-o /dev/stdout > c && cmp c a.png").status == 0);
    const CommandResult piped = shell(folder, render + "-o - > d");
    CHECK(lines_of(piped.err).size() == 2);  // the table
    CHECK(shell(folder, render + "-q -o - > d").err.empty());
    CHECK(shell(folder,
                "strata layers planes:count=2 --size 8x8 -o - > l && strata layers planes:count=2 --size 8x8 -o l.exr "
                "&& cmp l l.exr")
              .status == 0);
    for (const std::string wrong : {"--algorithm all -o -", "--stats - -o -", "--format exr -o x.png"})
        CHECK(shell(folder, render + wrong + " > e").status == 2);
    CHECK(folder.files() == std::vector<std::string>{"a.exr", "a.png", "b", "c", "d", "e", "l", "l.exr"});
}

TEST_CASE("no control character of a name or of a file reaches either stream and JSON stays valid") {
    const Folder folder;
    REQUIRE(run_strata(folder, {"render", "planes:count=2", "--size", "8x8", "-o", "a.png"}).status == 0);
    const std::string evil = "e\x1b[2J\x07\x7f\xc2\x9b.png";
    std::filesystem::copy_file(folder / "a.png", folder / evil);
    std::ofstream(folder / "mesh.gltf")
        << R"({"asset":{"version":"2.0"},"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],"meshes":[{"name":"m\u001b[2J\u009b","primitives":[]}]})";
    for (const std::vector<std::string>& words :
         std::vector<std::vector<std::string>>{{"info", "--digests", evil},
                                               {"info", "--digests", "--json", evil},
                                               {"info", evil},
                                               {"compare", evil, evil},
                                               {"scene", evil},
                                               {"scene", "mesh.gltf"},
                                               {"scene", "--json", "mesh.gltf"},
                                               {"render", "mesh.gltf", "--size", "8x8"},
                                               {"render", evil},
                                               {evil},
                                               {"render", "planes", "--camera", evil}}) {
        const CommandResult ended = run_strata(folder, words);
        const std::string both = ended.out + ended.err;
        INFO(words[0] << " " << both);
        for (const std::string raw : {"\x1b", "\x07", "\x7f", "\xc2\x9b"}) CHECK(both.find(raw) == std::string::npos);
    }
    CHECK(run_strata(folder, {"info", "--digests", "--json", evil}).out.find(R"("e\u001b[2J\u0007\u007f\u009b.png")") !=
          std::string::npos);
    CHECK(strata::scenes::shortened("\u00e4bcdef", 6) == "\u00e4bcdef");
    CHECK(strata::scenes::shortened("\u00e4bcdef\xff", 6) == "\u00e4bc...");
    CHECK(strata::scenes::printable("a\n\x9f\xc2\x80\xc2\xa0") == "a\\x0a\\x9f\\u0080\xc2\xa0");
}

TEST_CASE("every fault of a glTF file is reported on its own line") {
    const Folder folder;
    std::ofstream(folder / "bad.gltf")
        << R"({"asset":{"version":"3.0"},"extensionsRequired":["A_b"],"materials":[{"alphaMode":"X"},{"alphaCutoff":-1}],)"
        << R"("nodes":[{"mesh":3},{"children":[9]}],"cameras":[{"type":"none"}]})";
    const CommandResult ended = run_strata(folder, {"scene", "bad.gltf"});
    CHECK(ended.status == 2);
    const auto lines = lines_of(ended.err);
    REQUIRE(lines.size() == 7);
    const std::vector<std::string> places{"/asset/version",           "/extensionsRequired/0", "/materials/0/alphaMode",
                                          "/materials/1/alphaCutoff", "/cameras/0/type",       "/nodes/0/mesh",
                                          "/nodes/1/children/0"};
    for (std::size_t i = 0; i < places.size(); ++i)
        CHECK(lines[i].starts_with("strata: bad.gltf: " + places[i] + ": "));
    std::ofstream many(folder / "many.gltf");
    many << R"({"asset":{"version":"2.0"},"nodes":[{"mesh":0})";
    for (int i = 0; i < 29; ++i) many << R"(,{"mesh":0})";
    many << "]}";
    many.close();
    const auto told = lines_of(run_strata(folder, {"scene", "many.gltf"}).err);
    REQUIRE(told.size() == 21);
    CHECK(told.back() == "strata: 10 more errors are not shown");
}

TEST_CASE("an interrupt reports which files are missing") {
    const std::string missing =
        "strata: interrupted; 0 of 2 algorithms are done; not written: a.dual.png, a.painter.png\n";
    int told = 0;
    std::string wrong;
    for (int delay = 20; delay <= 2560 && told == 0; delay += delay) {
        const Folder folder;
        const CommandResult render = run_strata(folder,
                                                {"render", "random:seed=3,triangles=100000", "--size", "2048x2048",
                                                 "--algorithm", "dual,painter", "--no-audit", "-o", "a.png"},
                                                {.interrupt_after_ms = delay});
        told += render.err == missing ? 1 : 0;
        // Before main() installs its handlers, the system ends the process without a message.
        if (render.status == 130 && render.err != missing && !render.err.empty() &&
            !render.err.starts_with("strata: interrupted"))
            wrong = render.err;
    }
    CHECK(wrong == "");
    CHECK(told > 0);
}
