// scenes/files/profile_json.h - device profiles as JSON, both ways.
//
// Rule     An object with "name", "description" and every key of pipeline/device/profile_fields.h ("raster" is an
//          object of its own). A file that names a "base" among the built-in profiles writes only what differs; one
//          without may leave out fields that came after the first packs: they have the value that the machine had
//          before. "open" lists keys of fields whose values nothing shows. Unknown keys, values of another type or
//          outside their range are errors that name the file and the JSON pointer.
// Tests    tests/scenes/files/profile_json_test.cpp
#pragma once
#include <span>
#include <string>
#include <vector>

#include "pipeline/device/profile.h"

namespace strata::scenes {

// Every field, indented, in the table's order; parse_profile gives an equal profile back. `open`: keys of fields whose
// values nothing shows, as `strata infer` leaves them.
[[nodiscard]] std::string to_json(const pipeline::DeviceProfile& profile, std::span<const std::string> open = {});

[[nodiscard]] pipeline::DeviceProfile parse_profile(const std::string& text, const std::string& file);

// A built-in profile by name, else a JSON file; InputError suggests the nearest name.
[[nodiscard]] pipeline::DeviceProfile load_profile(const std::string& name_or_path);
// The keys that the file of a profile calls open; none for a built-in one.
[[nodiscard]] std::vector<std::string> open_fields(const std::string& name_or_path);

}  // namespace strata::scenes
