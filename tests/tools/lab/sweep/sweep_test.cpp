// Tests the sweep on invented rows: its files, which are written when all rows are measured, its shards, its exit
// status.
#include "tools/lab/sweep/sweep.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "rasterizer/base/input_error.h"
#include "tests/tools/program.h"

namespace {

using namespace strata::tools;
using strata::test::content_of;
using strata::test::Folder;

// Row i has the square of i; the rows in `refused` are refused.
Sweep squares(std::size_t rows, std::vector<std::size_t> refused = {}) {
    const auto line = [refused](std::size_t i) {
        const bool is_refused = std::find(refused.begin(), refused.end(), i) != refused.end();
        return nlohmann::ordered_json{
            {"cell", i}, {"outcome", is_refused ? "refused" : "done"}, {"refusal", "no"}, {"square", i * i}};
    };
    return {.name = "squares",
            .rows = rows,
            .description = line,
            .measure =
                [line](std::size_t i) {
                    return MeasuredRow{line(i), {{"cell", i}, {"seconds", 1}}, 1};
                },
            .csv =
                [](const Lines& lines) {
                    std::string text = "square\n";
                    for (const auto& one : lines) text += one.at("square").dump() + '\n';
                    return text;
                },
            .summary = [](const Lines& lines,
                          const Lines& timings) { return std::to_string(lines.size() + timings.size()) + '\n'; },
            .timing_class = [](std::size_t) { return ""; }};
}

}  // namespace

TEST_CASE("a sweep writes a line and a row of the table and a timing for each of its rows") {
    const Folder folder;
    CHECK(run_sweep(squares(3), folder / "out", {}) == 0);
    CHECK(content_of(folder / "out/results.jsonl") ==
          "{\"cell\":0,\"outcome\":\"done\",\"refusal\":\"no\",\"square\":0}\n"
          "{\"cell\":1,\"outcome\":\"done\",\"refusal\":\"no\",\"square\":1}\n"
          "{\"cell\":2,\"outcome\":\"done\",\"refusal\":\"no\",\"square\":4}\n");
    CHECK(content_of(folder / "out/results.csv") == "square\n0\n1\n4\n");
    CHECK(content_of(folder / "out/timings.jsonl").starts_with("{\"cell\":0,\"seconds\":1}\n{\"cell\":1,"));
}

TEST_CASE("a shard has every Nth row and its files have its number") {
    const Folder folder;
    CHECK(run_sweep(squares(7), folder / "out", {2, 3}) == 0);  // rows 1 and 4
    CHECK(content_of(folder / "out/results.2of3.csv") == "square\n1\n16\n");
    CHECK(run_sweep(squares(7), folder / "out", {1, 3}) == 0);  // rows 0, 3 and 6
    CHECK(content_of(folder / "out/results.1of3.csv") == "square\n0\n9\n36\n");
    CHECK(run_sweep(squares(1), folder / "few", {3, 3}) == 0);  // more shards than rows
    CHECK(content_of(folder / "few/results.3of3.csv") == "square\n");
}

TEST_CASE("a sweep that fails leaves no file of results") {
    const Folder folder;
    Sweep sweep = squares(3);
    sweep.measure = [measure = sweep.measure](std::size_t i) {
        if (i == 2) throw std::runtime_error("the third");
        return measure(i);
    };
    CHECK_THROWS_WITH(run_sweep(sweep, folder / "out", {}), "the third");
    CHECK_FALSE(std::filesystem::exists(folder / "out/results.jsonl"));
    CHECK_FALSE(std::filesystem::exists(folder / "out/timings.jsonl"));
}

TEST_CASE("a sweep replaces only results of its own kind") {
    const Folder folder;
    std::filesystem::create_directories(folder / "out");
    for (const char* text : {"notes of someone\n", "{\"outcome\": \"done\"}\n", "[1]\n"}) {
        std::ofstream{folder / "out/results.jsonl"} << text;
        CHECK_THROWS_WITH(run_sweep(squares(2), folder / "out", {}),
                          Catch::Contains("results.jsonl: line 1: expected a row of strata squares"));
        CHECK(content_of(folder / "out/results.jsonl") == text);
    }
    std::filesystem::remove(folder / "out/results.jsonl");
    CHECK(run_sweep(squares(2), folder / "out", {}) == 0);
    CHECK(run_sweep(squares(3), folder / "out", {}) == 0);
    CHECK(content_of(folder / "out/results.csv") == "square\n0\n1\n4\n");
}

TEST_CASE("a sweep does not write through a link in its folder") {
    const Folder folder;
    std::filesystem::create_directories(folder / "out");
    std::filesystem::create_symlink(folder / "elsewhere", folder / "out/timings.jsonl");
    CHECK_THROWS_AS(run_sweep(squares(2), folder / "out", {}), strata::InputError);
    CHECK_FALSE(std::filesystem::exists(folder / "elsewhere"));
}

TEST_CASE("the exit status is 2 if every row is refused and 1 if a row shows a fault and otherwise 0") {
    const Folder folder;
    CHECK(run_sweep(squares(2, {0}), folder / "out", {}) == 0);
    CHECK(run_sweep(squares(2, {0, 1}), folder / "out", {}) == 2);
    Sweep sweep = squares(2);
    sweep.has_failed = [](const Lines& lines) { return lines[1].at("square") == 1; };
    CHECK(run_sweep(sweep, folder / "out", {}) == 1);
}

TEST_CASE("a shard is two whole numbers of which the first is at most the second") {
    CHECK(to_shard("1/1"));
    CHECK(to_shard("2/5")->index == 2);
    CHECK(to_shard("2/5")->count == 5);
    for (const char* text : {"", "1", "0/2", "3/2", "1/0", "1/2/3", "a/2", "1/b", "-1/2"}) {
        INFO(text);
        CHECK_FALSE(to_shard(text));
    }
}
