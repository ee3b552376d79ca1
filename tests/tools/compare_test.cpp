// Model: files that the command wrote, copied or cut on purpose; exit statuses of tools/README.md.
#include <catch2/catch.hpp>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/tools/program.h"

using namespace strata::test;

TEST_CASE("compare ends with 0 for equal pictures, with 1 for others and with 2 for what is no picture") {
    const Folder folder;
    REQUIRE(shell(folder,
                  "strata render teapot --size 48x36 -o a.exr && strata render teapot --size 48x36 -o a.png && "
                  "strata render teapot --size 48x36 --orbit 31,20 -o b.png")
                .status == 0);
    const Ended same = run_strata(folder, {"compare", "a.exr", "a.png"});
    CHECK(same.status == 0);
    CHECK(same.out == "equal\n  not compared: depth: in the reference alone\n");
    const Ended other = run_strata(folder, {"compare", "a.png", "b.png", "--json", "--heat", "heat.png", "--side",
                                            "side.png", "--junit", "report.xml"});
    CHECK(other.status == 1);
    const auto document = nlohmann::json::parse(other.out);
    CHECK_FALSE(document["equal"].get<bool>());
    CHECK(document["differing"].get<int>() > 0);
    CHECK(folder.files().size() == 6);
    CHECK(content_of(folder / "report.xml").find("<failure") != std::string::npos);
    CHECK(run_strata(folder, {"compare", "a.png", "b.png", "--tolerance", "color=255,coverage=2000"}).status == 0);
    CHECK(run_strata(folder, {"compare", "a.png", "none.png"}).status == 2);
    std::ofstream{folder / "cut.exr"} << content_of(folder / "a.exr").substr(0, 200);
    CHECK(run_strata(folder, {"compare", "a.exr", "cut.exr"}).status == 2);
}

TEST_CASE("compare says what it wanted where it was given something else") {
    const Folder folder;
    const auto says = [&](std::vector<std::string> words) {
        words.insert(words.begin(), {"compare", "a.raw", "b.raw"});
        return run_strata(folder, words).err;
    };
    CHECK(says({"--tolerance", "colour"}) ==
          "strata: --tolerance: expected color=N, depth=N and coverage=N with commas between, found 'colour'\n");
    CHECK(says({"--layout", "3x3"}) ==
          "strata: --layout: expected WIDTHxHEIGHT:FORMAT such as 640x480:rgba8, rgb16, rgba32f, d24 or d32f, and "
          ":bottom-up if the lowest row comes first, found '3x3'\n");
    CHECK(says({"--heat", "heat.exr"}) == "strata: --heat: expected a file that ends in .png, found 'heat.exr'\n");
    CHECK(says({}) ==
          "strata: a.raw: name: expected a file that ends in .exr, .png or .npy, or --layout for one of bare numbers, "
          "found another ending\n");
}

TEST_CASE("codes of 32 bits are compared bit by bit: the least one of them is a difference") {
    const Folder folder;
    std::string bytes(16, '\x7f');
    std::ofstream{folder / "a.raw"} << bytes;
    bytes[8] ^= 1;
    std::ofstream{folder / "b.raw"} << bytes;
    const Ended found = run_strata(folder, {"compare", "a.raw", "b.raw", "--layout", "2x2:d32f"});
    CHECK(found.status == 1);
    CHECK(found.out.find("differ by at most 1 codes") != std::string::npos);
}
