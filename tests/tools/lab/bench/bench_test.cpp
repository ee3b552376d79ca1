// Tests the JSON document of `strata bench`: the test lists the documented keys itself, and checks that the ratios
// agree with the numbers that they are computed from.
#include <algorithm>
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "tests/tools/program.h"

using namespace strata::test;
using nlohmann::ordered_json;

namespace {

CommandResult bench(const Folder& folder, std::vector<std::string> more) {
    const std::vector<std::string> small{
        "bench", "random:seed=3,triangles=60", "--size", "64x64", "--repeat", "2", "--warm-up", "0"};
    more.insert(more.begin(), small.begin(), small.end());
    return run_strata(folder, more);
}

// Description of the first inconsistent number of a job; empty if there is none.
std::string wrong_with(const ordered_json& job) {
    for (const char* key : {"scene", "algorithm", "execution", "simd", "effects", "digest"})
        if (!job.at(key).is_string()) return key;
    for (const char* key : {"threads", "geometry_passes", "fragments"})
        if (!job.at(key).is_number_integer()) return key;
    auto all = job.at("seconds").at("all").get<std::vector<double>>();
    if (all.size() != 2) return "seconds.all";
    std::sort(all.begin(), all.end());
    const ordered_json& s = job["seconds"];
    if (s["min"] != all[0] || s["max"] != all[1] || s["median"] != (all[0] + all[1]) / 2) return "seconds";
    if (!(job.at("geometry_seconds").get<double>() <= all[1])) return "geometry_seconds";
    const double fragments = job["fragments"].get<double>();
    const double ns = job.at("ns_per_fragment_pass").get<double>();
    if (ns * fragments != Approx(s["median"].get<double>() * 1e9)) return "ns_per_fragment_pass";
    return job.at("bytes_per_fragment").get<double>() > 0 ? "" : "bytes_per_fragment";
}

}  // namespace

TEST_CASE("strata bench --json prints every documented key and the algorithms that the profile rejects") {
    const Folder folder;
    const CommandResult ended =
        bench(folder, {"--algorithm", "depth,dual,dual_independent", "--execution", "all", "--simd", "scalar,best",
                       "--effects", "needed,all", "--counters", "--json"});
    CHECK(ended.status == 0);
    CHECK(ended.err.empty());
    const auto document = ordered_json::parse(ended.out);
    CHECK(document.at("scene") == "random:seed=3,triangles=60");
    const bool has_simd = document.at("jobs").size() == 16;  // 2 algorithms, 2 executions, 2 effects, 2 sets
    // Without a faster instruction set `best` is the same as `scalar`.
    CHECK((has_simd || document["jobs"].size() == 8));
    std::string wrong;
    for (const auto& job : document["jobs"])
        if (wrong.empty()) wrong = wrong_with(job);
    CHECK(wrong == "");
    REQUIRE(document.at("refused").size() == document["jobs"].size() / 2);
    CHECK(document["refused"][0].at("algorithm") == "dual_independent");
    CHECK(document["refused"][0].at("reason").get<std::string>().find("ARB_draw_buffers_blend") != std::string::npos);
}

TEST_CASE("the literal fragment count and the picture of a job are the same in every execution") {
    const Folder folder;
    const CommandResult ended =
        bench(folder, {"--algorithm", "front_to_back", "--execution", "all", "--counters", "--json"});
    const auto jobs = ordered_json::parse(ended.out).at("jobs");
    REQUIRE(jobs.size() == 2);
    for (const auto& job : jobs)
        for (const char* key : {"digest", "fragments", "geometry_passes", "bytes_per_fragment"})
            CHECK(job[key] == jobs[0][key]);
}

TEST_CASE("strata bench --baseline prints old over new for equal jobs and names those without a counterpart") {
    const Folder folder;
    CHECK(bench(folder, {"--algorithm", "depth,dual", "-o", "old.json"}).status == 0);
    auto old = ordered_json::parse(content_of(folder / "old.json"));
    old["jobs"][1]["seconds"]["median"] = 1e6;  // recognisable in the ratio
    CHECK(shell(folder, "cat > old.json <<'END'\n" + old.dump() + "\nEND").status == 0);
    const std::vector<std::string> words{"--algorithm", "dual,unsorted", "--baseline", "old.json"};
    const CommandResult table = bench(folder, words);
    CHECK(table.status == 0);
    CHECK(table.out.find("1000000000.00") != std::string::npos);  // milliseconds
    CHECK(table.out.find("not in the baseline: random:seed=3,triangles=60 unsorted") != std::string::npos);
    CHECK(table.out.find("only in the baseline: random:seed=3,triangles=60 depth") != std::string::npos);
    auto with_json = words;
    with_json.emplace_back("--json");
    const auto jobs = ordered_json::parse(bench(folder, with_json).out).at("jobs");
    CHECK(jobs[0]["ratio"].get<double>() == Approx(1e6 / jobs[0]["seconds"]["median"].get<double>()));
    CHECK(jobs[1]["ratio"].is_null());
}
