// tools/lab/probe/files/pack.h - reads and writes the answers to a kit as a candidate pack (tools/oracle/pack/PACK.md).
//
// Rule     candidate.json has an object "probe": the kit's digest, the driver's features and limits by their keys in a
//          profile, and the items without an answer with the reason. probe/ORIENTATION/ITEM/color.npy and depth.npy
//          contain codes; a depth read by a shader is binary32 whatever the buffer's format, and is converted to the
//          nearest code. A folder or a tar archive of it can be read.
// Tests    tests/tools/lab/probe/pack_test.cpp
#pragma once
#include <nlohmann/json.hpp>
#include <string>

#include "pipeline/device/profile.h"
#include "tools/lab/probe/kit/item.h"

namespace strata::probe {

// "up" or "down".
[[nodiscard]] std::string_view name(YDirection y) noexcept;

using Answers = std::map<std::string, Reply>;

struct ProbePack {
    std::string made_by{};
    // Digest of the kit that was answered.
    std::string kit_digest{};
    // Keys of boolean and integer fields that are not rules: "has_d16", "max_samples". Missing keys are unknown.
    nlohmann::ordered_json device = nlohmann::ordered_json::object();
    // By the item's name, for each orientation that was drawn.
    std::map<YDirection, Answers> answers{};
};

// The answers of the profile's device to all items.
[[nodiscard]] ProbePack answer(const pipeline::DeviceProfile& profile, const std::vector<Item>& items,
                               const std::vector<YDirection>& orientations);
// `folder` must be missing or empty. It appears under its name when it is complete.
void write_pack(const ProbePack& pack, const std::vector<Item>& items, const std::string& folder);
// InputError if it is not such a pack, or one of another kit than `items`.
[[nodiscard]] ProbePack read_pack(const std::string& path, const std::vector<Item>& items);

}  // namespace strata::probe
