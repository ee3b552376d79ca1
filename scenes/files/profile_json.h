// scenes/files/profile_json.h - reads and writes device profiles as JSON.
//
// Rule     An object with "name", "description" and every key of pipeline/device/profile_fields.h ("raster" is an
//          object of its own). A file with a "base", the name of a built-in profile, contains only the differing
//          fields. A file without one may omit fields that were added after the first packs; they have the value that
//          describes the earlier behaviour. "open" lists keys of fields whose values no observation determines. Unknown
//          keys and values of another type or outside their range are errors with the file and the JSON pointer.
// Tests    tests/scenes/files/profile_json_test.cpp
#pragma once
#include <span>
#include <string>
#include <vector>

#include "pipeline/device/profile.h"

namespace strata::scenes {

// All fields, indented, in the table's order; parse_profile of the result gives an equal profile. `open`: keys of
// fields whose values no observation determines, from `strata infer`.
[[nodiscard]] std::string to_json(const pipeline::DeviceProfile& profile, std::span<const std::string> open = {});

[[nodiscard]] pipeline::DeviceProfile parse_profile(const std::string& text, const std::string& file);

// A built-in profile by name, or a JSON file; InputError suggests the nearest name.
[[nodiscard]] pipeline::DeviceProfile load_profile(const std::string& name_or_path);
// The keys listed as "open" in a profile's file; none for a built-in profile.
[[nodiscard]] std::vector<std::string> open_fields(const std::string& name_or_path);

}  // namespace strata::scenes
