// Tests `strata compare` with files that the command wrote and copies of them that are changed or truncated. The exit
// statuses are those of tools/docs/commands.md.
#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/tools/program.h"

using namespace strata::test;

TEST_CASE("compare exits with 0 for equal pictures and 1 for different ones and 2 for a file that is not a picture") {
    const Folder folder;
    REQUIRE(shell(folder,
                  "strata render teapot --size 48x36 -o a.exr && strata render teapot --size 48x36 -o a.png && "
                  "strata render teapot --size 48x36 --orbit 31,20 -o b.png")
                .status == 0);
    const CommandResult same = run_strata(folder, {"compare", "a.exr", "a.png"});
    CHECK(same.status == 0);
    CHECK(same.out == "equal\n  not compared: depth: in the reference alone\n");
    const CommandResult other = run_strata(folder, {"compare", "a.png", "b.png", "--json", "--heat", "heat.png",
                                                    "--side", "side.png", "--junit", "report.xml"});
    CHECK(other.status == 1);
    const auto document = nlohmann::json::parse(other.out);
    CHECK_FALSE(document["equal"].get<bool>());
    CHECK(document["differing"].get<int>() > 0);
    CHECK(folder.files().size() == 6);
    CHECK(content_of(folder / "report.xml").find("<failure") != std::string::npos);
    CHECK(run_strata(folder, {"compare", "a.png", "b.png", "--tolerance", "color=255,coverage=2000"}).status == 0);
    CHECK(run_strata(folder, {"compare", "a.png", "none.png"}).status == 2);
    CHECK(run_strata(folder, {"compare", "a.png", "none"}).err == "strata: none: no such file\n");
    CHECK(run_strata(folder, {"compare", "-q", "a.png", "a.png"}).out == "equal\n");
    CHECK(run_strata(folder, {"compare", "-v", "--color", "never", "a.png", "a.png"}).status == 0);
    std::ofstream{folder / "cut.exr"} << content_of(folder / "a.exr").substr(0, 200);
    CHECK(run_strata(folder, {"compare", "a.exr", "cut.exr"}).status == 2);
}

TEST_CASE("compare uses the given background and distinguishes lost coverage from another background") {
    const Folder folder;
    REQUIRE(shell(folder,
                  "strata render planes:count=1,cells=1 --size 24x18 --background 0.2,0.4,0.6 -o a.png && "
                  "strata render planes:count=1,cells=1 --size 24x18 --background 0.2,0.4,0.7 -o b.png")
                .status == 0);
    const auto kinds = [&](const std::vector<std::string>& more) {
        std::vector<std::string> words{"compare", "a.png", "b.png", "--json"};
        words.insert(words.end(), more.begin(), more.end());
        const CommandResult ended = run_strata(folder, words);
        CHECK(ended.status == 1);
        const auto document = nlohmann::json::parse(ended.out);
        std::vector<std::string> found;
        for (const auto& kind : document["kinds"]) found.push_back(kind["kind"]);
        return found;
    };
    CHECK(kinds({"--background", "0.2,0.4,0.6"}) == std::vector<std::string>{"background"});
    CHECK(kinds({"--background", "0.9,0.9,0.9"}) == std::vector<std::string>{"color"});  // every pixel counts as drawn
    CHECK(run_strata(folder, {"compare", "a.png", "b.png", "--background", "0.2"}).err ==
          "strata: --background: expected none, or three or four numbers from 0 to 1 such as 0.2,0.2,0.3 or 0,0,0,0.5, "
          "found '0.2'\n");
}

