// Tests the tables and JSON of `strata bench` on invented times. The medians, ratios and rows that are expected are
// worked out by hand.
#include "tools/lab/bench/bench_report.h"

#include <catch2/catch.hpp>
#include <fstream>

#include "peeling/registry.h"
#include "rasterizer/base/input_error.h"
#include "tests/tools/program.h"

namespace {

using namespace strata::tools;
using nlohmann::ordered_json;
using strata::pipeline::Execution;
using strata::test::Folder;
using strata::test::lines_of;

BenchScene scene_named(const std::string& name) {
    BenchScene scene;
    scene.options.scene = name;
    scene.options.render.width = 64;
    scene.options.render.height = 48;
    scene.options.render.threads = 3;
    scene.session.profile = *strata::pipeline::find_profile("geforce8");
    return scene;
}

const BenchScene& planes() {
    static const BenchScene scene = scene_named("planes:count=2");
    return scene;
}

// Three runs of 2, 8 and 4 ms with 1000 literal fragments, 3000 bytes read and 1000 written.
BenchResult result_of(const char* algorithm, Execution execution, const BenchScene& scene = planes()) {
    BenchResult result;
    result.job.scene = &scene;
    result.job.algorithm = algorithm == nullptr ? nullptr : strata::peeling::find_algorithm(algorithm);
    result.job.execution = execution;
    result.last.geometry_passes = 5;
    result.last.visited = 400;
    result.last.counters = {.fragments_rasterized = 1000, .bytes_read = 3000, .bytes_written = 1000};
    result.digest = "d1";
    result.seconds = {0.002, 0.008, 0.004};
    result.geometry_seconds = {0.001, 0.002, 0.0015};
    return result;
}

BenchResult refused(const char* algorithm, const std::string& reason) {
    BenchResult result = result_of(algorithm, Execution::replay);
    result.seconds.clear();
    result.geometry_seconds.clear();
    result.last.refusal = reason;
    return result;
}

// The words of a line, for comparing table rows regardless of column widths.
std::vector<std::string> words_in(const std::string& line) {
    std::vector<std::string> words;
    std::istringstream stream{line};
    for (std::string word; stream >> word;) words.push_back(word);
    return words;
}

std::string refusal_of_baseline(const std::string& text) {
    const Folder folder;
    std::ofstream(folder / "old.json") << text;
    try {
        static_cast<void>(load_baseline(folder / "old.json"));
    } catch (const strata::InputError& error) {
        return std::string{error.what()}.substr((folder / "old.json").size());
    }
    return "accepted";
}

const std::string replayed_name = "planes:count=2 dual replay scalar needed 64x48 geforce8 threads=3";

}  // namespace

TEST_CASE("the median of an odd number of times is the middle one and of an even number the mean of the middle two") {
    const auto is = [](std::vector<double> times, double median, double least, double greatest) {
        const Spread spread = spread_of(std::move(times));
        return spread.median == median && spread.least == least && spread.greatest == greatest;
    };
    CHECK(is({7}, 7, 7, 7));
    CHECK(is({9, 1}, 5, 1, 9));
    CHECK(is({3, 9, 1}, 3, 1, 9));
    CHECK(is({8, 2, 4, 16}, 6, 2, 16));
    CHECK(is({5, 4, 3, 2, 1}, 3, 1, 5));
}

