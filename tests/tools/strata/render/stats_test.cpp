// Tests the statistics against scenes/reference/reports.md 1, whose keys and types are listed here independently.
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "peeling/registry.h"
#include "tests/tools/program.h"

using namespace strata::test;
using nlohmann::ordered_json;
using Kind = ordered_json::value_t;

namespace {

const std::vector<std::string> row_keys{"algorithm",
                                        "profile",
                                        "execution",
                                        "simd",
                                        "fragment_memory",
                                        "options",
                                        "outcome",
                                        "refusal",
                                        "width",
                                        "height",
                                        "iterations",
                                        "geometry_passes",
                                        "fullscreen_passes",
                                        "layers_max",
                                        "fragments_max",
                                        "counters",
                                        "work",
                                        "diagnostics",
                                        "digest",
                                        "order_errors",
                                        "lost_by_ties",
                                        "hidden_by_opaque_ties",
                                        "max_difference_from_a_buffer",
                                        "max_difference_without_ties",
                                        "seconds"};
const std::vector<std::string> counter_keys{"fragments_rasterized", "discarded", "alpha_killed", "stencil_killed",
                                            "depth_killed",         "blended",   "bytes_read",   "bytes_written"};

std::vector<std::string> keys_of(const ordered_json& object) {
    std::vector<std::string> keys;
    for (const auto& [key, value] : object.items()) keys.push_back(key);
    return keys;
}

bool is_count(const ordered_json& value) {
    return value.is_number_unsigned() || (value.is_number_integer() && value >= 0);
}

void check_types(const ordered_json& row) {
    CHECK(keys_of(row) == row_keys);
    for (const char* key : {"algorithm", "profile", "execution", "simd", "outcome"}) CHECK(row[key].is_string());
    for (const char* key : {"fragment_memory", "width", "height", "iterations", "geometry_passes", "fullscreen_passes",
                            "layers_max", "fragments_max", "lost_by_ties", "hidden_by_opaque_ties"}) {
        INFO(key);
        CHECK(is_count(row[key]));
    }
    if (!row["counters"].is_null()) CHECK(keys_of(row["counters"]) == counter_keys);
    if (!row["counters"].is_null())
        for (const auto& [key, value] : row["counters"].items()) CHECK(is_count(value));
    CHECK(row["work"].is_object());
    CHECK(row["diagnostics"].is_array());
    for (const auto& d : row["diagnostics"])
        CHECK(keys_of(d) == std::vector<std::string>{"fault", "pixels", "first", "detail"});
    CHECK(keys_of(row["digest"]) == std::vector<std::string>{"color", "depth"});
    CHECK((row["order_errors"].is_null() || is_count(row["order_errors"])));
    for (const char* key : {"max_difference_from_a_buffer", "max_difference_without_ties"}) CHECK(row[key].is_number());
    CHECK(keys_of(row["seconds"]) == std::vector<std::string>{"geometry", "passes", "audit", "total"});
    for (const auto& [key, value] : row["seconds"].items()) CHECK(value.is_number());
}

ordered_json rows_of(const Folder& folder, std::vector<std::string> words) {
    words.insert(words.end(), {"--stats", "-"});
    return ordered_json::parse(run_strata(folder, words).out);
}

}  // namespace

TEST_CASE("every row of the statistics has every key with its type and a rejected one has zeros and its reason") {
    const auto profile = GENERATE(as<std::string>{}, "geforce3", "geforce8", "geforce8_dx101", "ideal");
    const Folder folder;
    const auto rows = rows_of(
        folder, {"render", "volume-beam:slices=4", "--size", "24x16", "--algorithm", "all", "--profile", profile});
    REQUIRE(rows.is_array());
    CHECK(rows.size() == strata::peeling::algorithms().size());
    for (const auto& row : rows) {
        INFO(row.dump());
        check_types(row);
        if (row["outcome"] == "refused") {
            CHECK(keys_of(row["refusal"]) == std::vector<std::string>{"feature", "extension"});
            CHECK(row["refusal"]["feature"] != "");
            CHECK(row["digest"]["color"] == "");
            CHECK(row["geometry_passes"] == 0);
        } else {
            CHECK(row["outcome"] == "done");
            CHECK(row["refusal"].is_null());
            CHECK(row["digest"]["color"].get<std::string>().size() == 32);
        }
    }
}