TEST_CASE("heat maps and side-by-side comparisons of a folder are drawn for each algorithm") {
    const Folder folder;
    REQUIRE(shell(folder,
                  "strata golden teapot --size 24x18 --algorithm dual,front_to_back -o pack && "
                  "strata golden teapot --size 24x18 --algorithm dual,front_to_back --alpha 0.5 -o other")
                .status == 0);
    REQUIRE(run_strata(folder, {"compare", "pack", "other", "--heat", "heat.png", "--side", "side.png"}).status == 1);
    CHECK(folder.files() == std::vector<std::string>{"heat.dual.png", "heat.front_to_back.png", "other", "pack",
                                                     "side.dual.png", "side.front_to_back.png"});
    REQUIRE(run_strata(folder, {"compare", "pack", "other", "--algorithm", "dual", "--heat", "one.png"}).status == 1);
    CHECK(content_of(folder / "one.png") == content_of(folder / "heat.dual.png"));
    // The single files of pack and folder, compared directly.
    REQUIRE(run_strata(folder, {"compare", "pack/expected/dual/picture.npy", "other/expected/dual/picture.npy",
                                "--heat", "alone.png"})
                .status == 1);
    CHECK(content_of(folder / "alone.png").size() > 0);
    REQUIRE(run_strata(folder, {"compare", "pack", "other", "--junit", "cases.xml"}).status == 1);
    const std::string cases = content_of(folder / "cases.xml");
    for (const char* part :
         {"tests=\"6\" failures=\"6\"", "classname=\"strata.compare.dual\" name=\"layers\"",
          "classname=\"strata.compare.front_to_back\" name=\"passes\"", "<failure message=\"pass 0, a geometry pass"}) {
        INFO(part);
        CHECK(cases.find(part) != std::string::npos);
    }
    REQUIRE(run_strata(folder, {"compare", "pack", "pack", "--junit", "right.xml"}).status == 0);
    CHECK(content_of(folder / "right.xml").find("failures=\"0\"") != std::string::npos);
}

TEST_CASE("deep files are compared by their layers") {
    const Folder folder;
    REQUIRE(shell(folder,
                  "strata layers planes:count=3 --size 16x12 --algorithm front_to_back --deep a.exr && "
                  "strata layers planes:count=2 --size 16x12 --algorithm front_to_back --deep b.exr")
                .status == 0);
    CHECK(run_strata(folder, {"compare", "a.exr", "a.exr"}).out == "equal\n");
    const CommandResult other = run_strata(folder, {"compare", "a.exr", "b.exr"});
    CHECK(other.status == 1);
    CHECK(other.out.find("layer") != std::string::npos);
}

TEST_CASE("compare names what it expected when it is given something else") {
    const Folder folder;
    const auto says = [&](std::vector<std::string> words) {
        words.insert(words.begin(), {"compare", "a.raw", "b.raw"});
        return run_strata(folder, words).err;
    };
    CHECK(says({"--tolerance", "colour"}) ==
          "strata: --tolerance: expected color=N, depth=N, TARGET=N, coverage=N, background=N, layers=N, "
          "depth-pixels=N, color-pixels=N, unseen=N, not-finite=N and pixels=N with commas between, pixels also as a "
          "share such as "
          "0.02%, found 'colour'\n");
    CHECK(says({"--layout", "3x3"}) ==
          "strata: --layout: expected WIDTHxHEIGHT:FORMAT such as 640x480:rgba8, bgra8, rgb10a2, rgb16, rgba32f, d24, "
          "d24s8 or d32f, and :bottom-up if the lowest row comes first, :offset=BYTES for a header, :stride=BYTES from "
          "row to "
          "row, "
          "found '3x3'\n");
    CHECK(says({"--heat", "heat.exr"}) == "strata: --heat: expected a file that ends in .png, found 'heat.exr'\n");
    CHECK(says({}) == "strata: a.raw: no such file\n");
    std::ofstream{folder / "a.raw"} << "abc";
    CHECK(says({}) ==
          "strata: a.raw: name: expected a file that ends in .exr, .npy, .png, .jpg, .ppm, .pgm, .tga, .bmp, .tif or "
          ".hdr, or --layout for a file of raw numbers, found another ending\n");
}

