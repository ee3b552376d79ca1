// tools/probe/operations_pack.h - reads and writes results of operations as files of a pack.
//
// Rule     probe/operations/NAME.npy: (rows, columns, 4) words, row 0 of memory first. candidate.json has the list's
//          digest as probe.operations; without it the pack was written before operations existed, and has none.
// Tests    tests/tools/probe/operations_test.cpp
#pragma once
#include <map>
#include <string>

#include "scenes/packs/npy.h"
#include "tools/probe/operations.h"

namespace strata::probe {

[[nodiscard]] std::string operation_file(const std::string& name);
[[nodiscard]] scenes::NumberArray as_array(const Operation& operation, const std::vector<Texel>& texels);
// `probe` is the object of that name; `files` are the pack's files by name, and `path` is its name for errors.
// InputError for another list of operations and for an array of another shape.
[[nodiscard]] OperationReplies read_operations(const nlohmann::json& probe,
                                               const std::map<std::string, std::string>& files,
                                               const std::string& path);

}  // namespace strata::probe
