// pipeline/device/profile_fields.h - the one table of a profile's fields: its JSON key, its range or names, its sources.
// describe() and the JSON of scenes/files/profile_json.h both walk it, so a new field is one row.
#pragma once
#include <array>
#include <span>
#include <string>
#include <string_view>

#include "pipeline/device/profile.h"

namespace strata::pipeline {

enum class FieldKind : std::uint8_t { boolean, integer, choice };

struct ProfileField {
    std::string_view key;  // "has_d32f"; "raster.snap" lies in the object "raster"
    FieldKind kind{};
    std::span<const std::string_view> choices;  // choice: the names of its values 0, 1, ...
    int lowest = 0, highest = 1, step = 1;      // integer: lowest, lowest + step, ..., highest
    int (*value)(const DeviceProfile&) = nullptr;
    void (*set)(DeviceProfile&, int) = nullptr;  // the caller has checked the range
    std::array<std::string_view, 4> source;      // geforce3, geforce8 and geforce8_dx101, ideal, llvmpipe
};

[[nodiscard]] std::span<const ProfileField> profile_fields();

// "true", "12" or "nearest_even".
[[nodiscard]] std::string text_of(const ProfileField& field, const DeviceProfile& profile);

}  // namespace strata::pipeline
