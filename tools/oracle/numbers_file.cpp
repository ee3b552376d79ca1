// tools/oracle/numbers_file.cpp - pictures in .npy files, the names of raw layouts, and little-endian numbers.
//
// Rule     Of .npy files, one channel of f4 or u4 is a depth, one of u1 or u2 another target.
#include "tools/oracle/numbers_file.h"

#include <fmt/format.h>

#include <charconv>

#include "rasterizer/base/input_error.h"
#include "scenes/files/text_file.h"

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

}  // namespace

Code code_of(scenes::Element element, const std::string& file) {
    switch (element) {
        case scenes::Element::u1: return Code::unorm8;
        case scenes::Element::u2: return Code::unorm16;
        case scenes::Element::u4: return Code::integer;
        case scenes::Element::f2: return Code::half;
        case scenes::Element::f4: return Code::single;
        case scenes::Element::i4: break;
    }
    throw InputError(file, "descr", "elements |u1, <u2, <u4, <f2 or <f4", "<i4");
}

Target read_npy(const std::string& path) {
    const scenes::NumberArray array = scenes::read_npy(path);
    const auto& shape = array.shape;
    const auto fits = [](std::size_t side) { return side >= 1 && side <= max_side; };
    if ((shape.size() != 2 && shape.size() != 3) || !fits(shape[0]) || !fits(shape[1]) ||
        (shape.size() == 3 && (shape[2] < 1 || shape[2] > 4)))
        throw InputError(path, "shape", "(rows, columns) or (rows, columns, channels), at most 16384 and 4",
                         fmt::format("({})", fmt::join(shape, ", ")));
    Target target{.code = code_of(array.element, path),
                  .width = static_cast<int>(shape[1]),
                  .height = static_cast<int>(shape[0]),
                  .channels = shape.size() == 3 ? static_cast<int>(shape[2]) : 1};
    const bool is_wide = target.code == Code::single || target.code == Code::integer;
    target.meaning = target.channels > 1 ? Meaning::color : is_wide ? Meaning::depth : Meaning::other;
    target.name = target.channels > 1 ? "color" : is_wide ? "depth" : "value";
    take(array.bytes, path, false, target);
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
