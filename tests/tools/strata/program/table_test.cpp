// Tests tables and the parsing of numbers. The expected lines are written by hand.
#include "tools/strata/table.h"

#include <catch2/catch.hpp>

#include "tools/request/parse.h"

using namespace strata::tools;

TEST_CASE("columns align by characters and not by bytes and no line ends in a space") {
    const Table table{{{"name"}, {"n", Align::right}, {"note"}}, {{"Käse", "7", ""}, {"Brot", "1234", "fresh"}}};
    CHECK(to_text(table) ==
          "name     n  note\n"
          "Käse     7\n"
          "Brot  1234  fresh\n");
}

TEST_CASE("text is a number only if all of it is") {
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

TEST_CASE("every line of a table has its cells below the column titles for any widths and alignment") {
    std::string wrong;
    for (std::size_t seed = 0; seed < 200; ++seed) {
        Table table;
        const std::size_t columns = 1 + seed % 4, rows = seed / 4 % 5;
        const auto text = [&](std::size_t k) {
            return std::string((seed * 7 + k * 5) % 9, static_cast<char>('a' + k % 26));
        };
        for (std::size_t c = 0; c < columns; ++c)
            table.columns.push_back({"T" + text(c), (seed >> c & 1) != 0 ? Align::right : Align::left});
        for (std::size_t r = 0; r < rows; ++r) {
            table.rows.emplace_back();
            for (std::size_t c = 0; c < columns; ++c) table.rows[r].push_back(text(r * columns + c + 3));
        }
        std::string expected;
        for (std::size_t line = 0; line <= rows; ++line) {
            std::string whole;
            for (std::size_t c = 0; c < columns; ++c) {
                std::size_t width = table.columns[c].title.size();
                for (const auto& row : table.rows) width = row[c].size() > width ? row[c].size() : width;
                const std::string& cell = line == 0 ? table.columns[c].title : table.rows[line - 1][c];
                std::string place(width, ' ');
                place.replace(table.columns[c].align == Align::right ? width - cell.size() : 0, cell.size(), cell);
                whole += (c == 0 ? "" : "  ") + place;
            }
            while (!whole.empty() && whole.back() == ' ') whole.pop_back();
            expected += whole + "\n";
        }
        if (to_text(table) != expected && wrong.empty()) wrong = to_text(table);
    }
    CHECK(wrong == "");
}

TEST_CASE("positive integers and seconds and parts between separators are read as written") {
    CHECK(to_positive("1") == 1);
    CHECK(to_positive("2147483647") == 2147483647);
    for (const char* text : {"0", "-1", "2147483648", "1.0", ""}) CHECK_FALSE(to_positive(text));
    CHECK(to_seconds("0") == 0);
    CHECK(to_seconds("1e-3") == 0.001);
    for (const char* text : {"-0.001", "inf", "", "1s"}) CHECK_FALSE(to_seconds(text));
    using Parts = std::vector<std::string>;
    CHECK(split("", ',') == Parts{""});
    CHECK(split(",", ',') == Parts{"", ""});
    CHECK(split("a,b,", ',') == Parts{"a", "b", ""});
    CHECK(split("a:b", ',') == Parts{"a:b"});
    CHECK_FALSE(to_numbers<double>("1,2,3", 2));
    CHECK_FALSE(to_numbers<double>("1", 2));
    CHECK(to_int<std::uint64_t>("18446744073709551615") == UINT64_MAX);
    CHECK_FALSE(to_int<std::uint64_t>("-1"));
    CHECK(to_number<double>("-2.5e-3") == -0.0025);
}
