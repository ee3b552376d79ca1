// scenes/packs/json_fields.cpp - numbers as decimals and bits, and the errors of a field that is missing or unknown
// (json_fields.h).
#include "scenes/packs/json_fields.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>

#include "rasterizer/base/input_error.h"
#include "scenes/files/strict_json.h"
#include "scenes/nearest_name.h"

namespace strata::scenes {

namespace {

using nlohmann::json;
using nlohmann::ordered_json;

std::string bits_of(float value) { return fmt::format("{:08x}", std::bit_cast<std::uint32_t>(value)); }
std::string bits_of(double value) { return fmt::format("{:016x}", std::bit_cast<std::uint64_t>(value)); }

// JSON has neither infinities nor NaN: the decimals contain null instead.
template <class Real>
ordered_json decimal_and_bits(std::span<const Real> values) {
    ordered_json decimals = ordered_json::array(), bits = ordered_json::array();
    for (const Real value : values) {
        if (std::isfinite(value))
            decimals.push_back(static_cast<double>(value));
        else
            decimals.push_back(nullptr);
        bits.push_back(bits_of(value));
    }
    return {{"decimal", std::move(decimals)}, {"bits", std::move(bits)}};
}

template <class Real, class Bits>
std::optional<Real> of_bits(const json& text) {
    if (!text.is_string()) return std::nullopt;
    const auto& digits = text.get_ref<const std::string&>();
    Bits bits = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), bits, 16);
    if (error != std::errc{} || end != digits.data() + digits.size() || digits.size() != 2 * sizeof bits)
        return std::nullopt;
    return std::bit_cast<Real>(bits);
}

bool says(const json& decimal, double value) {
    if (decimal.is_null()) return !std::isfinite(value);
    return decimal.is_number() && decimal.get<double>() == value &&
           std::signbit(decimal.get<double>()) == std::signbit(value);
}

// Either of the two lists suffices.
template <class Real, class Bits>
bool fill(const json& both, std::span<Real> values) {
    if (!both.is_object()) return false;
    const auto decimals = both.find("decimal"), bits = both.find("bits");
    if (decimals == both.end() && bits == both.end()) return false;
    for (const auto& list : {decimals, bits})
        if (list != both.end() && (!list->is_array() || list->size() != values.size())) return false;
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (bits != both.end()) {
            const auto value = of_bits<Real, Bits>((*bits)[i]);
            if (!value || (decimals != both.end() && !says((*decimals)[i], static_cast<double>(*value)))) return false;
            values[i] = *value;
        } else {
            if (!(*decimals)[i].is_number()) return false;
            values[i] = (*decimals)[i].get<Real>();
        }
    }
    return true;
}

}  // namespace

ordered_json JsonWriter::both(std::span<const float> values) { return decimal_and_bits(values); }
ordered_json JsonWriter::both(std::span<const double> values) { return decimal_and_bits(values); }

JsonReader::JsonReader(const json& value, const std::string& file, std::string pointer)
    : value_{value}, file_{file}, pointer_{std::move(pointer)} {
    if (!value.is_object())
        throw InputError(file, pointer_.empty() ? "/" : pointer_, "an object", json_in_words(value));
}

const json& JsonReader::at(const std::string& key) {
    const auto found = value_.find(key);
    if (found == value_.end())
        throw InputError(file_, pointer_.empty() ? "/" : pointer_, "the key '" + key + "'", "none");
    read_.insert(key);
    known_.insert(key);
    return *found;
}

bool JsonReader::has(const std::string& key) {
    known_.insert(key);
    return value_.contains(key);
}

void JsonReader::fail(const std::string& key, const std::string& expected) const {
    throw InputError(file_, pointer_ + "/" + key, expected, json_in_words(value_.at(key)));
}

void JsonReader::end() const {
    for (const auto& [key, value] : value_.items()) {
        if (read_.contains(key)) continue;
        const std::vector<std::string_view> known{known_.begin(), known_.end()};
        throw InputError(file_, pointer_.empty() ? "/" : pointer_,
                         fmt::format("only the keys {}", fmt::join(known, ", ")), quoted_with_suggestion(key, known));
    }
}

void JsonReader::flag(const std::string& key, bool& value) {
    const json& found = at(key);
    if (!found.is_boolean()) fail(key, "true or false");
    value = found.get<bool>();
}

void JsonReader::text(const std::string& key, std::string& value) {
    const json& found = at(key);
    if (!found.is_string()) fail(key, "a string");
    value = found.get<std::string>();
}

void JsonReader::text(const std::string& key, std::uint64_t& value) {
    std::string digits;
    text(key, digits);
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (error != std::errc{} || end != digits.data() + digits.size())
        fail(key, "a string with a whole number of 64 bits");
}

void JsonReader::texts(const std::string& key, std::vector<std::string>& values) {
    const json& found = at(key);
    const bool fits = found.is_array() && std::ranges::all_of(found, [](const json& v) { return v.is_string(); });
    if (!fits) fail(key, "an array of strings");
    values = found.get<std::vector<std::string>>();
}

std::int64_t JsonReader::number(const std::string& key, std::int64_t lowest, std::int64_t highest) {
    const json& found = at(key);
    const std::string expected = fmt::format("a whole number from {} to {}", lowest, highest);
    if (!found.is_number_integer() || (found.is_number_unsigned() && found.get<std::uint64_t>() > INT64_MAX))
        fail(key, expected);
    const auto value = found.get<std::int64_t>();
    if (value < lowest || value > highest) fail(key, expected);
    return value;
}

void JsonReader::reals(const std::string& key, std::span<float> values) {
    if (!fill<float, std::uint32_t>(at(key), values))
        fail(key,
             fmt::format("{} numbers, \"decimal\" and \"bits\" (8 hexadecimal digits each) that agree", values.size()));
}

void JsonReader::reals(const std::string& key, std::span<double> values) {
    if (!fill<double, std::uint64_t>(at(key), values))
        fail(key, fmt::format("{} numbers, \"decimal\" and \"bits\" (16 hexadecimal digits each) that agree",
                              values.size()));
}

std::size_t JsonReader::place_in(const std::string& key, std::span<const std::string_view> names) {
    const json& found = at(key);
    const std::string expected = fmt::format("one of {}", fmt::join(names, ", "));
    if (!found.is_string()) fail(key, expected);
    const auto& word = found.get_ref<const std::string&>();
    for (std::size_t i = 0; i < names.size(); ++i)
        if (names[i] == word) return i;
    throw InputError(file_, pointer_ + "/" + key, expected, quoted_with_suggestion(word, names));
}

const json& JsonReader::array_at(const std::string& key) {
    const json& found = at(key);
    if (!found.is_array()) fail(key, "an array");
    return found;
}

}  // namespace strata::scenes
