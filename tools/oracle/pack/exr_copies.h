// tools/oracle/pack/exr_copies.h - the expected targets of a pack as EXR files, for image viewers.
//
// Rule     tools/oracle/pack/PACK.md, "EXR copies": in the folders of the arrays, not in the manifest, and equal to the
//          arrays in every code.
// Tests    tests/tools/oracle/pack/exr_copies_test.cpp
#pragma once
#include <string>
#include <vector>

#include "tools/oracle/pack/golden.h"

namespace strata::oracle {

// Writes the copies into the folders of the arrays of the pack in `folder`.
void write_exr_copies(const std::string& folder);

// True if a pack's file is such a copy: "expected/dual/pass.003.exr".
[[nodiscard]] bool is_exr_copy(const std::string& file);
// The faults of those `copies` that differ from the arrays.
[[nodiscard]] std::vector<PackFault> check_exr_copies(const std::string& folder,
                                                      const std::vector<std::string>& copies);

}  // namespace strata::oracle
