// tools/strata/digests.h - digests of pictures, as strata info prints them: one string per target, equal exactly if all
// bits are equal.
#pragma once
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tools/strata/table.h"

namespace strata::tools {

// One row and one JSON object per target, in the order of the files.
struct FileDigests {
    nlohmann::ordered_json document;
    Table table;
    bool all_read = true;  // false: some files could not be read, with the reasons on standard error
};

// `channels`: one digest per channel instead of one per target.
[[nodiscard]] FileDigests digests_of_files(const std::vector<std::string>& files, bool channels);

}  // namespace strata::tools
