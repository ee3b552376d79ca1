// Model: the sweep run in one go by one thread; every other way must give its bytes. Columns typed here a second time.
#include <catch2/catch.hpp>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/tools/program.h"

using namespace strata::test;
using nlohmann::ordered_json;

namespace {

// 12 small cells, two of them refused, most with errors.
constexpr const char* plan = R"({
    "common": {"scene": "planes:gap=64,count=4", "size": "24x16", "profile": "ideal", "algorithm": "front_to_back", "alpha": 0.5,
               "pair": "float32:exact", "depth_format": ["d24", "d32f"]},
    "grids": [{"remedy": ["none", "bias:2", "bias:4096"], "near_far": ["orbit", "ratio:1000"]},
              {"profile": "geforce3", "algorithm": "front_to_back", "depth_format": "d24"}]})";

void write(const std::string& path, const std::string& text) { std::ofstream(path, std::ios::binary) << text; }

Ended sweep(const Folder& folder, const std::string& to, std::vector<std::string> more = {}) {
    write(folder / "plan.json", plan);
    const std::vector<std::string> words{"invariance", "--plan", "plan.json", "-o", to, "--threads", "1"};
    more.insert(more.begin(), words.begin(), words.end());
    return run_strata(folder, more);
}

struct Results {
    std::string lines, table;
    friend bool operator==(const Results&, const Results&) = default;
};

Results results_in(const Folder& folder, const std::string& name) {
    return {content_of(folder / (name + "/results.jsonl")), content_of(folder / (name + "/results.csv"))};
}

}  // namespace

TEST_CASE("a sweep gives the same bytes for any threads, in shards, and taken up again wherever it was torn") {
    const Folder folder;
    const Ended whole = sweep(folder, "whole");
    CHECK(whole.status == 0);
    CHECK(whole.err.empty());
    const auto told = lines_of(whole.out);
    REQUIRE(told.size() == 15);  // a title, a row a cell, and where it all is
    CHECK(told[0].find("duplicated") != std::string::npos);
    CHECK(told[13].find("refused") != std::string::npos);
    CHECK(told[14] ==
          "All of it: whole/results.csv and whole/results.jsonl. A page with plots, whole/index.html: "
          "tools/invariance/report.py whole");
    const Results expected = results_in(folder, "whole");
    REQUIRE(lines_of(expected.lines).size() == 13);

    CHECK(run_strata(folder, {"invariance", "--plan", "plan.json", "-o", "threads", "--threads", "2"}).status == 0);
    CHECK(results_in(folder, "threads") == expected);

    for (int i = 5; i >= 1; --i) CHECK(sweep(folder, "shards", {"--shard", std::to_string(i) + "/5"}).status == 0);
    CHECK(sweep(folder, "shards", {"--merge", "5"}).status == 0);
    CHECK(results_in(folder, "shards") == expected);

    const auto half = expected.lines.size() / 2;
    for (const std::size_t bytes :
         {half, expected.lines.find('\n'), expected.lines.find('\n') + 1, expected.lines.size() - 1}) {
        INFO("cut at byte " << bytes);
        std::filesystem::create_directories(folder / "torn");
        write(folder / "torn/results.jsonl", expected.lines.substr(0, bytes));
        const Ended again = sweep(folder, "torn");
        CHECK(again.status == 0);
        const bool is_torn = expected.lines[bytes - 1] != '\n';
        CHECK((again.err.find("the last line was torn") != std::string::npos) == is_torn);
        CHECK(results_in(folder, "torn") == expected);
    }
}

TEST_CASE("results.csv has the promised columns, a row a cell, and refused cells among them") {
    const Folder folder;
    REQUIRE(sweep(folder, "out", {"--no-images"}).status == 0);
    const auto rows = lines_of(content_of(folder / "out/results.csv"));
    REQUIRE(rows.size() == 14);
    CHECK(
        rows[0] ==
        "scene,width,height,write_path,compare_path,depth_format,subpixel_bits,near,far,bias_constant,bias_slope,"
        "compare_epsilon,"
        "vertex_path,quantize_reference,fragments,differing,ulp_max,passes,layers_true,duplicated,lost,pixels_touched,"
        "max_difference,rmse,psnr,outcome");
    CHECK(rows[1].starts_with("\"planes:gap=64,count=4\",24,16,float32,exact,d24,8,"));
    CHECK(rows[13].ends_with(",0,0,0,0,0,0,0,0,0.0,0.0,,refused"));
    CHECK(folder.files().size() == 2);
}

TEST_CASE("a folder with another plan's results is refused, and so is a shard that is not whole") {
    const Folder folder;
    REQUIRE(sweep(folder, "out", {"--shard", "1/2", "--no-images"}).status == 0);
    const Ended missing = sweep(folder, "out", {"--merge", "2"});
    CHECK(missing.status == 2);
    CHECK(missing.err == "strata: out/results.2of2.jsonl: lines: expected 6, one a cell of the shard, found 0\n");
    const Ended other = run_strata(
        folder, {"invariance", "teapot", "--size", "8x8", "--profile", "ideal", "--shard", "1/2", "-o", "out"});
    CHECK(other.status == 2);
    CHECK(other.err.find("out/results.1of2.jsonl: line 1: scene: expected \"teapot\", as the plan has it") !=
          std::string::npos);
}