// Four pixels, one of which differs in blue: as grey, and as bytes in the order blue, green, red after a header.
TEST_CASE("pictures of other programs are compared by the meaning of their channels within a budget of pixels") {
    using namespace std::string_literals;
    const Folder folder;
    const auto put = [&](const char* name, const std::string& bytes) {
        std::ofstream(folder / name, std::ios::binary) << bytes;
    };
    const std::string head = "P6\n4 1\n255\n";
    put("a.ppm", head + "\1\2\3\4\5\6\7\7\7\7\7\7"s);
    put("b.ppm", head + "\1\2\3\4\5\x46\7\7\7\7\7\7"s);
    put("c.raw", "BM\3\2\1\6\5\4\7\7\7\7\7\7"s);
    put("d.pgm", "P5\n4 1\n255\n\1\4\7\7"s);
    const auto compared = [&](std::vector<std::string> words) {
        words.insert(words.begin(), "compare");
        return run_strata(folder, words);
    };
    CHECK(compared({"a.ppm", "b.ppm"}).status == 1);
    CHECK(compared({"a.ppm", "b.ppm", "--tolerance", "color=63"}).status == 1);
    CHECK(compared({"a.ppm", "b.ppm", "--tolerance", "color=64"}).status == 0);
    const CommandResult spent = compared({"a.ppm", "b.ppm", "--tolerance", "color=2,pixels=1"});
    CHECK(spent.status == 0);
    CHECK_THAT(spent.out, Catch::Contains("pixels: 1 of 1 pixels spent"));
    CHECK(compared({"a.ppm", "b.ppm", "--tolerance", "pixels=25%"}).status == 0);
    CHECK(compared({"a.ppm", "b.ppm", "--tolerance", "pixels=24%"}).status == 1);
    CHECK(compared({"a.ppm", "c.raw", "--layout", "4x1:bgr8:offset=2"}).out == "equal\n");
    const CommandResult grey = compared({"a.ppm", "d.pgm"});
    CHECK(grey.status == 1);
    CHECK_THAT(grey.out, Catch::Contains("different: 2 of 4 pixels differ") &&
                             Catch::Contains("the candidate is grey, which counts as equal red, green and blue"));
}

TEST_CASE("a picture with the lower left corner first is correct if that origin is given") {
    const Folder folder;
    const std::vector<std::string> scene{"random:triangles=60", "--size", "40x31", "--profile", "llvmpipe"};
    const auto run = [&](std::vector<std::string> words, const std::vector<std::string>& more) {
        words.insert(words.end(), scene.begin(), scene.end());
        words.insert(words.end(), more.begin(), more.end());
        return words;
    };
    REQUIRE(run_strata(folder, run({"render"}, {"--origin", "lower-left", "-o", "gl.png"})).status == 0);
    const auto compared = [&](std::vector<std::string> more) {
        more.insert(more.begin(), {"compare", scene[0], "gl.png", "--profile", "llvmpipe"});
        return run_strata(folder, more);
    };
    const CommandResult right = compared({"--origin", "lower-left"});
    INFO(right.out << right.err);
    CHECK(right.status == 0);
    CHECK(compared({"--exact", "--algorithm", "dual", "--origin", "lower-left"}).out == "equal\n");
    CHECK(compared({"--exact", "--algorithm", "dual"}).status == 1);
}

TEST_CASE("32-bit codes are compared in every bit and a difference in the lowest bit is found") {
    const Folder folder;
    std::string bytes(16, '\x7f');
    std::ofstream{folder / "a.raw"} << bytes;
    bytes[8] ^= 1;
    std::ofstream{folder / "b.raw"} << bytes;
    const CommandResult found = run_strata(folder, {"compare", "a.raw", "b.raw", "--layout", "2x2:d32f"});
    CHECK(found.status == 1);
    CHECK(found.out.find("differ by at most 1 codes") != std::string::npos);
}

