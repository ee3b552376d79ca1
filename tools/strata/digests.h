// tools/strata/digests.h - one string a target, equal exactly if the bits are: what strata info prints of each file.
#pragma once
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tools/strata/table.h"

namespace strata::tools {

// A row and an object a target, in the order of the files.
struct FileDigests {
    nlohmann::ordered_json document;
    Table table;
    bool all_read = true;  // else standard error has the reason
};

// `channels`: a digest a channel instead of one a target.
[[nodiscard]] FileDigests digests_of_files(const std::vector<std::string>& files, bool channels);

}  // namespace strata::tools
