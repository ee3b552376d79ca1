// tools/lab/sweep/leftovers.cpp - deletes the temporary files that an interrupted run of this shard left behind.
#include "tools/lab/sweep/leftovers.h"

#include <filesystem>

#include "scenes/files/atomic_file.h"
#include "tools/strata/options/parse.h"

namespace strata::tools {

namespace {

template <class IsOurs>
void remove_temporaries(const std::filesystem::path& folder, IsOurs is_ours) {
    std::error_code error;  // ignored: a missing folder contains no temporary files
    for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
        const std::string target = scenes::target_of_temporary(entry.path().filename().string());
        if (!target.empty() && is_ours(target)) std::filesystem::remove(entry.path(), error);
    }
}

}  // namespace

void remove_leftovers(const std::string& folder, const Shard& shard) {
    const auto is_shards = [&](const std::string& target) {
        const auto is_at = [&](const char* stem) { return shard_file("", stem, shard) == target; };
        return is_at("results") || is_at("timings") || (shard.count == 1 && target == "results.csv");
    };
    remove_temporaries(folder, is_shards);
    remove_temporaries(std::filesystem::path(folder) / "images", [&](const std::string& target) {
        const auto cell = to_int<std::size_t>(target.substr(0, target.find('.')));
        return cell && *cell % shard.count == shard.index - 1;
    });
}

}  // namespace strata::tools
