// Tests the catalogue of mistakes: the picture of each mistake is diagnosed like any candidate, and the diagnosis must
// name that mistake.
#include "tools/oracle/emulations/catalogue.h"

#include <catch2/catch.hpp>
#include <set>

#include "rasterizer/base/parallel.h"
#include "tools/oracle/suite/mistake_table.h"

using namespace strata;
using namespace strata::oracle;

TEST_CASE("mistakes have unique names and sentences and are found by name") {
    std::set<std::string_view> names, descriptions;
    for (const Mistake& mistake : catalogue()) {
        names.insert(mistake.name);
        descriptions.insert(mistake.description);
        CHECK(find_mistake(mistake.name) == &mistake);
    }
    CHECK(catalogue().size() >= 40);
    CHECK(names.size() == catalogue().size());
    CHECK(descriptions.size() == catalogue().size());
    CHECK(find_mistake("no_mistake") == nullptr);
}

namespace {

// Number of mistakes that are diagnosed as another one or reported for a correct picture.
int wrong_cells(const TableColumn& column) {
    int wrong = 0;
    for (const TableAnswer cell : column.cells)
        wrong += cell == TableAnswer::wrong || cell == TableAnswer::accused ? 1 : 0;
    return wrong;
}

}  // namespace

TEST_CASE(
    "in every fifth scene of the suite no mistake is diagnosed as another one and no correct picture has a mistake") {
    for (std::size_t i = 0; i < suite().size(); i += 5) {
        INFO(suite()[i].name);
        CHECK(wrong_cells(table_column(suite()[i])) == 0);
    }
}

TEST_CASE("mistakes with samples are named in a scene of four samples and no other mistake is named for them") {
    const TableColumn column = table_column(*find_suite_scene("samples.front_to_back"));
    CHECK(wrong_cells(column) == 0);
    const std::size_t shown = static_cast<std::size_t>(std::ranges::count(column.cells, TableAnswer::named));
    CHECK(shown > 40);
    for (std::size_t m = 0; m < mistakes_of_samples().size(); ++m) {
        INFO(catalogue()[m].name);
        const bool is_own_rule = catalogue()[m].name == "alpha_to_coverage_on_nearest";  // of this scene's profile
        CHECK((column.cells[m] == TableAnswer::named || column.cells[m] == TableAnswer::alike) != is_own_rule);
    }
}

TEST_CASE("every mistake is identified in a scene of the suite and never where it does not show and no two look alike",
          "[exhaustive]") {
    std::vector<TableColumn> columns(suite().size());
    parallel_for(columns.size(), 0, [&](std::size_t i) { columns[i] = table_column(suite()[i]); });
    int wrong = 0;
    for (const TableColumn& column : columns) wrong += wrong_cells(column);
    CHECK(wrong == 0);
    std::vector<std::string_view> unnamed;
    for (std::size_t m = 0; m < catalogue().size(); ++m)
        if (std::ranges::none_of(columns, [&](const TableColumn& c) { return c.cells[m] == TableAnswer::named; }))
            unnamed.push_back(catalogue()[m].name);
    CHECK(unnamed == std::vector<std::string_view>{"add_for_max"});
    for (const LookAlikes& pair : look_alikes(columns)) {
        INFO(pair.first->name << " and " << pair.second->name);
        CHECK(reason_for(pair) != nullptr);
    }
}
