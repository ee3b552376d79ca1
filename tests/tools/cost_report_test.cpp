// Tests the report of `strata cost` on invented rows: the frontier against a search over all pairs of points by the
// definition of dominance, and the generated sentences against their rows.
#include "tools/lab/cost/cost_report.h"

#include <catch2/catch.hpp>

#include "tests/support/random_numbers.h"
#include "tools/lab/cost/cost_run.h"

using namespace strata::tools;

namespace {

// Another point takes no more time, has no more error, and is better in one of them; of equal points the first is kept.
bool is_beaten(const std::vector<CostPoint>& points, std::size_t i) {
    for (std::size_t k = 0; k < points.size(); ++k) {
        const bool no_worse = points[k].time <= points[i].time && points[k].error <= points[i].error;
        const bool is_better = points[k].time < points[i].time || points[k].error < points[i].error;
        if (no_worse && (is_better || k < i)) return true;
    }
    return false;
}

CostRow row_of(const std::string& knob, const std::string& value, double rmse, double time) {
    CostRow row;
    row.scene = "made-up";
    row.knob = knob;
    row.value = value;
    row.rmse = rmse;
    row.from_default = 0.25;
    row.usual = Spread{time, time * 0.9, time * 1.2, 5};
    row.literal = Spread{4 * time, time * 3.6, time * 4.8, 5};
    row.modelled = 3 * time;
    return row;
}

nlohmann::ordered_json made_line(int cell, const std::string& knob, double modelled) {
    return {
        {"cell", cell},        {"scene", "s"},  {"knob", knob}, {"value", "v"},        {"opened", ""},
        {"algorithm", "dual"}, {"refusal", ""}, {"rmse", 1.0},  {"from_default", 0.0}, {"modelled_seconds", modelled}};
}

}  // namespace

TEST_CASE("the frontier holds the points that no other dominates and the cheapest is first") {
    strata::testing::Random random{3};
    for (int trial = 0; trial < 200; ++trial) {
        std::vector<CostPoint> points;
        for (int i = strata::testing::random_int(random, 1, 20); i > 0; --i) {
            const double time = strata::testing::random_int(random, 1, 8);
            const double error = strata::testing::random_int(random, 0, 8);
            points.push_back({time, error, ""});
        }
        const auto frontier = frontier_of(points);
        std::vector<bool> is_on(points.size());
        for (const std::size_t i : frontier) is_on[i] = true;
        std::size_t wrong = 0;
        for (std::size_t i = 0; i < points.size(); ++i) wrong += is_on[i] == is_beaten(points, i) ? 1 : 0;
        for (std::size_t k = 1; k < frontier.size(); ++k)
            wrong += points[frontier[k - 1]].time >= points[frontier[k]].time ? 1 : 0;
        CHECK(wrong == 0);
    }
}

TEST_CASE("a sentence says how its row's setting changes the row's figures") {
    std::vector<CostRow> rows{row_of("default", "front_to_back", 0.5, 2), row_of("depth", "d16 exact", 0.75, 3)};
    rows[1].opened = "d16";
    const auto descriptions = descriptions_of(rows);
    REQUIRE(descriptions.size() == 1);
    CHECK(
        descriptions[0] ==
        "made-up: depth d16 exact (with d16) instead of the default: 25.0000 % of pixels differ, RMSE 0.75 instead of "
        "0.5, 1.50 times the time (1.35 to 1.80), run literally 1.50 times the default's literal time, 1.50 times the "
        "card's.");
    // Rounds that overlap with those of the default, or too few rounds, give no significant ratio.
    const std::string errors = descriptions[0].substr(0, descriptions[0].find(", 1.50 times the time"));
    rows[1].usual->least = rows[0].usual->greatest;
    rows[1].literal->runs = 3;
    CHECK(descriptions_of(rows)[0] == errors + ", no other time beyond the noise of 5 rounds, 1.50 times the card's.");
    rows[1].usual->runs = 3;
    CHECK(descriptions_of(rows)[0] == errors + ", 3 rounds are too few to compare times, 1.50 times the card's.");
}

TEST_CASE(
    "the page's table has a row per choice and shows noise where the rounds of the default and of the choice overlap") {
    std::vector<CostRow> rows{row_of("default", "dual", 0.5, 2), row_of("depth", "d16", 0.75, 3),
                              row_of("depth", "d24", 0.5, 2.2), row_of("effects", "all", 0.5, 9)};
    rows[2].from_default = 0;
    rows[3].refusal = "no";
    const Table table = choice_table(rows);
    REQUIRE(table.rows.size() == 4);
    const std::vector<std::string> right{"made-up", "depth", "d16", "25.0000", "0.75", "1.50", "1.50", "1.50"};
    CHECK(table.rows[1] == right);
    CHECK(table.rows[0][5] == "1");
    CHECK(table.rows[2][5] == "noise");
    CHECK(table.rows[2][6] == "noise");
    CHECK(table.rows[3][4] == "refused");
    CHECK(summary_text(rows) ==
          "Of 3 choices other than the default, 1 change the picture, 1 do not, 1 are refused; 1 take another time "
          "beyond the "
          "noise of the rounds.");
}

