// strata/names.h - looks up devices and algorithms by name.
#pragma once
#include <string>
#include <string_view>

#include "peeling/algorithms/algorithm.h"
#include "pipeline/device/profile.h"
#include "rasterizer/base/input_error.h"

namespace strata {
inline namespace v0_1 {

using peeling::Algorithm;
using pipeline::DeviceProfile;

// A built-in profile, or the profile in a .json file. Throws InputError, which lists the names and suggests the
// nearest.
[[nodiscard]] DeviceProfile profile(const std::string& name_or_path);
// Throws InputError, which lists the names and suggests the nearest.
[[nodiscard]] const Algorithm& algorithm(std::string_view name);

}  // namespace v0_1
}  // namespace strata
