// pipeline/device/profile_fields.h - the table of a profile's fields: JSON key, range or names, and sources. describe()
// and the JSON of scenes/files/profile_json.h both use it, so a new field is one entry.
#pragma once
#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "pipeline/device/profile.h"

namespace strata::pipeline {

enum class FieldKind : std::uint8_t { boolean, integer, choice };

struct ProfileField {
    // "has_d32f"; a key with the prefix "raster." is in the object "raster" of the JSON.
    std::string_view key;
    FieldKind kind{};
    // For a choice: the names of its values 0, 1, ...
    std::span<const std::string_view> choices;
    // The allowed values: lowest, lowest + step, ..., highest. A boolean is 0 or 1, a choice the index of its name.
    int lowest = 0, highest = 1, step = 1;
    // Read and write the field as such a number; the caller of `set` must have checked the range.
    int (*value)(const DeviceProfile&) = nullptr;
    void (*set)(DeviceProfile&, int) = nullptr;
    // The sources for geforce3; for geforce8 and geforce8_dx101; for ideal; for Mesa's profiles; for swiftshader; and
    // for direct3d11. pipeline/reference/devices.md explains the marks.
    std::array<std::string_view, 6> source;
};

[[nodiscard]] std::span<const ProfileField> profile_fields();

// "true", "12" or "nearest_even".
[[nodiscard]] std::string text_of(const ProfileField& field, const DeviceProfile& profile);

// A field's value that conflicts with another field.
struct FieldConflict {
    std::string_view key;  // "raster.coverage"
    std::string expected, found;
};
// The first conflict between a profile's values, if there is one (devices.md 3.1): spans in binary32 may cover centres
// that exact edges exclude, where the edge values from which NV2A's weights are computed are negative.
[[nodiscard]] std::optional<FieldConflict> conflict_of(const DeviceProfile& profile);

}  // namespace strata::pipeline
