// tools/library/names.cpp - looks up devices and algorithms by name; an unknown name is rejected with the nearest valid
// one.
#include "strata/names.h"

#include <vector>

#include "peeling/registry.h"
#include "rasterizer/base/input_error.h"
#include "scenes/files/profile_json.h"
#include "scenes/nearest_name.h"
#include "strata/version.h"

namespace strata {
inline namespace v0_1 {

std::string_view version() noexcept { return STRATA_VERSION; }

namespace {

[[noreturn]] void refuse_name(const char* thing, std::string_view name, const std::vector<std::string_view>& names,
                              const char* otherwise) {
    std::string list;
    for (const std::string_view known : names) (list += list.empty() ? "" : ", ") += known;
    throw InputError(thing, "name", list + otherwise, scenes::quoted_with_suggestion(name, names));
}

}  // namespace

DeviceProfile profile(const std::string& name_or_path) {
    if (const DeviceProfile* builtin = pipeline::find_profile(name_or_path)) return *builtin;
    if (name_or_path.ends_with(".json")) return scenes::load_profile(name_or_path);
    std::vector<std::string_view> names;
    for (const DeviceProfile& known : pipeline::builtin_profiles()) names.push_back(known.name);
    refuse_name("profile", name_or_path, names, ", or a file that ends in .json");
}

const Algorithm& algorithm(std::string_view name) {
    if (const Algorithm* found = peeling::find_algorithm(name)) return *found;
    std::vector<std::string_view> names;
    for (const Algorithm& known : peeling::algorithms()) names.push_back(known.name);
    refuse_name("algorithm", name, names, "");
}

}  // namespace v0_1
}  // namespace strata
