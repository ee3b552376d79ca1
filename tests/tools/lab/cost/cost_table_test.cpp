// Tests the ranking of `strata cost` on invented rows. The order and the texts are written by hand.
#include "tools/lab/cost/cost_table.h"

#include <catch2/catch.hpp>

namespace {

using namespace strata::tools;
using nlohmann::ordered_json;

ordered_json line_of(const char* knob, const char* value, ordered_json sorted, ordered_json exact) {
    const bool is_refused = exact.is_null();
    return {{"scene", "made-up"},
            {"knob", knob},
            {"value", value},
            {"opened", ""},
            {"algorithm", value},
            {"sorted_rmse", sorted},
            {"rmse", exact},
            {"modelled_seconds", 1.5},
            {"outcome", is_refused ? "refused" : "done"}};
}

ordered_json timing_of(double median, int rounds = 5) {
    return {{"default", {{"median", median}, {"least", median * 0.9}, {"greatest", median * 1.2}, {"rounds", rounds}}}};
}

std::vector<std::string> column(const Table& table, std::size_t c) {
    std::vector<std::string> cells;
    for (const auto& row : table.rows) cells.push_back(row[c]);
    return cells;
}

using Cells = std::vector<std::string>;

}  // namespace

TEST_CASE("rows are ranked by their own error and then by the exact one and then by time") {
    const ordered_json untimed{{"default", nullptr}};
    const Lines lines{line_of("default", "dual", 0.5, 2),        line_of("algorithm", "slow", 0.25, 3),
                      line_of("chain", "snap", nullptr, 1),      line_of("algorithm", "refused", nullptr, nullptr),
                      line_of("algorithm", "quick", 0.25, 3),    line_of("algorithm", "rounded less", 0.25, 2.5),
                      line_of("algorithm", "worst", 0.75, 0.125)};
    const Lines timings{timing_of(1), timing_of(4), untimed, untimed, timing_of(2), timing_of(9), timing_of(0.5)};
    const Table table = ranked_table(lines, timings);
    CHECK(column(table, 3) == Cells{"rounded less", "quick", "slow", "dual", "worst", "snap", "refused"});
    CHECK(column(table, 0) == Cells{"1", "2", "3", "4", "5", "-", "-"});
    CHECK(column(table, 4) == Cells{"0.25", "0.25", "0.25", "0.5", "0.75", "-", "refused"});
    CHECK(column(table, 5) == Cells{"2.5", "3", "3", "2", "0.125", "1", "-"});
    CHECK(column(table, 6) == Cells{"9.00 (8.10 to 10.80)", "2.00 (1.80 to 2.40)", "4.00 (3.60 to 4.80)", "1",
                                    "0.50 (0.45 to 0.60)", "-", "-"});
}

TEST_CASE("a time whose rounds overlap those of the default or are too few has a question mark") {
    const Lines lines{line_of("default", "dual", 0, 1), line_of("depth", "d16", 1, 1), line_of("depth", "d24", 2, 1)};
    const Table table = ranked_table(lines, {timing_of(1), timing_of(1.1), timing_of(9, 3)});
    CHECK(column(table, 6) == Cells{"1", "1.10 (0.99 to 1.32) ?", "9.00 (8.10 to 10.80) ?"});
}

TEST_CASE("the best exact and the best approximate algorithm and the quickest row are said in three lines") {
    const Lines lines{line_of("default", "front_to_back", 0.02, 2),     line_of("algorithm", "dual", 0.01, 3),
                      line_of("algorithm", "moments", 0.5, 4),          line_of("algorithm", "weighted_sum", 0.25, 5),
                      line_of("algorithm", "a_buffer", 0, 1),           line_of("depth", "d16", 9, 9),
                      line_of("algorithm", "painter", nullptr, nullptr)};
    const Lines timings{timing_of(1), timing_of(2),     timing_of(0.25),       timing_of(0.75),
                        timing_of(7), timing_of(0.125), {{"default", nullptr}}};
    CHECK(best_rows(lines, timings) ==
          "made-up, best exact algorithm: algorithm dual: RMSE 0.01 from sorted, 3 from exact, 2.00 of the default's "
          "time\n"
          "made-up, best approximate algorithm: algorithm weighted_sum: RMSE 0.25 from sorted, 5 from exact, 0.75 of "
          "the default's time\n"
          "made-up, least time: depth d16: RMSE 9 from sorted, 9 from exact, 0.12 of the default's time\n");
}

TEST_CASE("each scene has its own ranks and its own default") {
    Lines lines{line_of("default", "a", 1, 1), line_of("depth", "b", 2, 1), line_of("default", "c", 0, 0),
                line_of("depth", "d", 0.5, 1)};
    lines[1]["opened"] = "d16";
    lines[2]["scene"] = lines[3]["scene"] = "other";
    lines[3]["modelled_seconds"] = 4.5;
    const Table table = ranked_table(lines, {timing_of(1), timing_of(2), timing_of(1), timing_of(2)});
    CHECK(column(table, 0) == Cells{"1", "2", "1", "2"});
    CHECK(column(table, 3) == Cells{"a", "b (with d16)", "c", "d"});
    CHECK(column(table, 7) == Cells{"1.00", "1.00", "1.00", "3.00"});
}
