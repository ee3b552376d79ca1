// Tests sweeps of `strata invariance`: threads, shards and resumed runs must write the same bytes as one run with one
// thread. The expected column titles are listed by hand.
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

TEST_CASE(
    "a sweep writes the same bytes with any number of threads and in shards and resumed wherever it was interrupted") {
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
        const CommandResult again = sweep(folder, "torn");
        CHECK(again.status == 0);
        const bool is_torn = expected.lines[bytes - 1] != '\n';
        CHECK((again.err.find("the last line was torn") != std::string::npos) == is_torn);
        CHECK(results_in(folder, "torn") == expected);
    }
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
    CHECK(folder.files().size() == 2);
}

TEST_CASE("a folder with results of another plan is rejected and so is an incomplete shard") {
    const Folder folder;
    REQUIRE(sweep(folder, "out", {"--shard", "1/2", "--no-images"}).status == 0);
    const CommandResult missing = sweep(folder, "out", {"--merge", "2"});
    CHECK(missing.status == 2);
    CHECK(missing.err == "strata: out/results.2of2.jsonl: lines: expected 6, one a cell of the shard, found 0\n");
    const CommandResult other = run_strata(
        folder, {"invariance", "teapot", "--size", "8x8", "--profile", "ideal", "--shard", "1/2", "-o", "out"});
    CHECK(other.status == 2);
    CHECK(other.err.find("out/results.1of2.jsonl: line 1: scene: expected \"teapot\", as the plan has it") !=
          std::string::npos);
}

TEST_CASE("lines that were changed or emptied or removed are measured again and the final bytes are the same") {
    const Folder folder;
    REQUIRE(sweep(folder, "whole", {"--no-images"}).status == 0);
    const Results expected = results_in(folder, "whole");
    auto lines = lines_of(expected.lines);
    REQUIRE(lines.size() == 13);
    const auto again = [&](const std::vector<std::string>& left) {
        std::string text;
        for (const std::string& line : left) text += line + "\n";
        write(folder / "whole/results.jsonl", text);
        const CommandResult ended = sweep(folder, "whole", {"--no-images"});
        CHECK(ended.status == 0);
        CHECK(results_in(folder, "whole") == expected);
        return ended.err;
    };
    const std::string dropped = " is not what was written; it is dropped, and its cell measured again\n";
    auto left = lines;
    left[3].replace(left[3].find("\"passes\":") + 9, 1, "9");  // one digit of a complete line is changed
    CHECK(again(left) == "strata: warning: whole/results.jsonl: line 4" + dropped);
    left = lines;
    left[12] = std::string(500, '\0');  // as after a power loss
    CHECK(again(left) == "strata: warning: whole/results.jsonl: line 13" + dropped);
    left = lines;
    left[5] = left[5].substr(0, left[5].find(",\"outcome\"")) + "}";  // without its results
    left[6].clear();
    CHECK(lines_of(again(left)).size() == 2);
    left = lines;
    left.erase(left.begin() + 2, left.begin() + 5);  // cells in the middle are missing
    std::swap(left[0], left[7]);
    left.push_back(left[1]);  // a repeated cell
    CHECK(again(left) == "strata: warning: whole/results.jsonl: line 11" + dropped);
    left = lines;
    std::swap(left[2], left[9]);  // a killed run had measured a later cell first, and the next run the rest
    CHECK(again(left) == "");
    left.erase(left.begin() + 11);
    CHECK(again(left) == "");
    write(folder / "whole/results.jsonl", expected.lines + lines[0].substr(0, 9));  // truncated after the last cell
    CHECK(sweep(folder, "whole", {"--no-images"}).status == 0);
    CHECK(results_in(folder, "whole") == expected);
}

TEST_CASE("a scene whose name is not UTF-8 is measured and the sweep resumed") {
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
