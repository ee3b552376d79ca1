// tools/oracle/picture/raw_layout.cpp - raw numbers: parses the description of their layout, and reads an image from
// them.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>

#include "rasterizer/base/input_error.h"
#include "scenes/files/text_file.h"
#include "scenes/memory_limit.h"
#include "tools/oracle/picture/numbers_file.h"

namespace strata::oracle {

namespace {

constexpr std::size_t max_bytes = std::size_t{1} << 32;

struct FormatName {
    std::string_view name;
    int channels;
    Code code;
    Meaning meaning = Meaning::color;
    Packing packing = Packing::channels;
};
constexpr FormatName formats[]{{"d16", 1, Code::unorm16, Meaning::depth},
                               {"d24", 1, Code::unorm24, Meaning::depth},
                               {"x8d24", 1, Code::unorm24, Meaning::depth, Packing::low_depth},
                               {"s8d24", 1, Code::unorm24, Meaning::depth, Packing::low_depth},
                               {"d24s8", 1, Code::unorm24, Meaning::depth, Packing::high_depth},
                               {"d32f", 1, Code::single, Meaning::depth},
                               {"bgr8", 3, Code::unorm8, Meaning::color, Packing::blue_first},
                               {"bgra8", 4, Code::unorm8, Meaning::color, Packing::blue_first},
                               {"rgb10a2", 4, Code::unorm10, Meaning::color, Packing::rgb10a2},
                               {"bgr10a2", 4, Code::unorm10, Meaning::color, Packing::bgr10a2}};

// "640", from 1 to `most`.
template <class Number>
bool to_count(std::string_view digits, Number most, Number& to) {
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), to);
    return error == std::errc{} && end == digits.data() + digits.size() && to >= 1 && to <= most;
}

bool take_format(std::string_view text, RawLayout& layout) {
    for (const FormatName& format : formats)
        if (text == format.name) {
            layout.channels = format.channels;
            layout.code = format.code;
            layout.meaning = format.meaning;
            layout.packing = format.packing;
            return true;
        }
    const std::size_t letters = text.find_first_not_of("rgba");
    if (letters == 0 || letters == text.npos || !std::string_view{"rgba"}.starts_with(text.substr(0, letters)))
        return false;
    layout.channels = static_cast<int>(letters);
    for (const auto& [bits, code] : {std::pair{"8", Code::unorm8}, std::pair{"16", Code::unorm16},
                                     std::pair{"16f", Code::half}, std::pair{"32f", Code::single}})
        if (text.substr(letters) == bits) {
            layout.code = code;
            return true;
        }
    return false;
}

bool take_word(std::string_view word, RawLayout& layout) {
    if (word == "bottom-up") return !std::exchange(layout.bottom_up, true);
    if (word.starts_with("offset=")) return layout.offset == 0 && to_count(word.substr(7), max_bytes, layout.offset);
    if (word.starts_with("stride="))
        return layout.row_bytes == 0 && to_count(word.substr(7), max_bytes, layout.row_bytes) &&
               layout.row_bytes >= own_row_bytes(layout);
    return false;
}

std::uint32_t little_endian(std::string_view bytes) noexcept {
    std::uint32_t word = 0;
    for (std::size_t i = bytes.size(); i-- > 0;) word = word << 8 | static_cast<unsigned char>(bytes[i]);
    return word;
}

// Unpacks a pixel's word of 10, 10, 10 and 2 bits, lowest first. A 2-bit code k has the value of the 10-bit code 341 k.
std::array<std::uint32_t, 4> unpacked(std::uint32_t word, Packing packing) noexcept {
    const std::uint32_t low = word & 1023, high = word >> 20 & 1023;
    const bool is_red_first = packing == Packing::rgb10a2;
    return {is_red_first ? low : high, word >> 10 & 1023, is_red_first ? high : low, (word >> 30) * 341};
}

constexpr std::uint32_t greatest_depth24 = 0xffffff;

void take_row(std::string_view row, const RawLayout& layout, std::uint32_t* to) {
    const std::size_t size = bytes_of(layout.code), channels = static_cast<std::size_t>(layout.channels);
    const auto word_at = [&](std::size_t i) { return little_endian(row.substr(i * size, size)); };
    for (std::size_t x = 0; x < static_cast<std::size_t>(layout.width); ++x, to += channels) {
        switch (layout.packing) {
            case Packing::channels:
            case Packing::blue_first:
                for (std::size_t c = 0; c < channels; ++c) to[c] = word_at(x * channels + c);
                if (layout.packing == Packing::blue_first) std::swap(to[0], to[2]);
                break;
            case Packing::low_depth: to[0] = word_at(x) & greatest_depth24; break;
            case Packing::high_depth: to[0] = word_at(x) >> 8; break;
            case Packing::rgb10a2:
            case Packing::bgr10a2: {
                const auto codes = unpacked(little_endian(row.substr(4 * x, 4)), layout.packing);
                std::copy(codes.begin(), codes.end(), to);
            }
        }
    }
}

}  // namespace