TEST_CASE("the output of --stats - is exactly one JSON document without escape codes and standard error is empty") {
    const Folder folder;
    const CommandResult ended =
        run_strata(folder, {"render", "teapot", "--size", "16x16", "--algorithm", "dual,weighted_sum", "--stats", "-"});
    CHECK(ended.status == 0);
    CHECK(ordered_json::accept(ended.out));
    CHECK(ended.out.find('\x1b') == std::string::npos);
    CHECK(ended.err.empty());
}

TEST_CASE("the file of --stats FILE equals the document of --stats - except for the times") {
    const Folder folder;
    const std::vector<std::string> words{"render", "teapot", "--size", "16x16", "--algorithm", "dual"};
    auto printed = rows_of(folder, words);
    auto with_file = words;
    with_file.insert(with_file.end(), {"--stats", "stats.json"});
    CHECK(run_strata(folder, with_file).status == 0);
    auto stored = ordered_json::parse(content_of(folder / "stats.json"));
    for (auto* rows : {&printed, &stored}) (*rows)[0].erase("seconds");
    CHECK(printed == stored);
}

TEST_CASE("counters are null unless requested and then those of literal execution and they change no bit") {
    const Folder folder;
    const std::vector<std::string> words{"render", "teapot", "--size", "16x16", "--algorithm", "dual"};
    const auto with = [&](const std::vector<std::string>& more) {
        auto all = words;
        all.insert(all.end(), more.begin(), more.end());
        return rows_of(folder, all)[0];
    };
    const auto plain = with({}), counted = with({"--counters"}), literal = with({"--execution", "literal"});
    CHECK(plain["counters"].is_null());
    CHECK(keys_of(counted["counters"]) == counter_keys);
    CHECK(counted["counters"] == literal["counters"]);
    CHECK(counted["counters"]["fragments_rasterized"] > 0);
    CHECK(counted["digest"] == plain["digest"]);
}

TEST_CASE("without the audit its statistics are null and the others unchanged") {
    const Folder folder;
    const std::vector<std::string> words{"render", "teapot", "--size", "16x16", "--algorithm", "dual"};
    auto audited = rows_of(folder, words)[0];
    auto with_flag = words;
    with_flag.emplace_back("--no-audit");
    auto bare = rows_of(folder, with_flag)[0];
    CHECK(keys_of(bare) == row_keys);
    for (const char* key : {"layers_max", "fragments_max", "order_errors", "lost_by_ties", "hidden_by_opaque_ties",
                            "max_difference_from_a_buffer", "max_difference_without_ties"}) {
        INFO(key);
        CHECK(bare[key].is_null());
        bare.erase(key);
        audited.erase(key);
    }
    bare.erase("seconds");
    audited.erase("seconds");
    bare.erase("work");
    audited.erase("work");
    CHECK(bare == audited);
}

TEST_CASE("a list prints one JSON document with --json") {
    const auto verb = GENERATE(as<std::string>{}, "list algorithms", "list profiles", "list scenes", "scene teapot",
                               "list profiles geforce3", "list profiles ideal");
    const Folder folder;
    const CommandResult ended = shell(folder, "strata " + verb + " --json");
    CHECK(ended.status == 0);
    CHECK(ordered_json::accept(ended.out));
}

TEST_CASE("the JSON that strata list profiles prints is a valid profile for --profile and gives the same bits") {
    const auto name = GENERATE(as<std::string>{}, "geforce3", "geforce8", "geforce8_dx101", "ideal", "llvmpipe",
                               "softpipe", "swiftshader", "direct3d11");
    const Folder folder;
    CHECK(shell(folder, "strata list profiles --json " + name + " > own.json").status == 0);
    const std::vector<std::string> words{"render",   "volume-beam:slices=4", "--size", "24x16", "--algorithm", "all",
                                         "--profile"};
    auto builtin = words, own = words;
    builtin.push_back(name);
    own.emplace_back("own.json");
    auto rows = rows_of(folder, builtin), own_rows = rows_of(folder, own);
    for (auto* document : {&rows, &own_rows}) {
        for (auto& row : *document) row.erase("seconds");
    }
    CHECK(rows == own_rows);
}
