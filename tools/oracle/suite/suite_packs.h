// tools/oracle/suite/suite_packs.h - writes the suite as golden packs in a folder, with a table of the mistakes that
// each of them reveals.
//
// Rule     DIR/NAME is the pack of scene NAME, DIR/suite.json the list (tools/oracle/pack/PACK.md, "A suite"). All
//          files are derived from the scenes; a check derives them again.
// Tests    tests/tools/strata/diagnose/suite_command_test.cpp
#pragma once
#include <span>
#include <string>
#include <vector>

#include "tools/oracle/diagnosis/diagnosis.h"
#include "tools/oracle/pack/golden.h"
#include "tools/oracle/suite/suite.h"

namespace strata::oracle {

[[nodiscard]] Golden golden_of(const SuiteScene& scene);

// InputError unless the folder is missing or empty. Removed after a failure.
void write_suite(const std::string& folder, std::span<const SuiteScene* const> scenes,
                 const ShowProgress& progress = {}, Copies copies = Copies::none);

// True if `path` is a suite's folder or its suite.json.
[[nodiscard]] bool is_suite(const std::string& path);

// Empty if the suite is unchanged; file names are relative to its folder. InputError for a list with other scenes.
[[nodiscard]] std::vector<PackFault> check_suite(const std::string& path, Simd simd = Simd::best,
                                                 const ShowProgress& progress = {});

}  // namespace strata::oracle
