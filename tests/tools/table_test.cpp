#include "tools/strata/table.h"

#include <catch2/catch.hpp>

#include "tools/strata/options/parse.h"

using namespace strata::tools;

TEST_CASE("columns align by characters, not by bytes, and no line ends in a space") {
    const Table table{{{"name"}, {"n", Align::right}, {"note"}}, {{"Käse", "7", ""}, {"Brot", "1234", "fresh"}}};
    CHECK(to_text(table) ==
          "name     n  note\n"
          "Käse     7\n"
          "Brot  1234  fresh\n");
}

TEST_CASE("a number counts only if all of its text is one") {
    CHECK(to_int("12") == 12);
    CHECK(to_number<float>("0.1") == 0.1f);
    for (const char* text : {"", " 1", "1 ", "1,5", "0x10", "1e999", "inf", "nan", "+1"}) {
        INFO(text);
        CHECK_FALSE(to_number<double>(text).has_value());
    }
    CHECK_FALSE(to_int("99999999999").has_value());
    CHECK_FALSE(to_numbers<double>("1,2,", 2).has_value());
    CHECK(to_numbers<double>("-30,20", 2) == std::vector<double>{-30, 20});
}
