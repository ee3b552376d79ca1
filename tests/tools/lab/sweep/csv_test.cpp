// Tests the conversion of JSON lines to CSV. The expected rows are written by hand after RFC 4180.
#include "tools/lab/sweep/csv.h"

#include <catch2/catch.hpp>

using strata::tools::csv_of_columns;

TEST_CASE("columns are JSON pointers and missing values are empty fields and only fields that need quotes have them") {
    const strata::tools::Lines lines{
        {{"name", "a, \"b\""}, {"inner", {{"count", 3}}}, {"none", nullptr}},
        {{"name", "plain"}, {"inner", nullptr}, {"none", 0.5}},
    };
    CHECK(csv_of_columns({"/name", "/inner/count", "/none"}, lines) ==
          "name,inner.count,none\n\"a, \"\"b\"\"\",3,\nplain,,0.5\n");
}