TEST_CASE("a rejected row and a link of the chain have their own sentences") {
    std::vector<CostRow> rows{row_of("default", "dual", 0.5, 2), row_of("algorithm", "k_buffer rgba8", 0, 1),
                              row_of("chain", "snap", 0.125, 1), row_of("alone", "snap", 0.375, 1)};
    rows[1].refusal = "the card has none";
    CHECK(descriptions_of(rows) ==
          std::vector<std::string>{"made-up: algorithm k_buffer rgba8 is refused: the card has none.",
                                   "made-up: the chain exact up to snap leaves RMSE 0.125.",
                                   "made-up: snap exact alone leaves RMSE 0.375."});
}

TEST_CASE("times are given as ratios to the cheapest cell of their column and the last timing of a cell counts") {
    const Lines lines{made_line(0, "default", 0.5), made_line(1, "peels", 0.25)};
    const auto timing = [](int cell, double median) {
        return nlohmann::ordered_json{
            {"cell", cell},
            {"default", {{"median", median}, {"least", median / 2}, {"greatest", 2 * median}, {"rounds", 5}}},
            {"literal", nullptr}};
    };
    const auto rows = cost_rows(lines, {timing(0, 9), timing(1, 5), timing(0, 10)});
    REQUIRE(rows.size() == 2);
    CHECK(rows[0].usual->median == 2);
    CHECK(rows[0].usual->least == 1);
    CHECK(rows[1].usual->median == 1);
    CHECK(rows[0].modelled == 2);
    CHECK(rows[1].modelled == 1);
    CHECK_FALSE(rows[0].literal);
}

TEST_CASE("a cell has five rounds or up to 25 while they last under 2 s or exactly the requested number") {
    const auto rounds_of = [](double seconds_a_round, int asked) {
        int done = 0;
        while (wants_round(done, seconds_a_round * done, asked)) ++done;
        return done;
    };
    CHECK(rounds_of(0.001, 0) == 25);
    CHECK(rounds_of(0.25, 0) == 8);
    CHECK(rounds_of(0.5, 0) == 5);
    CHECK(rounds_of(60, 0) == 5);
    for (const int asked : {1, 3, 40}) CHECK(rounds_of(60, asked) == asked);
}

TEST_CASE("the oracle and algorithms that sort on the processor have no modelled time on a card") {
    for (const char* name : {"a_buffer", "painter"}) {
        Lines lines{made_line(0, "default", 0.5), made_line(1, "algorithm", 0.25)};
        lines[1]["algorithm"] = name;
        const auto rows = cost_rows(lines, {});
        CHECK(rows[0].modelled == 1);
        CHECK_FALSE(rows[1].modelled);
    }
}

TEST_CASE("a choice with the default's picture and the default's time within noise is not a separate point") {
    const auto names = [](const std::vector<CostRow>& rows, const char* column) {
        std::vector<std::string> all;
        for (const CostPoint& point : points_of(rows, "made-up", column)) all.push_back(point.name);
        return all;
    };
    using Names = std::vector<std::string>;
    const CostRow standard = row_of("default", "dual", 2, 1);
    const CostRow same = row_of("depth", "d24", 2, 0.98), other = row_of("depth", "d16", 3, 0.98);
    const CostRow faster = row_of("audit", "off", 2, 0.5);
    CHECK(names({standard, same, other, faster}, "default") == Names{"default dual", "depth d16", "audit off"});
    CHECK(names({standard, same, other, faster}, "literal") == Names{"default dual", "depth d16", "audit off"});
    // modelled from rates, hence without noise
    CHECK(names({standard, same}, "modelled") == Names{"default dual", "depth d24"});
}

TEST_CASE("the picture of a frontier names its points and no others") {
    const std::vector<CostPoint> points{{1, 4, "cheap"}, {2, 4, "worse"}, {3, 0, "exact"}};
    const std::string svg = frontier_svg(points, "title", "time");
    CHECK(svg.find(">1 cheap<") != std::string::npos);
    CHECK(svg.find(">2 exact<") != std::string::npos);
    CHECK(svg.find("<title>worse<") != std::string::npos);
    CHECK(svg.find(" worse<") == std::string::npos);
    CHECK(svg.find("nan") == std::string::npos);
    CHECK(svg.find("prefers-color-scheme: dark") != std::string::npos);
    CHECK(frontier_svg(points, "a<b&c", "time").find("a&lt;b&amp;c") != std::string::npos);
}

TEST_CASE("a scene name with a comma is quoted in the table") {
    std::vector<CostRow> rows{row_of("default", "dual", 0.5, 2)};
    rows[0].scene = "random:seed=1,triangles=3";
    CHECK(table_csv(rows).find("\n\"random:seed=1,triangles=3\",default,dual,done,0.5,0.25,2,1.8,2.4,8,7.2,9.6,6\n") !=
          std::string::npos);
}
