#include "tools/lab/sweep/shard.h"

#include <fmt/format.h>

#include <filesystem>

#include "tools/request/parse.h"
#include "tools/strata/options/option.h"

namespace strata::tools {

std::vector<std::size_t> Shard::rows(std::size_t all) const {
    std::vector<std::size_t> mine;
    for (std::size_t row = index - 1; row < all; row += count) mine.push_back(row);
    return mine;
}

std::optional<Shard> to_shard(std::string_view text) {
    const auto parts = split(text, '/');
    if (parts.size() != 2) return std::nullopt;
    const auto index = to_positive(parts[0]), count = to_positive(parts[1]);
    if (!index || !count || *index > *count) return std::nullopt;
    return Shard{static_cast<std::size_t>(*index), static_cast<std::size_t>(*count)};
}

std::string shard_file(const std::string& folder, const std::string& stem, const std::string& ending,
                       const Shard& shard) {
    const std::string part = shard.count == 1 ? "" : fmt::format(".{}of{}", shard.index, shard.count);
    return (std::filesystem::path(folder) / (stem + part + ending)).string();
}

void add_shard_option(CLI::App& app, Shard& shard) {
    add_option(app, shard,
               {"--shard", "K/N", "measure only the rows K, K + N, ... (tools/cluster joins the shards)",
                "K/N with K from 1 to N"},
               to_shard);
}

}  // namespace strata::tools
