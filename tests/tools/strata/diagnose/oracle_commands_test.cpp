// Tests `passes`, `layers` and `explain` against other commands on the same scene: digests of the picture, numbers of
// passes, fragments.
#include <algorithm>
#include <catch2/catch.hpp>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/tools/program.h"

using namespace strata::test;

TEST_CASE("passes writes a file per pass and a list of them and the last file has the picture's digest") {
    const Folder folder;
    const CommandResult render = run_strata(folder, {"render", "teapot", "--size", "40x30", "--stats", "-"});
    const nlohmann::json stats = nlohmann::json::parse(render.out)[0];
    const CommandResult ended = run_strata(folder, {"passes", "teapot", "--size", "40x30", "-o", "out"});
    REQUIRE(ended.status == 0);
    const nlohmann::json document = nlohmann::json::parse(content_of(folder / "out/passes.json"));
    const nlohmann::json& passes = document["passes"];
    int geometry = 0;
    for (const nlohmann::json& pass : passes) {
        geometry += pass["kind"] == "geometry" ? 1 : 0;
        CHECK(std::filesystem::is_regular_file(folder / ("out/" + pass["file"].get<std::string>())));
    }
    CHECK(geometry == stats["geometry_passes"].get<int>());
    CHECK(passes.back()["targets"][0]["digest"] == stats["digest"]["color"]);
    CHECK(std::filesystem::is_regular_file(folder / "out/contact.png"));
    const CommandResult digest =
        shell(folder, "strata info --digests --json out/" + passes.back()["file"].get<std::string>());
    CHECK(nlohmann::json::parse(digest.out)[0]["digest"] == stats["digest"]["color"]);
    CHECK(lines_of(ended.out).size() == passes.size() + 1);
}

TEST_CASE("passes of a second run replace those of the first and one of two runs at once writes a folder") {
    const Folder folder;
    const auto passes = [&](const char* algorithm) {
        return run_strata(folder, {"passes", "planes:count=2", "--size", "8x8", "--algorithm", algorithm, "-o", "out"});
    };
    REQUIRE(passes("front_to_back").status == 0);
    const std::size_t before = nlohmann::json::parse(content_of(folder / "out/passes.json"))["passes"].size();
    std::ofstream{folder / "out/own.exr"} << "kept";
    REQUIRE(passes("weighted_average").status == 0);
    const std::size_t after = nlohmann::json::parse(content_of(folder / "out/passes.json"))["passes"].size();
    REQUIRE(after < before);
    std::size_t files = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder / "out"))
        files += entry.path().filename().string().starts_with("pass.") ? 1 : 0;
    CHECK(files == after);
    CHECK(std::filesystem::exists(folder / "out/own.exr"));
    std::ofstream{folder / "out/.strata.lock"};
    const CommandResult second = passes("front_to_back");
    CHECK(second.status == 2);
    CHECK(second.err ==
          "strata: out: is being written by another run; if there is none, remove its file .strata.lock\n");
    const CommandResult many =
        shell(folder,
              "for i in 1 2 3 4 5; do strata golden planes:count=2 --size 8x8 -q -o pack & done; "
              "wait; strata golden --check pack");
    CHECK(many.status == 0);
    CHECK(lines_of(many.err).size() == 4);
}

TEST_CASE("passes of a rejected algorithm are reported as rejected and the others are written") {
    const Folder folder;
    const CommandResult ended = run_strata(folder, {"passes", "teapot", "--size", "16x12", "--profile", "geforce3",
                                                    "--algorithm", "depth_units,dual", "-o", "out"});
    CHECK(ended.status == 0);
    CHECK(ended.err.find("strata: dual: profile geforce3 has no ") != std::string::npos);
    CHECK(std::filesystem::is_regular_file(folder / "out/depth_units.passes.json"));
    CHECK_FALSE(std::filesystem::exists(folder / "out/dual.passes.json"));
    CHECK(run_strata(folder, {"passes", "teapot"}).err == "strata: -o is missing: the folder for the files\n");
}

