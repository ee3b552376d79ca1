// tools/oracle/mistakes/suite_packs.h - the suite as golden packs in a folder, with a table of the mistakes that each
// of them shows.
//
// Rule     DIR/NAME is the pack of scene NAME, DIR/suite.json the list (tools/oracle/PACK.md, "A suite"). All of it is
//          derived: a check derives it again.
// Tests    tests/tools/suite_command_test.cpp
#pragma once
#include <span>
#include <string>
#include <vector>

#include "tools/oracle/mistakes/diagnosis.h"
#include "tools/oracle/mistakes/suite.h"
#include "tools/oracle/pack/golden.h"

namespace strata::oracle {

[[nodiscard]] Golden golden_of(const SuiteScene& scene);

// Into a folder that is not there yet or is empty, else InputError. A failure leaves nothing behind.
void write_suite(const std::string& folder, std::span<const SuiteScene* const> scenes,
                 const ShowProgress& progress = {}, Copies copies = Copies::none);

// Whether `path` is a suite's folder or its suite.json.
[[nodiscard]] bool is_suite(const std::string& path);

// Empty for a suite as it was written; names of files are relative to its folder. InputError for a list that names
// other scenes.
[[nodiscard]] std::vector<PackFault> check_suite(const std::string& path, Simd simd = Simd::best,
                                                 const ShowProgress& progress = {});

}  // namespace strata::oracle
