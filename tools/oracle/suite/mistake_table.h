// tools/oracle/suite/mistake_table.h - the results of diagnosing every mistake on a scene of the suite.
//
// Rule     The image of each mistake is diagnosed like any candidate. Two mistakes are distinguished if their images of
//          some scene differ, or if one of them changes the image there and the other one is not applicable.
// Tests    tests/tools/oracle/emulations/catalogue_test.cpp
#pragma once
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

}  // namespace strata::oracle
