#include "tools/lab/sweep/shard.h"

#include <fmt/format.h>

#include <filesystem>

#include "tools/strata/options/parse.h"

namespace strata::tools {

std::vector<std::size_t> Shard::cells(std::size_t all) const {
    std::vector<std::size_t> mine;
    // Strided instead of blocks: neighbouring cells take about equally long, so that shards end at about the same time.
    for (std::size_t cell = index - 1; cell < all; cell += count) mine.push_back(cell);
    return mine;
}

std::optional<Shard> to_shard(std::string_view text) {
    const auto parts = split(text, '/');
    if (parts.size() != 2) return std::nullopt;
    const auto index = to_positive(parts[0]), count = to_positive(parts[1]);
    if (!index || !count || *index > *count) return std::nullopt;
    return Shard{static_cast<std::size_t>(*index), static_cast<std::size_t>(*count)};
}

std::string shard_file(const std::string& folder, const std::string& stem, const Shard& shard) {
    const std::string part = shard.count == 1 ? "" : fmt::format(".{}of{}", shard.index, shard.count);
    return (std::filesystem::path(folder) / (stem + part + ".jsonl")).string();
}

}  // namespace strata::tools
