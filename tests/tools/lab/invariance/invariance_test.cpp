// Tests sweeps of `strata invariance`: two threads must write the same bytes as one. The expected column titles are
// listed by hand.
#include <catch2/catch.hpp>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/tools/program.h"

using namespace strata::test;
using nlohmann::ordered_json;

namespace {

// 12 small cells: two of them are rejected, most have errors.
constexpr const char* plan = R"({
    "common": {"scene": "planes:gap=64,count=4", "size": "24x16", "profile": "ideal", "algorithm": "front_to_back", "alpha": 0.5,
               "pair": "float32:exact", "depth_format": ["d24", "d32f"]},
    "grids": [{"remedy": ["none", "bias:2", "bias:4096"], "near_far": ["orbit", "ratio:1000"]},
              {"profile": "geforce3", "algorithm": "front_to_back", "depth_format": "d24"}]})";

void write(const std::string& path, const std::string& text) { std::ofstream(path, std::ios::binary) << text; }

CommandResult sweep(const Folder& folder, const std::string& to, std::vector<std::string> more = {}) {
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

TEST_CASE("a sweep writes the same bytes with any number of threads and prints a row for each cell") {
    const Folder folder;
    const CommandResult whole = sweep(folder, "whole");
    CHECK(whole.status == 0);
    CHECK(whole.err.empty());
    const auto told = lines_of(whole.out);
    REQUIRE(told.size() == 17);  // a sentence, the common settings, a title, one row per cell, and where the files are
    CHECK(told[0].starts_with("Of 13 cells, "));
    CHECK(told[1].starts_with("in every cell: scene planes:gap=64,count=4, size 24x16"));
    CHECK(told[2].find("duplicated") != std::string::npos);
    CHECK(told[15].find("refused") != std::string::npos);
    CHECK(told[15].find(" 0 ") == std::string::npos);  // the row of rejected cells has no counts
    CHECK(told[16] ==
          "Rows: whole/results.csv, whole/results.jsonl. Page with plots: tools/lab/invariance/report.py whole");
    const Results expected = results_in(folder, "whole");
    REQUIRE(lines_of(expected.lines).size() == 13);

    CHECK(run_strata(folder, {"invariance", "--plan", "plan.json", "-o", "threads", "--threads", "2"}).status == 0);
    CHECK(results_in(folder, "threads") == expected);
}

TEST_CASE("results.csv has the documented columns and a row per cell including rejected cells") {
    const Folder folder;
    REQUIRE(sweep(folder, "out", {"--no-images"}).status == 0);
    const auto rows = lines_of(content_of(folder / "out/results.csv"));
    REQUIRE(rows.size() == 14);
    CHECK(
        rows[0] ==
        "cell,scene,width,height,profile,algorithm,orbit,camera,alpha,write_path,compare_path,depth_format,subpixel_"
        "bits,"
        "near,far,remedy,bias_constant,bias_slope,compare_epsilon,vertex_path,quantize_reference,split,hypothesis,"
        "max_passes,fragments,differing,ulp_max,passes,layers_true,duplicated,lost,pixels_touched,max_difference,rmse,"
        "psnr,safe_bias,outcome");
    CHECK(rows[1].starts_with("0,\"planes:gap=64,count=4\",24,16,"));
    CHECK(rows[1].find(",float32,exact,d24,8,") != std::string::npos);
    CHECK(rows[13].ends_with(",0,0,0,0,0,0,0,0,0.0,0.0,,,refused"));
    CHECK(folder.files() == std::vector<std::string>{"out", "plan.json"});
    CHECK_FALSE(std::filesystem::exists(folder / "out/images"));
}

TEST_CASE("a scene whose name is not UTF-8 is measured") {
    const Folder folder;
    const std::string name = "b\xff.gltf";
    write(folder / name, R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[]}]})");
    const std::vector<std::string> words{
        "invariance", name,  "--algorithm", "front_to_back", "--pair",    "float32:exact",
        "--size",     "8x8", "--profile",   "ideal",         "--threads", "1",
        "-o",         "out"};
    const CommandResult first = run_strata(folder, words), second = run_strata(folder, words);
    CHECK(first.status == 0);
    CHECK(second.status == 0);
    CHECK(first.out == second.out);
    const CommandResult bench = run_strata(folder, {"bench", name, "--size", "8x8", "--algorithm", "dual", "--repeat",
                                                    "1", "--warm-up", "0", "--threads", "1", "--json"});
    CHECK(bench.status == 0);
    CHECK(ordered_json::parse(bench.out).at("jobs").size() == 1);
    CHECK(ordered_json::parse(run_strata(folder, {"scene", name, "--json"}).out).at("name") == "b\xef\xbf\xbd.gltf");
}
