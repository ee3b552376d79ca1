// tools/oracle/pack/exr_copies.h - the expected targets of a pack once more as EXR files, for readers of pictures
// rather than arrays.
//
// Rule     tools/oracle/PACK.md, "EXR copies": beside the arrays, not in the manifest, and equal to them in every code.
// Tests    tests/tools/oracle/exr_copies_test.cpp
#pragma once
#include <string>
#include <vector>

#include "tools/oracle/pack/golden.h"

namespace strata::oracle {

// Beside the arrays of the pack in `folder`.
void write_exr_copies(const std::string& folder);

// Whether a pack's file is one: "expected/dual/pass.003.exr".
[[nodiscard]] bool is_exr_copy(const std::string& file);
// Of `copies`, those that do not hold what the arrays hold.
[[nodiscard]] std::vector<PackFault> check_exr_copies(const std::string& folder,
                                                      const std::vector<std::string>& copies);

}  // namespace strata::oracle