TEST_CASE(
    "two timings differ if each has four runs or more and every run of one is shorter than every run of the other") {
    const Spread slow{5, 4, 6, 4}, quick{2, 1, 3.9, 4};
    CHECK(is_apart(slow, quick));
    CHECK(is_apart(quick, slow));
    CHECK_FALSE(is_apart(slow, {2, 1, 4, 4}));
    CHECK_FALSE(is_apart(slow, slow));
    CHECK_FALSE(is_apart({5, 4, 6, 3}, quick));
    CHECK_FALSE(is_apart(slow, {2, 1, 3.9, 3}));
    // For equal distributions every order of four and four runs is equally likely, and 2 of 70 orders look different.
    int orders = 0, apart = 0;
    for (unsigned first = 0; first < 256; ++first) {
        std::vector<double> a, b;
        for (int place = 0; place < 8; ++place) ((first >> place & 1) != 0 ? a : b).push_back(place);
        if (a.size() != 4) continue;
        ++orders;
        apart += is_apart(spread_of(a), spread_of(b)) ? 1 : 0;
    }
    CHECK(orders == 70);
    CHECK(apart == 2);
}

TEST_CASE("a job in JSON has its parameters and counts and times and the values derived from them") {
    const auto document = to_json(std::vector{result_of("dual", Execution::replay)}, {});
    CHECK(document.at("scene") == "planes:count=2");
    CHECK(document.at("refused").empty());
    const auto expected = ordered_json::parse(R"({"scene":"planes:count=2","algorithm":"dual","execution":"replay",
        "simd":"scalar","effects":"needed","threads":3,"fragment_memory":268435456,"size":"64x48","profile":"geforce8","geometry_passes":5,"fragments":1000,"visited":400,
        "seconds":{"median":0.004,"min":0.002,"max":0.008,"all":[0.002,0.008,0.004]},"geometry_seconds":0.0015,
        "fragments_per_second":250000.0,"ns_per_fragment_pass":4000.0,"bytes_per_fragment":4.0,"digest":"d1","ratio":null})");
    CHECK(document.at("jobs").at(0).dump() == expected.dump());
}

TEST_CASE("a job without a fragment has no time and no bytes per fragment") {
    BenchResult empty = result_of(nullptr, Execution::replay);
    empty.last.counters = strata::pipeline::Counters{};
    const auto job = to_json(std::vector{empty}, {}).at("jobs").at(0);
    CHECK(job.at("algorithm") == "depth");
    CHECK(job.at("ns_per_fragment_pass").is_null());
    CHECK(job.at("bytes_per_fragment").is_null());
    CHECK(job.at("fragments_per_second") == 0.0);
    const auto row = words_in(lines_of(to_table({empty})).at(1));
    CHECK((row.at(row.size() - 2) == "-" && row.back() == "-"));
}

TEST_CASE("a job that was not counted has no fragment count and no value divided by one") {
    BenchResult uncounted = result_of("dual", Execution::replay);
    uncounted.last.counters.reset();
    const auto job = to_json(std::vector{uncounted}, {}).at("jobs").at(0);
    for (const char* key : {"fragments", "fragments_per_second", "ns_per_fragment_pass", "bytes_per_fragment"})
        CHECK(job.at(key).is_null());
    const auto row = words_in(lines_of(to_table({uncounted})).at(1));
    CHECK(std::ranges::count(row, "-") == 4);
}

TEST_CASE("a document names each scene once in order with files without their folder and lists the rejected jobs") {
    const BenchScene dragon = scene_named("/some/folder/dragon.glb");
    const std::vector<BenchResult> results{result_of("dual", Execution::replay, dragon),
                                           result_of("dual", Execution::replay), refused("dual_independent", "because"),
                                           result_of("depth_units", Execution::replay, dragon)};
    const auto document = to_json(results, {});
    CHECK(document.at("scene") == "dragon.glb planes:count=2");
    REQUIRE(document.at("jobs").size() == 3);
    CHECK(document["jobs"][2].at("scene") == "dragon.glb");
    REQUIRE(document.at("refused").size() == 1);
    CHECK(document["refused"][0].at("algorithm") == "dual_independent");
    CHECK(document["refused"][0].at("reason") == "because");
    CHECK_FALSE(document["refused"][0].contains("seconds"));
}

