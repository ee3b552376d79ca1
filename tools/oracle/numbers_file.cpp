// tools/oracle/numbers_file.cpp - the headers of .npy files, the names of raw layouts, and little-endian numbers.
//
// Rule     .npy: the bytes 93 "NUMPY", version (1.0 has a 16-bit length, 2.0 and 3.0 a 32-bit one), then a Python dictionary with the keys
//          descr, fortran_order and shape. One channel of f4 or u4 is a depth, one of u1 or u2 another target.
// Source   NumPy Enhancement Proposal 1.
#include "tools/oracle/numbers_file.h"

#include <fmt/format.h>

#include <charconv>

#include "rasterizer/base/input_error.h"
#include "scenes/files/text_file.h"
#include "scenes/gltf/document/place.h"

namespace strata::oracle {

namespace {

constexpr int max_side = 16384;
constexpr std::size_t max_bytes = std::size_t{1} << 32;

std::size_t size_of(Code code) noexcept {
    switch (code) {
        case Code::unorm8: return 1;
        case Code::unorm16:
        case Code::half: return 2;
        case Code::unorm24:
        case Code::single:
        case Code::integer: break;
    }
    return 4;
}

std::uint32_t little_endian(std::string_view bytes) noexcept {
    std::uint32_t word = 0;
    for (std::size_t i = bytes.size(); i-- > 0;) word = word << 8 | static_cast<unsigned char>(bytes[i]);
    return word;
}

// Fills the codes from the bytes behind the header.
void take(std::string_view bytes, const std::string& path, bool bottom_up, Target& target) {
    const std::size_t size = size_of(target.code);
    const std::size_t row = static_cast<std::size_t>(target.width) * static_cast<std::size_t>(target.channels);
    const auto rows = static_cast<std::size_t>(target.height);
    if (bytes.size() != row * rows * size)
        throw InputError(path, "size",
                         fmt::format("{} bytes for {}x{} pixels of {} channels, {} bytes each", row * rows * size,
                                     target.width, target.height, target.channels, size),
                         std::to_string(bytes.size()));
    target.codes.resize(row * rows);
    for (std::size_t y = 0; y < rows; ++y)
        for (std::size_t i = 0; i < row; ++i)
            target.codes[(bottom_up ? rows - 1 - y : y) * row + i] =
                little_endian(bytes.substr((y * row + i) * size, size));
}

// What stands behind 'key': up to one of `ends`.
std::string entry(std::string_view header, std::string_view key, std::string_view ends) {
    const std::size_t at = header.find(fmt::format("'{}':", key));
    if (at == std::string_view::npos) return "";
    const std::size_t first = header.find_first_not_of(' ', at + key.size() + 3);
    if (first == std::string_view::npos) return "";
    return std::string(header.substr(first, header.find_first_of(ends, first) - first));
}

// "(480, 640, 4" as numbers; empty for anything else.
std::vector<int> sides(std::string_view text) {
    std::vector<int> found;
    if (!text.starts_with('(')) return found;
    for (std::size_t at = 1; at < text.size();) {
        if (text[at] == ' ' || text[at] == ',') {
            ++at;
            continue;
        }
        int side = 0;
        const auto [end, error] = std::from_chars(text.data() + at, text.data() + text.size(), side);
        if (error != std::errc{}) return {};
        found.push_back(side);
        at = static_cast<std::size_t>(end - text.data());
    }
    return found;
}

Code element(const std::string& path, const std::string& described) {
    for (const auto& [text, code] :
         {std::pair{"'|u1'", Code::unorm8}, std::pair{"'<u2'", Code::unorm16}, std::pair{"'<u4'", Code::integer},
          std::pair{"'<f2'", Code::half}, std::pair{"'<f4'", Code::single}})
        if (described == text) return code;
    throw InputError(path, "descr", "elements |u1, <u2, <u4, <f2 or <f4", scenes::one_line(described));
}

}  // namespace

Target read_npy(const std::string& path) {
    const std::string file = scenes::read_text_file(path, max_bytes);
    const std::string_view bytes = file;
    if (!bytes.starts_with("\x93NUMPY") || bytes.size() < 12) throw InputError(path, "file", "a .npy file", "another");
    const std::size_t length_bytes = bytes[6] == 1 ? 2 : 4;
    const std::size_t length = little_endian(bytes.substr(8, length_bytes)), begin = 8 + length_bytes;
    if (length > bytes.size() - begin) throw InputError(path, "header", "a whole one", "an end within it");
    const std::string_view header = bytes.substr(begin, length);
    if (entry(header, "fortran_order", ",}") != "False")
        throw InputError(path, "fortran_order", "False (numpy.ascontiguousarray makes it so)", "another order");
    const std::vector<int> shape = sides(entry(header, "shape", ")"));
    const auto fits = [](int side) { return side >= 1 && side <= max_side; };
    if ((shape.size() != 2 && shape.size() != 3) || !fits(shape[0]) || !fits(shape[1]) ||
        (shape.size() == 3 && (shape[2] < 1 || shape[2] > 4)))
        throw InputError(path, "shape", "(rows, columns) or (rows, columns, channels), at most 16384 and 4",
                         scenes::one_line(entry(header, "shape", ")")) + ")");
    Target target{.code = element(path, entry(header, "descr", ",}")),
                  .width = shape[1],
                  .height = shape[0],
                  .channels = shape.size() == 3 ? shape[2] : 1};
    const bool is_wide = target.code == Code::single || target.code == Code::integer;
    target.meaning = target.channels > 1 ? Meaning::color : is_wide ? Meaning::depth : Meaning::other;
    target.name = target.channels > 1 ? "color" : is_wide ? "depth" : "value";
    take(bytes.substr(begin + length), path, false, target);
    return target;
}

Target raw_target(std::string_view bytes, const std::string& thing, const RawLayout& layout) {
    Target target{.name = layout.meaning == Meaning::depth ? "depth" : "color",
                  .meaning = layout.meaning,
                  .code = layout.code,
                  .width = layout.width,
                  .height = layout.height,
                  .channels = layout.channels};
    take(bytes, thing, layout.bottom_up, target);
    return target;
}

Target read_raw(const std::string& path, const RawLayout& layout) {
    return raw_target(scenes::read_text_file(path, max_bytes), path, layout);
}

std::optional<RawLayout> raw_layout(std::string_view text) {
    const std::size_t by = text.find('x'), colon = text.find(':');
    if (by == std::string_view::npos || colon == std::string_view::npos || by > colon) return std::nullopt;
    RawLayout layout;
    const auto side = [](std::string_view digits, int& to) {
        const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), to);
        return error == std::errc{} && end == digits.data() + digits.size() && to >= 1 && to <= max_side;
    };
    if (!side(text.substr(0, by), layout.width) || !side(text.substr(by + 1, colon - by - 1), layout.height))
        return std::nullopt;
    std::string_view format = text.substr(colon + 1);
    constexpr std::string_view turned = ":bottom-up";
    if (format.ends_with(turned)) {
        layout.bottom_up = true;
        format.remove_suffix(turned.size());
    }
    for (const auto& [name, code] :
         {std::pair{"d16", Code::unorm16}, std::pair{"d24", Code::unorm24}, std::pair{"d32f", Code::single}})
        if (format == name) {
            layout.channels = 1;
            layout.meaning = Meaning::depth;
            layout.code = code;
            return layout;
        }
    const std::size_t letters = format.find_first_not_of("rgba");
    if (letters == 0 || letters == std::string_view::npos ||
        !std::string_view{"rgba"}.starts_with(format.substr(0, letters)))
        return std::nullopt;
    layout.channels = static_cast<int>(letters);
    const std::string_view bits = format.substr(letters);
    for (const auto& [name, code] : {std::pair{"8", Code::unorm8}, std::pair{"16", Code::unorm16},
                                     std::pair{"16f", Code::half}, std::pair{"32f", Code::single}})
        if (bits == name) {
            layout.code = code;
            return layout;
        }
    return std::nullopt;
}

}  // namespace strata::oracle
