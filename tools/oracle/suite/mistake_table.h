// tools/oracle/suite/mistake_table.h - a table of the mistakes and the scenes of the suite, with the result of a
// diagnosis for each.
//
// Rule     The image of each mistake is diagnosed like any candidate. Two mistakes are distinguished if their images of
//          some scene differ, or if one of them changes the image there and the other one is not applicable.
// Tests    tests/tools/oracle/emulations/catalogue_test.cpp
#pragma once
#include <string>
#include <vector>

#include "tools/oracle/diagnosis/diagnosis.h"
#include "tools/oracle/suite/suite.h"

namespace strata::oracle {

enum class TableAnswer : std::uint8_t {
    named,      // the diagnosis reports this mistake first
    alike,      // another mistake with the same image is reported, and this one is listed with it
    wrong,      // the diagnosis reports something else
    hidden,     // the image is correct, and the diagnosis says so
    accused,    // the image is correct, and a mistake is reported
    impossible  // not applicable to this scene
};

struct TableColumn {
    const SuiteScene* scene = nullptr;
    std::vector<TableAnswer> cells{};    // one per mistake of the catalogue
    std::vector<std::size_t> picture{};  // per mistake; equal for equal images; 0: correct or none
};
[[nodiscard]] TableColumn table_column(const SuiteScene& scene);

struct LookAlikes {
    const Mistake* first = nullptr;
    const Mistake* second = nullptr;
};
// Pairs of mistakes that no scene distinguishes.
[[nodiscard]] std::vector<LookAlikes> look_alikes(const std::vector<TableColumn>& columns);
// The reason why two mistakes give equal images in all scenes, as one sentence; null if none is stated.
[[nodiscard]] const char* reason_for(const LookAlikes& pair);
// True if it is the second mistake of such a pair, for which the first one is always reported.
[[nodiscard]] bool is_declared_look_alike(const Mistake& mistake);
// The scenes in which a mistake of the catalogue is reported first.
[[nodiscard]] std::vector<const SuiteScene*> named_in(const std::vector<TableColumn>& columns, std::size_t mistake);
// Mistakes that no scene reveals.
[[nodiscard]] std::vector<const Mistake*> unnamed(const std::vector<TableColumn>& columns);

// A page in Markdown: the results, the table, the scenes with their commands, descriptions of the mistakes. `plot`:
// file name of the chart, which is in the same folder; empty: none.
[[nodiscard]] std::string to_page(const std::vector<TableColumn>& columns, const std::string& plot);
// The chart as SVG: the number of mistakes per scene, one bar each.
[[nodiscard]] std::string to_svg(const std::vector<TableColumn>& columns);

}  // namespace strata::oracle