namespace {

// A pack, and a folder "mine" of a port with its picture of dual. `changes`: one byte of that picture is changed.
void make_folders(const Folder& folder, bool changes) {
    REQUIRE(run_strata(folder, {"golden", "planes:count=2", "--size", "16x12", "--algorithm", "dual", "-o", "pack"})
                .status == 0);
    std::filesystem::create_directories(folder / "mine/dual");
    std::string picture = content_of(folder / "pack/expected/dual/picture.npy");
    if (changes) picture.at(picture.size() - 4 * 16 * 6 - 4 * 8) ^= 0x55;
    std::ofstream(folder / "mine/dual/picture.npy", std::ios::binary) << picture;
}

std::size_t number_of(const std::string& text, const std::string& part) {
    std::size_t number = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++number;
    return number;
}

}  // namespace

TEST_CASE("comparing a pack with a port's folder writes a page with both pictures and their differences") {
    const Folder folder;
    make_folders(folder, true);
    const CommandResult ended = run_strata(folder, {"compare", "pack", "mine/", "--report", "page.html"});
    INFO(ended.err);
    REQUIRE(ended.status == 1);
    const std::string page = content_of(folder / "page.html");
    CHECK(number_of(page, "<h1>Different</h1>") == 1);
    CHECK(number_of(page, "<p>strata compare pack mine</p>") == 1);
    CHECK(number_of(page, "<img src=\"data:image/png;base64,") == 4);
    CHECK(number_of(page, "<p class=\"lead\">0 of 1 algorithm comes out as the pack has it.</p>") == 1);
    CHECK(number_of(page, "<li>Picture: ") == 1);
    CHECK(number_of(page, "<div class=\"scale\">") == 1);
    CHECK(page.find(folder / "") == std::string::npos);
}

TEST_CASE("comparing a pack with an equal folder of a port says on its page that they are equal") {
    const Folder folder;
    make_folders(folder, false);
    REQUIRE(run_strata(folder, {"compare", "pack", "mine", "--report", "page.html"}).status == 0);
    CHECK(number_of(content_of(folder / "page.html"), "<h1>Equal</h1>") == 1);
    CHECK(number_of(content_of(folder / "page.html"), "<li>Picture: equal in every bit.</li>") == 1);
}

TEST_CASE("an algorithm without files of the candidate is not counted as correct on the page") {
    const Folder folder;
    REQUIRE(shell(folder,
                  "strata golden planes:count=2 --size 8x8 --algorithm dual,front_to_back -o pack -q && "
                  "mkdir mine && cp -r pack/expected/dual mine/dual && "
                  "strata compare pack mine --report page.html")
                .status == 0);
    CHECK(number_of(content_of(folder / "page.html"),
                    "<p class=\"lead\">1 of 1 algorithm comes out as the pack has it; 1 is not compared.</p>") == 1);
    CHECK(number_of(content_of(folder / "page.html"), "<li>Passes: all ") == 1);
}

TEST_CASE("the verdict of compare is green if equal or red if different or yellow within the tolerance") {
    const Folder folder;
    make_folders(folder, true);
    REQUIRE(shell(folder,
                  "strata render teapot --size 48x36 -q -o a.png && "
                  "strata render teapot --size 48x36 --orbit 31,20 -q -o b.png")
                .status == 0);
    const auto first_line = [&](std::vector<std::string> words) {
        words.insert(words.begin(), {"--color", "always", "compare"});
        return lines_of(run_strata(folder, words).out).at(0);
    };
    CHECK(first_line({"a.png", "a.png"}) == "\x1b[1;32mequal\x1b[0m");
    CHECK(first_line({"a.png", "b.png"}).starts_with("\x1b[1;31mdifferent\x1b[0m: "));
    CHECK(first_line({"a.png", "b.png", "--tolerance", "color=255,coverage=2000"})
              .starts_with("\x1b[1;33maccepted\x1b[0m: "));
    CHECK(first_line({"pack", "mine"}) == "dual: \x1b[1;31mdifferent\x1b[0m");
    CHECK(run_strata(folder, {"compare", "a.png", "a.png"}).out == "equal\n");  // standard output is not a terminal
    CHECK(run_strata(folder, {"--color", "always", "compare", "a.png", "a.png", "--json"}).out.find('\x1b') ==
          std::string::npos);
}