TEST_CASE("a ratio is the old median over the new one of the job with the same parameters") {
    const Baseline baseline{{replayed_name, {0.012, 0.011, 0.013, 5}}};
    const auto ratio = [&](auto&& change) {
        BenchScene scene = planes();
        BenchResult result = result_of("dual", Execution::replay, scene);
        change(result, scene);
        const auto found = to_json(std::vector{result}, baseline).at("jobs").at(0).at("ratio");
        return found.is_null() ? -1 : found.template get<double>();
    };
    CHECK(ratio([](auto&, auto&) {}) == Approx(3));
    CHECK(ratio([](auto&, auto& scene) { scene.options.scene = "planes:count=3"; }) == -1);
    CHECK(ratio([](auto& result, auto&) { result.job.algorithm = nullptr; }) == -1);
    CHECK(ratio([](auto& result, auto&) { result.job.execution = Execution::literal; }) == -1);
    CHECK(ratio([](auto& result, auto&) { result.job.simd = strata::Simd::avx2; }) == -1);
    CHECK(ratio([](auto& result, auto&) { result.job.effects = strata::pipeline::Effects::all; }) == -1);
    CHECK(ratio([](auto&, auto& scene) { scene.options.render.threads = 4; }) == -1);
    CHECK(ratio([](auto&, auto& scene) { scene.options.render.width = 65; }) == -1);
    CHECK(ratio([](auto&, auto& scene) { scene.options.render.height = 49; }) == -1);
    CHECK(ratio([](auto&, auto& scene) { scene.session.profile.name = "other"; }) == -1);
}

TEST_CASE("the output of --json is accepted as a baseline and any other file is rejected with one error message") {
    const Folder folder;
    BenchResult other = result_of(nullptr, Execution::literal);
    other.seconds = {0.5};
    std::ofstream(folder / "old.json") << to_json(std::vector{result_of("dual", Execution::replay), other}, {}).dump(2);
    const Baseline baseline = load_baseline(folder / "old.json");
    REQUIRE(baseline.size() == 2);
    CHECK(baseline.at(replayed_name).median == 0.004);
    CHECK(baseline.at(replayed_name).least == 0.002);
    CHECK(baseline.at(replayed_name).greatest == 0.008);
    CHECK(baseline.at(replayed_name).runs == 3);
    CHECK(baseline.at("planes:count=2 depth literal scalar needed 64x48 geforce8 threads=3").median == 0.5);
    for (const char* text : {"", "{", "[]", "7", "{}", "{\"jobs\": 7}", "{\"jobs\": [{}]}", "{\"jobs\": [7]}",
                             "{\"jobs\": [{\"scene\": \"a\"}]}"})
        CHECK(refusal_of_baseline(text) ==
              ": --baseline: expected what strata bench --json wrote, found something else");
    CHECK(refusal_of_baseline("{\"jobs\": []}") == "accepted");
    CHECK_THROWS_WITH(load_baseline(folder / "missing.json"), Catch::Contains("missing.json"));
}

TEST_CASE("a table row has milliseconds with their spread and millions of fragments per second and ratios") {
    const auto lines = lines_of(to_table({result_of("dual", Execution::replay)}));
    REQUIRE(lines.size() == 2);
    CHECK(words_in(lines[1]) == std::vector<std::string>{"planes:count=2", "dual", "replay", "scalar", "needed", "5",
                                                         "1000", "4.00", "2.00..8.00", "1.50", "0.2", "4000.00",
                                                         "4.0"});
}

