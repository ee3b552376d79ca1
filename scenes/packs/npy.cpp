// scenes/packs/npy.cpp - headers and elements of NumPy's array files (npy.h).
#include "scenes/packs/npy.h"

#include <fmt/format.h>

#include <array>
#include <charconv>

#include "rasterizer/base/enum_values.h"
#include "rasterizer/base/input_error.h"
#include "scenes/files/text_file.h"
#include "scenes/gltf/document/file_location.h"

namespace strata::scenes {

namespace {

constexpr std::size_t most_bytes = std::size_t{1} << 32, most_header_bytes = std::size_t{1} << 17;
constexpr std::string_view npy_magic = "\x93NUMPY";

// The values of NumPy's `descr`, in the order of the enum.
constexpr std::array<std::string_view, 6> descriptions{"|u1", "<u2", "<u4", "<i4", "<f2", "<f4"};
static_assert(descriptions.size() == enum_values<Element>.size());

std::uint32_t little_endian(std::string_view bytes) noexcept {
    std::uint32_t word = 0;
    for (std::size_t i = bytes.size(); i-- > 0;) word = word << 8 | static_cast<unsigned char>(bytes[i]);
    return word;
}

// The text after 'key', up to one of `ends`.
std::string_view entry(std::string_view header, std::string_view key, std::string_view ends) {
    const std::size_t at = header.find(fmt::format("'{}':", key));
    if (at == std::string_view::npos) return "";
    const std::size_t first = header.find_first_not_of(' ', at + key.size() + 3);
    if (first == std::string_view::npos) return "";
    return header.substr(first, header.find_first_of(ends, first) - first);
}

Element element_of(std::string_view header, const std::string& file) {
    const std::string_view found = entry(header, "descr", ",}");
    for (std::size_t i = 0; i < descriptions.size(); ++i)
        if (found.size() == 5 && found.substr(1, 3) == descriptions[i]) return static_cast<Element>(i);
    throw InputError(file, "descr", "elements |u1, <u2, <u4, <i4, <f2 or <f4", one_line(std::string{found}));
}

// Parses a shape such as "(480, 640, 4".
std::vector<std::size_t> shape_of(std::string_view header, const std::string& file) {
    const std::string_view text = entry(header, "shape", ")");
    const auto fail = [&] {
        throw InputError(file, "shape", "up to 4 sides in parentheses, below 2^32 elements in all",
                         one_line(std::string{text}) + ")");
    };
    std::vector<std::size_t> shape;
    if (!text.starts_with('(')) fail();
    std::size_t count = 1;
    for (std::size_t at = 1; at < text.size();) {
        if (text[at] == ' ' || text[at] == ',') {
            ++at;
            continue;
        }
        std::uint32_t side = 0;
        const auto [end, error] = std::from_chars(text.data() + at, text.data() + text.size(), side);
        if (error != std::errc{} || shape.size() == 4) fail();
        shape.push_back(side);
        if (side != 0 && count > most_bytes / side) fail();
        count *= side;
        at = static_cast<std::size_t>(end - text.data());
    }
    return shape;
}

// The header's content, and the offset of the numbers.
struct Header {
    NumberArray array{};
    std::size_t bytes = 0;
};

// `begin` is the beginning of the file, at least its header; `size` is that of the whole file.
Header header_of(std::string_view begin, std::size_t size, const std::string& file) {
    if (!begin.starts_with(npy_magic) || begin.size() < 12)
        throw InputError(file, "byte 0", "the header of a .npy file", "other bytes");
    const std::size_t length_bytes = begin[6] == 1 ? 2 : 4, before = 8 + length_bytes;
    const std::size_t length = little_endian(begin.substr(8, length_bytes));
    if (length > begin.size() - before)
        throw InputError(file, "header", fmt::format("{} bytes", length),
                         fmt::format("{} bytes before the end of the file", begin.size() - before));
    const std::string_view text = begin.substr(before, length);
    if (entry(text, "fortran_order", ",}") != "False")
        throw InputError(file, "fortran_order", "False (numpy.ascontiguousarray makes such an array)",
                         one_line(std::string{entry(text, "fortran_order", ",}")}));
    Header header{{.element = element_of(text, file), .shape = shape_of(text, file)}, before + length};
    const std::size_t count = header.array.count(), of_each = bytes_of(header.array.element);
    if (size - header.bytes != count * of_each)
        throw InputError(file, "size",
                         fmt::format("{} bytes for {} elements of {} bytes each", count * of_each, count, of_each),
                         std::to_string(size - header.bytes));
    return header;
}

}  // namespace

std::string_view name(Element element) noexcept { return enum_name(element); }

std::size_t bytes_of(Element element) noexcept {
    switch (element) {
        case Element::u1: return 1;
        case Element::u2:
        case Element::f2: return 2;
        case Element::u4:
        case Element::i4:
        case Element::f4: break;
    }
    return 4;
}

std::size_t NumberArray::count() const noexcept {
    std::size_t product = 1;
    for (const std::size_t side : shape) product *= side;
    return product;
}

std::uint32_t NumberArray::word(std::size_t i) const noexcept {
    const std::size_t size = bytes_of(element);
    return little_endian(std::string_view{bytes}.substr(i * size, size));
}

void NumberArray::append(std::uint32_t word) {
    for (std::size_t i = 0; i < bytes_of(element); ++i) bytes += static_cast<char>(word >> (8 * i) & 0xff);
}

std::string to_npy(const NumberArray& array) {
    std::string sides;
    for (const std::size_t side : array.shape) sides += fmt::format("{}, ", side);
    if (array.shape.size() > 1) sides.resize(sides.size() - 2);  // a tuple of one element keeps its comma
    if (array.shape.size() == 1) sides.resize(sides.size() - 1);
    std::string header = fmt::format("{{'descr': '{}', 'fortran_order': False, 'shape': ({}), }}",
                                     descriptions[static_cast<std::size_t>(array.element)], sides);
    constexpr std::size_t text_bytes = npy_header_bytes - 10;
    header.resize(text_bytes - 1, ' ');
    header += '\n';
    std::string file{npy_magic};
    file += {1, 0, static_cast<char>(text_bytes), 0};
    return file + header + array.bytes;
}

NumberArray parse_npy(std::string_view bytes, const std::string& file) {
    Header header = header_of(bytes, bytes.size(), file);
    header.array.bytes = bytes.substr(header.bytes);
    return std::move(header.array);
}

// Reads the header first: no memory is allocated for a file that is too short or too long.
NumberArray read_npy(const std::string& path) {
    const std::size_t size = size_of_file(path, most_bytes);
    static_cast<void>(header_of(read_begin_of_file(path, most_header_bytes), size, path));
    return parse_npy(read_text_file(path, most_bytes), path);
}

}  // namespace strata::scenes