TEST_CASE(
    "the layers of a dual peel come from both ends in order from near and equal those of front-to-back without ties") {
    const Folder folder;
    REQUIRE(shell(folder,
                  "strata layers planes --size 40x30 --algorithm dual -o dual.exr && "
                  "strata layers planes --size 40x30 --algorithm front_to_back -o front.exr")
                .status == 0);
    const auto parts_of = [&](const std::string& file) {
        std::vector<std::string> parts;
        for (const nlohmann::json& target :
             nlohmann::json::parse(shell(folder, "strata info --digests --json " + file).out))
            if (target["target"] == "color") parts.push_back(target["part"]);
        return parts;
    };
    const auto dual = parts_of("dual.exr"), front = parts_of("front.exr");
    CHECK(dual.size() == front.size());
    const auto is_front = [](const std::string& part) { return part.starts_with("front."); };
    CHECK(std::ranges::is_partitioned(dual, is_front));
    CHECK(dual.front() == "front.000");
    CHECK(dual.back() == "back.000");
}

TEST_CASE("explain describes a pixel in text and as JSON and reports the valid pixels") {
    const Folder folder;
    const CommandResult text = run_strata(
        folder, {"explain", "teapot", "--size", "40x30", "--pixel", "20,15", "--algorithm", "dual,front_to_back"});
    CHECK(text.status == 0);
    CHECK(text.out.starts_with("pixel 20,15 by dual on geforce8: "));
    CHECK(text.out.find("pixel 20,15 by front_to_back on geforce8: ") != std::string::npos);
    const CommandResult ended = run_strata(
        folder, {"explain", "teapot", "--size", "40x30", "--pixel", "20,15", "--json", "--svg", "column.svg"});
    const nlohmann::json document = nlohmann::json::parse(ended.out);
    CHECK(document["histories"][0]["pixel"] == nlohmann::json({20, 15}));
    CHECK(document["histories"][0]["fragments"].size() > 1);
    CHECK(document["histories"][0]["fragments"][0]["depth"].size() == 9);
    CHECK(content_of(folder / "column.svg").starts_with("<svg "));
    CHECK(run_strata(folder, {"explain", "teapot", "--size", "40x30", "--pixel", "40,0"}).err ==
          "strata: --pixel: expected a pixel from 0,0 to 39,29, found 40,0\n");
    CHECK(run_strata(folder, {"explain", "teapot"})
              .err.find("--pixel: expected a pixel from 0,0 to 1023,1023, found none") != std::string::npos);
    CHECK(run_strata(folder, {"explain", "teapot", "--pixel", "4"}).err ==
          "strata: --pixel: expected two whole numbers from 0 such as 320,200, found '4'\n");
}

TEST_CASE("explain describes the algorithms that are not refused and reports the others") {
    const Folder folder;
    const auto explained = [&](const char* algorithms) {
        return run_strata(folder, {"explain", "teapot", "--size", "32x24", "--pixel", "16,12", "--profile", "geforce3",
                                   "--algorithm", algorithms});
    };
    const CommandResult both = explained("dual,depth_units");
    CHECK(both.status == 0);
    CHECK(both.err.find("strata: dual: profile geforce3 has no ") == 0);
    CHECK(both.out == explained("depth_units").out);
    const CommandResult none = explained("dual,front_to_back");
    CHECK(none.status == 2);
    CHECK(none.out.empty());
}

TEST_CASE("render --mistake warns of a mistake that changes no pixel of the picture") {
    const Folder folder;
    const auto rendered = [&](const char* mistake) {
        return run_strata(folder, {"render", "teapot", "--size", "32x24", "--algorithm", "front_to_back", "--mistake",
                                   mistake, "-o", "a.png"});
    };
    const CommandResult same = rendered("order_reversed");  // no two depths of a pixel are equal
    CHECK(same.status == 0);
    CHECK(same.err.find("--mistake order_reversed changes no pixel of this picture") != std::string::npos);
    const CommandResult other = rendered("one_pass_too_few");
    CHECK(other.status == 0);
    CHECK(other.err.empty());
}

TEST_CASE("passes writes nothing if a folder has the name of one of its files") {
    const Folder folder;
    const std::string name = GENERATE("contact.png", "pass.002.exr", "dual.passes.json");
    std::filesystem::create_directories(folder / ("taken/" + name));
    const CommandResult ended = run_strata(folder, {"passes", "planes:count=1", "--size", "8x8", "-o", "taken"});
    CHECK(ended.status == 2);
    CHECK(ended.err == "strata: taken/" + name + ": is a folder, not a file\n");
    std::filesystem::remove(folder / ("taken/" + name));
    CHECK(std::filesystem::is_empty(folder / "taken"));
}