TEST_CASE("with several executions one more table shows them in columns with the ratio of each to the last") {
    BenchResult literal = result_of("dual", Execution::literal), depth = result_of(nullptr, Execution::replay);
    BenchResult replay = result_of("dual", Execution::replay);
    literal.seconds = {0.012, 0.012, 0.011, 0.013};
    replay.seconds = {0.004, 0.004, 0.003, 0.008};
    const auto lines = lines_of(to_table({literal, replay}));
    REQUIRE(lines.size() == 6);
    CHECK(lines[3].empty());
    CHECK(words_in(lines[4]) == std::vector<std::string>{"ms", "literal", "replay", "ratio"});
    CHECK(words_in(lines[5]) ==
          std::vector<std::string>{"planes:count=2", "dual", "scalar", "needed", "12.00", "4.00", "3.00", ":", "1"});
    // If a run of replay is as long as one of literal execution, or there are fewer than four runs, the ratio is not
    // significant.
    replay.seconds.back() = 0.011;
    for (const bool is_short : {false, true}) {
        if (is_short) literal.seconds.pop_back(), replay.seconds = {0.004, 0.004, 0.003};
        const auto noisy = lines_of(to_table({literal, replay}));
        REQUIRE(noisy.size() == 7);
        CHECK(words_in(noisy[5]) == std::vector<std::string>{"planes:count=2", "dual", "scalar", "needed", "12.00",
                                                             "4.00", "noise", ":", "1"});
        CHECK(noisy[6].starts_with("noise: "));
    }
    CHECK(lines_of(to_table({literal, literal})).size() == 3);  // one execution alone: nothing to compare
    CHECK(lines_of(to_table({result_of("dual", Execution::replay), depth})).size() == 3);
}

TEST_CASE("error messages are listed once each below the table") {
    const auto text = to_table({refused("dual", "why"), refused("dual", "why"), refused("depth_units", "else")});
    CHECK(lines_of(text).size() == 3);
    CHECK(text.find("refused: depth_units: else\nrefused: dual: why\n") != std::string::npos);
}

TEST_CASE(
    "a comparison with an earlier run lists both times with their ratio and then the jobs without a counterpart") {
    Baseline baseline{
        {replayed_name, {0.012, 0.009, 0.013, 4}}, {"gone a b c", {1, 1, 1, 4}}, {"also gone", {1, 1, 1, 4}}};
    BenchResult dual = result_of("dual", Execution::replay);
    dual.seconds = {0.002, 0.008, 0.004, 0.004};
    const std::vector<BenchResult> results{dual, result_of(nullptr, Execution::replay), refused("dual", "x")};
    const auto lines = lines_of(to_ratios(results, baseline));
    REQUIRE(lines.size() == 6);
    CHECK(lines[0].empty());
    CHECK(words_in(lines[1]) == std::vector<std::string>{"job", "old", "ms", "new", "ms", "old/new"});
    CHECK(lines[2].starts_with(replayed_name + "  "));
    CHECK(words_in(lines[2].substr(replayed_name.size())) == std::vector<std::string>{"12.00", "4.00", "3.00"});
    CHECK(lines[3] == "not in the baseline: planes:count=2 depth replay scalar needed 64x48 geforce8 threads=3");
    CHECK(lines[4] == "only in the baseline: also gone");
    CHECK(lines[5] == "only in the baseline: gone a b c");
    baseline[replayed_name].least = 0.008;
    const auto noisy = lines_of(to_ratios(results, baseline));
    CHECK(words_in(noisy[2].substr(replayed_name.size())) == std::vector<std::string>{"12.00", "4.00", "noise"});
    CHECK(noisy[3].starts_with("noise: "));
}

TEST_CASE("a picture that differs from the first one of its scene and algorithm is reported in every execution") {
    const BenchScene other = scene_named("planes:count=3");
    std::vector<BenchResult> results{result_of("dual", Execution::literal), result_of("dual", Execution::replay),
                                     result_of(nullptr, Execution::replay),
                                     result_of("dual", Execution::replay, other)};
    CHECK(differing(results).empty());
    results[2].digest = "d2";
    results[3].digest = "d3";
    CHECK(differing(results).empty());  // another algorithm, another scene
    results[1].digest = "d4";
    CHECK(differing(results) == std::vector<std::string>{replayed_name});
    results[1].last.refusal = "refused";
    CHECK(differing(results).empty());
}
