// Tests `strata cost`: a sweep in shards and a resumed sweep against an uninterrupted one, and the figures in its
// sentences against those in cost.csv.
#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>
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

// True if `printed` is the figure printed with `digits` decimals.
bool agrees(const std::string& printed, double figure, int digits) {
    return std::fabs(std::stod(printed) - figure) <= 0.6 * std::pow(10.0, -digits) + 2e-5 * std::fabs(figure);
}

}  // namespace

TEST_CASE("errors and counts of a cost sweep are the same in shards or resumed or uninterrupted") {
    const Folder folder;
    REQUIRE(cost(folder, "whole").status == 0);
    const std::string lines = content_of(folder / "whole/results.jsonl"),
                      table = content_of(folder / "whole/results.csv");
    for (int i = 3; i >= 1; --i) CHECK(cost(folder, "shards", {"--shard", std::to_string(i) + "/3"}).status == 0);
    CHECK(cost(folder, "shards", {"--merge", "3"}).status == 0);
    CHECK(content_of(folder / "shards/results.jsonl") == lines);
    CHECK(content_of(folder / "shards/results.csv") == table);
    // A second run measures nothing and writes the report again.
    const std::string timings = content_of(folder / "whole/timings.jsonl");
    const std::string descriptions = content_of(folder / "whole/sentences.txt");
    REQUIRE(cost(folder, "whole").status == 0);
    CHECK(content_of(folder / "whole/timings.jsonl") == timings);
    CHECK(content_of(folder / "whole/sentences.txt") == descriptions);
}

TEST_CASE("every sentence agrees with its row and the exact end of the chain leaves an error of 0") {
    const Folder folder;
    REQUIRE(cost(folder, "out").status == 0);
    const auto rows = rows_of(content_of(folder / "out/cost.csv"));
    const auto descriptions = lines_of(content_of(folder / "out/sentences.txt"));
    CHECK(descriptions.size() + 1 == rows.size());  // the default has no sentence
    const TableRow* standard = nullptr;
    for (const auto& [name, row] : rows)
        if (row.at("knob") == "default") standard = &row;
    REQUIRE(standard != nullptr);
    const std::regex change(
        R"(teapot: (.*?)(?: \(with .*\))? instead of the default: ([^ ]*) % of pixels differ, RMSE ([^ ]*) instead of ([^ ,]*), 1 round is too few to compare times, ([^ ]*) times the card's\.)");
    const std::regex link(
        R"(teapot: (?:the (chain) exact up to (\w+)|(\w+) exact (alone)|the chain as the machine has it).* RMSE ([^ ]*?)(?: from the truth)?\.)");
    const std::regex refusal(R"(teapot: (.*) is refused: .*\.)");
    std::map<std::string, int> kinds;
    for (const std::string& message : descriptions) {
        INFO(message);
        std::smatch part;
        if (std::regex_match(message, part, refusal)) {
            ++kinds["refused"];
            CHECK(rows.at(part[1]).at("outcome") == "refused");
        } else if (std::regex_match(message, part, change)) {
            ++kinds["change"];
            const TableRow& row = rows.at(part[1]);
            CHECK(agrees(part[2], 100 * number(row, "from_default"), 4));
            CHECK(agrees(part[3], number(row, "rmse"), 5));
            CHECK(agrees(part[4], number(*standard, "rmse"), 5));
            CHECK(agrees(part[5], number(row, "modelled") / number(*standard, "modelled"), 2));
        } else {
            REQUIRE(std::regex_match(message, part, link));
            ++kinds["link"];
            const std::string name = part[1].matched   ? "chain " + part[2].str()
                                     : part[4].matched ? "alone " + part[3].str()
                                                       : "chain machine";
            CHECK(agrees(part[5], number(rows.at(name), "rmse"), 5));
        }
    }
    CHECK(kinds["change"] > 20);
    CHECK(kinds["link"] == 15);
    CHECK(kinds["refused"] >= 1);
    CHECK(number(rows.at("chain store"), "rmse") == 0);
    CHECK(number(rows.at("chain machine"), "rmse") > 0);
}

TEST_CASE("a cost sweep draws a frontier for each of its three times and reports where its files are") {
    const Folder folder;
    const CommandResult ended = cost(folder, "out", {"--clock", "processor"});
    REQUIRE(ended.status == 0);
    for (const char* column : {"default", "literal", "modelled"}) {
        const std::string svg = content_of(folder / (std::string("out/frontier.teapot.") + column + ".svg"));
        CHECK(svg.starts_with("<svg"));
        CHECK(svg.ends_with("</svg>\n"));
    }
    CHECK(lines_of(ended.out).back() ==
          "All of it: out/cost.csv, out/sentences.txt, out/results.csv and out/results.jsonl");
}

TEST_CASE("algorithms of few passes are measured with their options and what their targets and buffers take") {
    const Folder folder;
    REQUIRE(run_strata(folder, {"cost", "planes:count=6", "--alpha", "0.5", "--size", "16x16", "--knob", "transparency",
                                "--repeat", "1", "--threads", "1", "-o", "out"})
                .status == 0);
    const auto results = rows_of(content_of(folder / "out/results.csv")),
               costs = rows_of(content_of(folder / "out/cost.csv"));
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
    CHECK(costs.at("transparency linked_list").at("modelled").empty());
    CHECK_FALSE(costs.at("transparency weighted_blended").at("modelled").empty());
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
