#include "tools/oracle/pack/manifest_value.h"

#include <fmt/format.h>

#include "peeling/registry.h"
#include "rasterizer/base/input_error.h"

namespace strata::oracle {

using nlohmann::json;

namespace {

const json& at_or(const json& object, const std::string& key, const json& fallback) {
    const auto found = object.find(key);
    return found == object.end() || found->is_null() ? fallback : *found;
}

}  // namespace

ManifestValue::ManifestValue(const json& value, const std::string& file, std::string pointer)
    : value_{&value}, file_{&file}, pointer_{std::move(pointer)} {
    if (!value.is_object()) throw InputError(file, pointer_.empty() ? "/" : pointer_, "an object", value.type_name());
}

ManifestValue ManifestValue::object(const std::string& key) const {
    static const json none = json::object();
    return {at_or(*value_, key, none), *file_, pointer_to(key)};
}

std::vector<ManifestValue> ManifestValue::list(const std::string& key) const {
    static const json none = json::array();
    const json& found = at_or(*value_, key, none);
    if (!found.is_array()) fail(key, "an array");
    std::vector<ManifestValue> values;
    for (std::size_t i = 0; i < found.size(); ++i)
        values.push_back({found[i], *file_, pointer_to(key) + "/" + std::to_string(i)});
    return values;
}

std::string ManifestValue::text(const std::string& key) const {
    static const json none = "";
    const json& found = at_or(*value_, key, none);
    if (!found.is_string()) fail(key, "a string");
    return found.get<std::string>();
}

int ManifestValue::whole(const std::string& key, int fallback, int lowest, int highest) const {
    const json none = fallback;
    const json& found = at_or(*value_, key, none);
    const bool fits = found.is_number_integer() && found >= lowest && found <= highest;
    if (!fits) fail(key, fmt::format("a whole number from {} to {}", lowest, highest));
    return found.get<int>();
}

std::string ManifestValue::algorithm(const std::string& key) const {
    const std::string found = text(key);
    if (peeling::find_algorithm(found) == nullptr) fail(key, "an algorithm (strata list algorithms shows them)");
    return found;
}

std::string ManifestValue::name(const std::string& key) const {
    const std::string found = text(key);
    if (found.find_first_of(std::string_view{"/\0", 2}) != std::string::npos) fail(key, "a name without a slash");
    return found;
}

void ManifestValue::fail(const std::string& key, const std::string& expected) const {
    const auto found = value_->find(key);
    const std::string shown = found == value_->end() ? "none"
                              : found->is_structured()
                                  ? found->type_name()
                                  : found->dump(-1, ' ', true, json::error_handler_t::replace).substr(0, 64);
    throw InputError(*file_, pointer_to(key), expected, shown);
}

}  // namespace strata::oracle
