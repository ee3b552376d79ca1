#include "tools/port/gl/npy.h"

#include <fmt/format.h>

#include <cstring>
#include <fstream>
#include <stdexcept>

namespace strata::port {

namespace {

constexpr std::size_t header_size = 128;
constexpr std::size_t words_at = 10;  // after the magic text, the version and the length of the header

[[noreturn]] void refuse(const std::string& file, const std::string& expected, const std::string& found) {
    throw std::runtime_error(fmt::format("{}: expected {}, found {}", file, expected, found));
}

// The text between `before` and `after` in the header.
std::string between(const std::string& text, const std::string& before, char after) {
    const std::size_t start = text.find(before);
    if (start == std::string::npos) return {};
    const std::size_t from = start + before.size(), to = text.find(after, from);
    return to == std::string::npos ? std::string{} : text.substr(from, to - from);
}

std::vector<std::size_t> numbers(const std::string& text) {
    std::vector<std::size_t> found;
    for (std::size_t i = 0; i < text.size();) {
        std::size_t length = 0;
        while (i + length < text.size() && text[i + length] >= '0' && text[i + length] <= '9') ++length;
        if (length > 0) found.push_back(std::stoul(text.substr(i, length)));
        i += length + 1;
    }
    return found;
}

const char* type_of(const PixelFormat& format) {
    const bool is_float =
        format.type == GL_FLOAT || format.type == GL_HALF_FLOAT || format.type == GL_UNSIGNED_INT_10F_11F_11F_REV;
    if (format.bytes == 1) return "|u1";
    if (format.bytes == 2) return is_float ? "<f2" : "<u2";
    return is_float ? "<f4" : "<u4";
}

}  // namespace

Array read_npy(const std::string& file) {
    std::ifstream stream(file, std::ios::binary);
    std::string header(header_size, '\0');
    if (!stream.read(header.data(), header_size)) refuse(file, "an NPY file", "none, or a shorter one");
    if (!header.starts_with(std::string("\x93NUMPY\x01\x00", 8))) refuse(file, "NPY 1.0", "another beginning");
    if (header.find("'fortran_order': False") == std::string::npos) refuse(file, "C order", "Fortran's");
    Array array;
    array.type = between(header.substr(words_at), "'descr': '", '\'');
    if (array.type.size() != 3) refuse(file, "a type such as <f4", "'" + array.type + "'");
    array.type = array.type.substr(1);
    array.shape = numbers(between(header, "'shape': (", ')'));
    std::size_t size = static_cast<std::size_t>(array.type[1] - '0');
    for (const std::size_t extent : array.shape) size *= extent;
    array.bytes.resize(size);
    if (!stream.read(reinterpret_cast<char*>(array.bytes.data()), static_cast<std::streamsize>(size)))
        refuse(file, fmt::format("{} bytes behind the header", size), "fewer");
    return array;
}

template <class T>
std::vector<T> read_rows(const std::string& file, const std::string& type, std::size_t width) {
    const Array array = read_npy(file);
    const bool fits = array.type == type && !array.shape.empty() && array.shape.size() == (width == 1 ? 1 : 2) &&
                      (width == 1 || array.shape[1] == width);
    if (!fits) refuse(file, fmt::format("rows of {} {}", width, type), fmt::format("another shape of {}", array.type));
    std::vector<T> values(array.bytes.size() / sizeof(T));
    std::memcpy(values.data(), array.bytes.data(), array.bytes.size());
    return values;
}
template std::vector<float> read_rows(const std::string&, const std::string&, std::size_t);
template std::vector<std::uint8_t> read_rows(const std::string&, const std::string&, std::size_t);
template std::vector<std::uint32_t> read_rows(const std::string&, const std::string&, std::size_t);

void write_npy(const std::string& file, const PixelCodes& image) {
    const std::string samples = image.samples > 1 ? fmt::format(", {}", image.samples) : "";
    const std::string channels =
        image.samples > 1 || image.format.channels > 1 ? fmt::format(", {}", image.format.channels) : "";
    std::string header("\x93NUMPY\x01\x00\x76\x00", words_at);  // 118 bytes of header text follow
    header += fmt::format("{{'descr': '{}', 'fortran_order': False, 'shape': ({}, {}{}{}), }}", type_of(image.format),
                          image.size.height, image.size.width, samples, channels);
    header.resize(header_size - 1, ' ');
    header += '\n';
    std::ofstream stream(file, std::ios::binary);
    stream << header;
    stream.write(reinterpret_cast<const char*>(image.bytes.data()), static_cast<std::streamsize>(image.bytes.size()));
    if (!stream.flush()) throw std::runtime_error(file + ": expected a file that can be written, found none");
}

}  // namespace strata::port
