// tools/probe/pack.h - a kit's answers as files: a candidate pack (tools/oracle/PACK.md).
//
// Rule     candidate.json has an object "probe": the kit's digest, the driver's features and limits by their keys in a
//          profile, and the items without an answer with the reason. probe/ORIENTATION/ITEM/color.npy and depth.npy
//          hold codes; a depth that a shader read is binary32 whatever the buffer's format, and becomes the nearest
//          code. Read are a folder and a tar archive of it.
// Tests    tests/tools/probe/pack_test.cpp
#pragma once
#include <nlohmann/json.hpp>
#include <string>

#include "pipeline/device/profile.h"
#include "tools/probe/item.h"
#include "tools/probe/operations.h"

namespace strata::probe {

// "up" or "down".
[[nodiscard]] std::string_view name(YDirection y) noexcept;

using Answers = std::map<std::string, Reply>;

struct ProbePack {
    std::string made_by{};
    // Of the kit that was answered.
    std::string kit_digest{};
    // Keys of boolean and integer fields that are no rule: "has_d16", "max_samples". What is absent is not known.
    nlohmann::ordered_json device = nlohmann::ordered_json::object();
    // By the item's name, for each orientation that was drawn.
    std::map<YDirection, Answers> answers{};
    // None in a pack from before there were operations, and in answers to other scenes than the kit.
    OperationReplies operations{};
};

// All items answered by a device that is the profile.
[[nodiscard]] ProbePack answer(const pipeline::DeviceProfile& profile, const std::vector<Item>& items,
                               const std::vector<YDirection>& orientations);
// `folder` must not exist or be empty. It appears under its name when it is complete.
void write_pack(const ProbePack& pack, const std::vector<Item>& items, const std::string& folder);
// InputError for what is no such pack, or one of another kit than `items`.
[[nodiscard]] ProbePack read_pack(const std::string& path, const std::vector<Item>& items);

}  // namespace strata::probe
