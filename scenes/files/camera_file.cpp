// scenes/files/camera_file.cpp - reads and writes camera files. Locale and rounding mode do not affect numbers.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>

#include "rasterizer/base/float_environment.h"
#include "rasterizer/base/input_error.h"
#include "rasterizer/base/vector_arithmetic.h"
#include "scenes/camera.h"
#include "scenes/files/strict_json.h"
#include "scenes/files/text_file.h"
#include "scenes/nearest_name.h"

namespace strata::scenes {
namespace {

using nlohmann::json;

constexpr std::string_view look_at_keys[] = {"eye", "center", "up", "fovy_degrees", "near", "far"};
constexpr std::string_view matrix_keys[] = {"view", "projection"};
constexpr std::string_view all_keys[] = {"eye", "center", "up", "fovy_degrees", "near", "far", "view", "projection"};

// A value of the file, with the file name and the JSON pointer for errors.
struct JsonField {
    const std::string& file;
    std::string pointer;
    const json& value;

    [[noreturn]] void fail(const std::string& expected, const std::string& found) const {
        throw InputError(file, pointer.empty() ? "/" : pointer, expected, found);
    }
    [[noreturn]] void fail(const std::string& expected) const { fail(expected, json_in_words(value)); }
    [[nodiscard]] JsonField operator[](std::string_view key) const {
        return {file, pointer + "/" + std::string{key}, value.at(std::string{key})};
    }
    [[nodiscard]] JsonField operator[](std::size_t i) const {
        return {file, pointer + "/" + std::to_string(i), value.at(i)};
    }
};

// "-0x1.8p+1": a sign, 0x, then what std::from_chars calls hex.
std::optional<double> parse_hex_float(std::string_view text) {
    const bool negative = text.starts_with('-');
    if (negative || text.starts_with('+')) text.remove_prefix(1);
    if (!text.starts_with("0x") && !text.starts_with("0X")) return std::nullopt;
    text.remove_prefix(2);
    if (text.empty() || !std::isxdigit(static_cast<unsigned char>(text.front())))
        return std::nullopt;  // no second sign, no inf
    double magnitude = 0;
    const auto [end, error] =
        std::from_chars(text.data(), text.data() + text.size(), magnitude, std::chars_format::hex);
    if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
    return negative ? -magnitude : magnitude;
}

// Beyond 2^64 squares and products overflow binary32, below 2^-64 quotients do: no scene needs either.
constexpr double largest = 0x1p64, smallest = 0x1p-64;

// Every number of a camera file is checked here: an infinity or a NaN would spread through both matrices.
double number(const JsonField& field) {
    std::optional<double> value;
    if (field.value.is_number()) value = field.value.get<double>();
    if (field.value.is_string()) value = parse_hex_float(field.value.get_ref<const std::string&>());
    if (!value || !std::isfinite(*value))
        field.fail("a finite number, or a hexadecimal float in a string such as \"0x1.8p+1\"");
    if (std::fabs(*value) > largest) field.fail("a number from -2^64 to 2^64");
    return *value;
}

// The length is compared first, so that an element's error can name its index.
template <std::size_t count>
std::array<double, count> numbers(const JsonField& field) {
    if (!field.value.is_array() || field.value.size() != count)
        field.fail(fmt::format("an array of {} numbers", count));
    std::array<double, count> result{};
    for (std::size_t i = 0; i < count; ++i) result[i] = number(field[i]);
    return result;
}

// Requires each key in `wanted` and no other.
void check_keys(const JsonField& camera, std::span<const std::string_view> wanted) {
    for (const auto& [key, value] : camera.value.items()) {
        if (std::ranges::find(wanted, key) == wanted.end())
            camera.fail(fmt::format("only the keys {}", fmt::join(wanted, ", ")), quoted_with_suggestion(key, wanted));
    }
    for (const std::string_view key : wanted) {
        if (!camera.value.contains(key)) camera.fail(fmt::format("the key '{}'", key), "none");
    }
}

// The square of |a x b| divided by both lengths.
double squared_sine(const Vec3d& a, const Vec3d& b) noexcept {
    // Vectors of length 0 have no direction and count as parallel.
    const double aa = dot_product(a, a), bb = dot_product(b, b);
    const Vec3d c = cross_product(a, b);
    return aa > 0 && bb > 0 ? dot_product(c, c) / aa / bb : 0;
}

Vec3d vector(const JsonField& field) {
    const auto [x, y, z] = numbers<3>(field);
    return {x, y, z};
}

// Checks the conditions that the matrices need for their divisions: an angle with a tangent, near different from far
// and from 0, an eye different from its center, an up that is not along the line of sight.
LookAt parse_look_at(const JsonField& camera) {
    check_keys(camera, look_at_keys);
    const LookAt result{.eye = vector(camera["eye"]),
                        .center = vector(camera["center"]),
                        .up = vector(camera["up"]),
                        .fovy_degrees = number(camera["fovy_degrees"]),
                        .near = number(camera["near"]),
                        .far = number(camera["far"])};
    if (!(result.fovy_degrees > 0 && result.fovy_degrees < 180))
        camera["fovy_degrees"].fail("degrees between 0 and 180");
    if (result.fovy_degrees < smallest) camera["fovy_degrees"].fail("at least 2^-64 degrees");
    if (!(result.near > 0)) camera["near"].fail("a distance above 0");
    if (result.near < smallest) camera["near"].fail("a distance of at least 2^-64");
    if (!(result.near < result.far)) camera["far"].fail(fmt::format("a distance beyond near, {}", result.near));
    if (result.eye == result.center) camera["center"].fail("a point that differs from eye", "the same point");
    // The bound is 10^-12 for the sine itself: below it the cross product is rounding noise, and the image would turn
    // with its last bits.
    if (!(squared_sine(minus(result.center, result.eye), result.up) > 1e-24))
        camera["up"].fail("a direction that is not parallel to the line of sight", "a parallel or zero vector");
    return result;
}

// True if the matrix is singular, by elimination in binary64: a matrix that is singular only without its rounding
// errors passes.
bool is_singular(std::array<double, 16> rows) {
    const auto at = [&](std::size_t row, std::size_t column) -> double& { return rows[4 * row + column]; };
    for (std::size_t k = 0; k < 4; ++k) {
        std::size_t pivot = k;
        for (std::size_t row = k + 1; row < 4; ++row)
            if (std::fabs(at(row, k)) > std::fabs(at(pivot, k))) pivot = row;
        if (at(pivot, k) == 0) return true;
        for (std::size_t column = 0; column < 4; ++column) std::swap(at(k, column), at(pivot, column));
        for (std::size_t row = k + 1; row < 4; ++row) {
            const double factor = at(row, k) / at(k, k);
            for (std::size_t column = k; column < 4; ++column) at(row, column) -= factor * at(k, column);
        }
    }
    return false;
}

pipeline::Matrix matrix(const JsonField& field) {
    const auto entries = numbers<16>(field);
    if (is_singular(entries)) field.fail("a matrix that can be inverted", "a singular matrix");
    return matrix_of(entries);
}

// std::to_chars writes the shortest hexadecimal digits that give the same bits back, without 0x; the sign is put in
// front of it. A zero keeps its sign.
std::string hex_float(double value) {
    char text[32];
    const auto [end, error] = std::to_chars(std::begin(text), std::end(text), std::abs(value), std::chars_format::hex);
    return fmt::format("{}0x{}", std::signbit(value) ? "-" : "", std::string_view{text, end});
}

std::string to_json(const pipeline::Matrix& matrix) {
    std::string text;
    for (const double entry : entries_of(matrix))
        text += fmt::format("{}\"{}\"", text.empty() ? "" : ",", hex_float(entry));
    return "[" + text + "]";
}

}  // namespace

pipeline::View parse_camera(const std::string& text, const std::string& name, double aspect) {
    const FloatEnvironment environment;
    const json document = parse_strict_json(text, name, "a camera in JSON");
    const JsonField camera{name, "", document};
    if (!document.is_object()) camera.fail("an object");
    for (const auto& [key, value] : document.items()) {  // a misspelled key must not select the form
        if (std::ranges::find(all_keys, key) == std::end(all_keys))
            camera.fail(fmt::format("only the keys {}", fmt::join(all_keys, ", ")),
                        quoted_with_suggestion(key, all_keys));
    }
    // A file with either of the matrix keys is of the second form; check_keys() then requires the other and rejects
    // keys of the first form.
    if (!document.contains("view") && !document.contains("projection")) return look_at(parse_look_at(camera), aspect);
    check_keys(camera, matrix_keys);
    return {matrix(camera["view"]), matrix(camera["projection"])};
}

pipeline::View load_camera(const std::string& path, double aspect) {
    return parse_camera(read_text_file(path), path, aspect);
}

std::string to_json(const pipeline::View& view) {
    return fmt::format("{{\"view\":{},\"projection\":{}}}\n", to_json(view.view), to_json(view.projection));
}

}  // namespace strata::scenes