std::size_t bytes_of(Code code) noexcept {
    switch (code) {
        case Code::unorm8: return 1;
        case Code::unorm10:
        case Code::unorm16:
        case Code::half: return 2;
        case Code::unorm24:
        case Code::single:
        case Code::integer: break;
    }
    return 4;
}

std::size_t own_row_bytes(const RawLayout& layout) noexcept {
    const auto width = static_cast<std::size_t>(layout.width);
    const bool is_packed = layout.packing == Packing::rgb10a2 || layout.packing == Packing::bgr10a2;
    return is_packed ? 4 * width : width * static_cast<std::size_t>(layout.channels) * bytes_of(layout.code);
}

namespace {

std::size_t row_stride(const RawLayout& layout) noexcept {
    return layout.row_bytes == 0 ? own_row_bytes(layout) : layout.row_bytes;
}

// The last row may end without its padding.
void check_size(std::size_t bytes, const std::string& thing, const RawLayout& layout) {
    const auto rows = static_cast<std::size_t>(layout.height);
    const std::size_t stride = row_stride(layout), whole = layout.offset + rows * stride;
    if (bytes != whole - stride + own_row_bytes(layout) && bytes != whole)
        throw InputError(
            thing, "size",
            fmt::format("{} bytes ({}{} rows of {} bytes)", whole,
                        layout.offset == 0 ? "" : fmt::format("offset {}, ", layout.offset), layout.height, stride),
            fmt::format("{} bytes", bytes));
}

void check_depth24(const TargetImage& target, const std::string& thing) {
    const auto beyond = std::ranges::find_if(target.codes, [](std::uint32_t code) { return code > greatest_depth24; });
    if (target.code != Code::unorm24 || beyond == target.codes.end()) return;
    const auto pixel = static_cast<std::size_t>(beyond - target.codes.begin());
    const auto width = static_cast<std::size_t>(target.width);
    throw InputError(thing, fmt::format("pixel {},{}", pixel % width, pixel / width),
                     "a depth of 24 bits with 0 in the upper byte (x8d24 or s8d24: the upper byte is something else; "
                     "d24s8: the lower one is)",
                     fmt::format("{:#010x}", *beyond));
}

}  // namespace

TargetImage raw_target(std::string_view bytes, const std::string& thing, const RawLayout& layout) {
    check_size(bytes.size(), thing, layout);
    TargetImage target{.name = layout.meaning == Meaning::depth ? "depth" : "color",
                       .meaning = layout.meaning,
                       .code = layout.code,
                       .width = layout.width,
                       .height = layout.height,
                       .channels = layout.channels};
    const auto rows = static_cast<std::size_t>(layout.height);
    const std::size_t row = own_row_bytes(layout), stride = row_stride(layout);
    const std::size_t codes = static_cast<std::size_t>(layout.width) * static_cast<std::size_t>(layout.channels);
    target.codes.resize(codes * rows);
    for (std::size_t y = 0; y < rows; ++y)
        take_row(bytes.substr(layout.offset + y * stride, row), layout,
                 &target.codes[(layout.bottom_up ? rows - 1 - y : y) * codes]);
    check_depth24(target, thing);
    return target;
}

// The size is compared first, so that no memory is allocated for a file of another size.
TargetImage read_raw(const std::string& path, const RawLayout& layout) {
    constexpr std::size_t bytes_of_lfs_pointer = 512;
    static_cast<void>(scenes::read_begin_of_file(path, bytes_of_lfs_pointer));
    check_size(scenes::size_of_file(path, max_bytes), path, layout);
    scenes::check_pixels(path, static_cast<std::uint64_t>(layout.width), static_cast<std::uint64_t>(layout.height),
                         sizeof(std::uint32_t) * static_cast<std::uint64_t>(layout.channels));
    return raw_target(scenes::read_text_file(path, max_bytes), path, layout);
}

std::optional<RawLayout> raw_layout(std::string_view text) {
    RawLayout layout;
    const auto next = [&text] {
        const std::size_t colon = std::min(text.find(':'), text.size());
        const std::string_view word = text.substr(0, colon);
        text.remove_prefix(std::min(colon + 1, text.size()));
        return word;
    };
    const std::string_view size = next();
    const std::size_t by = size.find('x');
    if (by == size.npos || !to_count(size.substr(0, by), max_side, layout.width) ||
        !to_count(size.substr(by + 1), max_side, layout.height) || !take_format(next(), layout))
        return std::nullopt;
    while (!text.empty())
        if (!take_word(next(), layout)) return std::nullopt;
    return layout;
}

}  // namespace strata::oracle
