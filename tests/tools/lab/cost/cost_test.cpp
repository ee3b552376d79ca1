// Tests `strata cost`: the errors of choices whose order is known, the bytes of targets counted by hand, its messages.
#include <catch2/catch.hpp>
#include <map>
#include <sstream>

#include "tests/tools/program.h"

using namespace strata::test;

namespace {

// A small teapot with the settings that take little time and produce every kind of row.
CommandResult cost(const Folder& folder, const std::string& to, std::vector<std::string> more = {}) {
    const std::vector<std::string> words{
        "cost",      "teapot",   "--size", "48x40",  "--alpha",
        "0.5",       "--repeat", "1",      "--knob", "subpixel_bits,depth,average_count,peels,chain,alone",
        "--threads", "1",        "-o",     to};
    more.insert(more.begin(), words.begin(), words.end());
    return run_strata(folder, more);
}

// Rows of a table by setting and value; fields by the column titles in the first row.
using TableRow = std::map<std::string, std::string>;
std::map<std::string, TableRow> rows_of(const std::string& csv) {
    const auto lines = lines_of(csv);
    const auto fields_of = [](const std::string& line) {
        std::vector<std::string> fields;
        std::stringstream text(line + ',');
        for (std::string one; std::getline(text, one, ',');) fields.push_back(one);
        return fields;
    };
    const auto names = fields_of(lines[0]);
    std::map<std::string, TableRow> rows;
    for (std::size_t i = 1; i < lines.size(); ++i) {
        const auto fields = fields_of(lines[i]);
        TableRow row;
        for (std::size_t k = 0; k < names.size(); ++k) row[names[k]] = fields.at(k);
        rows[row["knob"] + " " + row["value"]] = row;
    }
    return rows;
}

double number(const TableRow& row, const std::string& name) { return std::stod(row.at(name)); }

}  // namespace

TEST_CASE("the exact end of the chain leaves an error of 0 and the device's own arithmetic does not") {
    const Folder folder;
    REQUIRE(cost(folder, "out").status == 0);
    const auto rows = rows_of(content_of(folder / "out/results.csv"));
    CHECK(number(rows.at("chain store"), "rmse") == 0);
    CHECK(number(rows.at("chain device"), "rmse") > 0);
    CHECK(rows.at("chain store").at("sorted_rmse").empty());
}

TEST_CASE("an exact peel in floats has no error from the sorted picture but the device's from the exact one") {
    const Folder folder;
    REQUIRE(run_strata(folder, {"cost", "teapot", "--alpha", "0.3", "--size", "24x16", "--knob", "algorithm",
                                "--repeat", "1", "--threads", "1", "-o", "out"})
                .status == 0);
    const auto rows = rows_of(content_of(folder / "out/results.csv"));
    const auto figure = [&](const std::string& value, const char* name) {
        return number(rows.at("algorithm " + value), name);
    };
    CHECK(figure("a_buffer rgba8", "sorted_rmse") == 0);
    CHECK(figure("a_buffer rgba8", "rmse") > 0);
    CHECK(figure("front_to_back rgba32f", "sorted_rmse") < 1e-4);
    CHECK(figure("front_to_back rgba8", "sorted_rmse") > 0);  // a rounding for each layer instead of one
    CHECK(figure("weighted_average rgba32f", "sorted_rmse") > 0.1);
    CHECK(rows.at("algorithm a_buffer rgba8").at("modelled_seconds").empty());
    CHECK_FALSE(rows.at("algorithm dual rgba8").at("modelled_seconds").empty());
}

TEST_CASE("cost prints a table of all rows with the best first and where its files are") {
    const Folder folder;
    const CommandResult ended = cost(folder, "out", {"--clock", "processor"});
    REQUIRE(ended.status == 0);
    const auto lines = lines_of(ended.out);
    const std::size_t rows = lines_of(content_of(folder / "out/results.csv")).size();
    CHECK(lines.size() == rows + 5);
    CHECK_THAT(lines[rows + 1], Catch::StartsWith("teapot, best exact algorithm: default "));
    CHECK_THAT(lines[rows + 2], Catch::StartsWith("teapot, least time: "));
    CHECK_THAT(lines[0], Catch::Contains("RMSE from sorted") && Catch::Contains("RMSE from exact"));
    CHECK_THAT(lines[1], Catch::Contains("1  teapot"));
    CHECK(lines.back() == "Rows: out/results.csv. Page with plots: tools/lab/cost/page.py out -o FILE.md");
}

TEST_CASE("algorithms of few passes are measured with their options and what their targets and buffers take") {
    const Folder folder;
    REQUIRE(run_strata(folder, {"cost", "planes:count=6", "--alpha", "0.5", "--size", "16x16", "--knob", "transparency",
                                "--repeat", "1", "--threads", "1", "-o", "out"})
                .status == 0);
    const auto results = rows_of(content_of(folder / "out/results.csv"));
    const auto figure = [&](const std::string& value, const char* name) {
        return number(results.at("transparency " + value), name);
    };
    for (const auto& [name, row] : results) {
        INFO(name);
        CHECK(row.at("outcome") == "done");
    }
    const auto bytes = [&](const std::string& value) { return figure(value, "bytes_per_pixel"); };
    CHECK(bytes("weighted_blended") == 8 + 2 + 4);                            // sums, revealage, result
    CHECK(bytes("moments --moments 6") == 4 + 16 + 8 + 8 + 4);                // total, moments, sums, result
    CHECK(bytes("stochastic --stochastic-samples 8") == 2 * 16 + 8 + 2 + 4);  // samples, sums, through, result
    CHECK(bytes("multi_layer --nodes 6") == 2 * 16 + 6 * 4 + 4);              // depths, layers, result
    CHECK(bytes("atomic_loop --nodes 2") == 4 + 4 + 2 * 20);                  // tail, result, entries
    CHECK(bytes("hybrid_transparency") == 4 + 8 + 2 + 4 + 4 * 20);  // tail, its sums and count, result, entries
    CHECK(bytes("linked_list") > 4 + 4);                            // result, head
    CHECK(bytes("linked_list") <= 4 + 4 + 6 * 24);
    CHECK(bytes("linked_list --pixel-nodes 4") <= 4 + 4 + 4 * 24);
    CHECK(figure("atomic_loop --nodes 6", "rmse") == figure("linked_list", "rmse"));  // as many entries as planes
    CHECK(figure("front_to_back --max-passes 2 --tail none", "rmse") > figure("dual", "rmse"));
    CHECK(results.at("transparency linked_list").at("modelled_seconds").empty());
    CHECK_FALSE(results.at("transparency weighted_blended").at("modelled_seconds").empty());
}

TEST_CASE("a scene without a reference and a repeated scene and a missing folder are rejected with an error message") {
    const Folder folder;
    const CommandResult light =
        run_strata(folder, {"cost", "shadow-demo", "--size", "16x16", "--knob", "peels", "-o", "out"});
    CHECK(light.status == 2);
    CHECK(light.err == "strata: scene: light: expected no light that casts shadows, found one\n");
    const CommandResult twice = run_strata(folder, {"cost", "teapot", "teapot", "-o", "out"});
    CHECK(twice.status == 2);
    CHECK(twice.err == "strata: SCENE: 'teapot' is the name of two scenes\n");
    const CommandResult none = run_strata(folder, {"cost", "teapot"});
    CHECK(none.status == 2);
    CHECK(none.err == "strata: -o is missing: the folder for the results\n");
}
