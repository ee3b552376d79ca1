// tools/oracle/mistakes/mistake_table.h - which mistake shows in which scene of the suite, and what a diagnosis says
// there.
//
// Rule     The picture of each mistake is diagnosed like anybody's. Two mistakes are told apart if their pictures of
//          some scene differ, or if one of them can be made there and shows, and the other one cannot be made.
// Tests    tests/tools/oracle/mistakes/catalogue_test.cpp
#pragma once
#include <string>
#include <vector>

#include "tools/oracle/mistakes/diagnosis.h"
#include "tools/oracle/mistakes/suite.h"

namespace strata::oracle {

enum class Cell : std::uint8_t {
    named,      // the diagnosis names this mistake first
    alike,      // another one leaves the same picture and is named; this one stands beside it
    wrong,      // the diagnosis names something else
    hidden,     // the picture is the right one, and so is the diagnosis
    accused,    // the picture is the right one, and a mistake is named
    impossible  // cannot be made here
};

struct TableColumn {
    const SuiteScene* scene = nullptr;
    std::vector<Cell> cells{};           // a mistake of the catalogue each
    std::vector<std::size_t> picture{};  // a number for each different picture; 0: the right one, or none
};
[[nodiscard]] TableColumn table_column(const SuiteScene& scene);

struct LookAlikes {
    const Mistake* first = nullptr;
    const Mistake* second = nullptr;
};
// Mistakes that no column tells apart.
[[nodiscard]] std::vector<LookAlikes> look_alikes(const std::vector<TableColumn>& columns);
// Why two mistakes can leave no unequal pictures, a sentence; null where none is stated.
[[nodiscard]] const char* reason_for(const LookAlikes& pair);
// Whether it is the second one of such a pair: always named by the first one's name.
[[nodiscard]] bool is_declared_look_alike(const Mistake& mistake);
// The scenes in which a mistake of the catalogue is named first.
[[nodiscard]] std::vector<const SuiteScene*> named_in(const std::vector<TableColumn>& columns, std::size_t mistake);
// Mistakes that no column names.
[[nodiscard]] std::vector<const Mistake*> unnamed(const std::vector<TableColumn>& columns);

// A page in Markdown: what was found, the table, the scenes with their commands, the mistakes in words. `plot`: the
// file beside the page that holds the drawing; empty: none.
[[nodiscard]] std::string to_page(const std::vector<TableColumn>& columns, const std::string& plot);
// That drawing, an SVG file: how many mistakes each scene shows, a bar a scene.
[[nodiscard]] std::string to_svg(const std::vector<TableColumn>& columns);

}  // namespace strata::oracle
