#include "scenes/models/model_counts.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <optional>
#include <sstream>
#include <utility>
#include <vector>

#include "rasterizer/base/input_error.h"

namespace strata::scenes::models {
namespace {

struct PlyProperty {
    std::size_t bytes = 0, count_bytes = 0;  // in a binary file; `count_bytes` is 0 unless the property is a list
};
struct PlyElement {
    std::string name;
    std::uint64_t count = 0;
    std::vector<PlyProperty> properties;
};
enum class Encoding : std::uint8_t { text, little_endian, big_endian };

struct PlyHeader {
    std::vector<PlyElement> elements;
    Encoding encoding = Encoding::text;
    std::size_t end = 0;  // the first byte behind it
};

std::size_t bytes_of_type(const std::string& type) {
    constexpr std::array<std::pair<std::string_view, std::size_t>, 16> types{{{"char", 1},
                                                                              {"int8", 1},
                                                                              {"uchar", 1},
                                                                              {"uint8", 1},
                                                                              {"short", 2},
                                                                              {"int16", 2},
                                                                              {"ushort", 2},
                                                                              {"uint16", 2},
                                                                              {"int", 4},
                                                                              {"int32", 4},
                                                                              {"uint", 4},
                                                                              {"uint32", 4},
                                                                              {"float", 4},
                                                                              {"float32", 4},
                                                                              {"double", 8},
                                                                              {"float64", 8}}};
    for (const auto& [name, bytes] : types)
        if (name == type) return bytes;
    return 0;
}

std::optional<std::uint64_t> whole_number(std::string_view text) {
    std::uint64_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc{} && end == text.data() + text.size() ? std::optional(value) : std::nullopt;
}

// A count of a header.
std::uint64_t claimed(const std::string& text, std::string_view file, const std::string& path, const std::string& at) {
    const auto count = whole_number(text);
    if (!count || *count > file.size())
        throw InputError(path, at, "a count of at most " + std::to_string(file.size()) + ", the file's bytes",
                         text.empty() ? "none" : "'" + text + "'");
    return *count;
}

// What the header says; unknown lines are left to the loader.
PlyHeader header_of(std::string_view file, const std::string& path) {
    PlyHeader header;
    for (int line = 1; header.end < file.size(); ++line) {
        const std::size_t stop = std::min(file.find('\n', header.end), file.size());
        std::istringstream words{std::string{file.substr(header.end, stop - header.end)}};
        header.end = std::min(stop + 1, file.size());
        std::string first, second, third;
        words >> first >> second >> third;
        if (first == "end_header") return header;
        if (first == "format")
            header.encoding = second == "binary_little_endian" ? Encoding::little_endian
                              : second == "binary_big_endian"  ? Encoding::big_endian
                                                               : Encoding::text;
        if (first == "element") {
            header.elements.push_back({second, claimed(third, file, path, "line " + std::to_string(line)), {}});
        }
        if (first == "property" && !header.elements.empty()) {
            std::string item;
            if (second == "list") words >> item;
            header.elements.back().properties.push_back(second == "list"
                                                            ? PlyProperty{bytes_of_type(item), bytes_of_type(third)}
                                                            : PlyProperty{bytes_of_type(second), 0});
        }
    }
    // Assimp would search for it without an end.
    throw InputError(path, "header", "a line end_header", "the end of the file");
}

// Reads the values behind a header, one after the other; each call is false if the file ends before.
class Values {
  public:
    Values(std::string_view bytes, Encoding encoding) : bytes_{bytes}, encoding_{encoding} {}

    bool skip(std::uint64_t count, std::size_t bytes_each) {
        if (encoding_ != Encoding::text) {
            if (bytes_each != 0 && count > bytes_.size() / bytes_each) return false;
            bytes_.remove_prefix(count * bytes_each);
            return true;
        }
        for (; count > 0; --count)
            if (word().empty()) return false;
        return true;
    }
    std::optional<std::uint64_t> count(std::size_t bytes) {
        if (encoding_ == Encoding::text) return whole_number(word());
        if (bytes == 0 || bytes > bytes_.size()) return std::nullopt;
        std::uint64_t value = 0;
        for (std::size_t i = 0; i < bytes; ++i) {
            const std::size_t at = encoding_ == Encoding::big_endian ? i : bytes - 1 - i;
            value = value << 8 | static_cast<unsigned char>(bytes_[at]);
        }
        bytes_.remove_prefix(bytes);
        return value;
    }

  private:
    std::string_view word() {
        constexpr std::string_view blanks = " \t\r\n";
        bytes_.remove_prefix(std::min(bytes_.find_first_not_of(blanks), bytes_.size()));
        const std::string_view found = bytes_.substr(0, bytes_.find_first_of(blanks));
        bytes_.remove_prefix(found.size());
        return found;
    }

    std::string_view bytes_;
    Encoding encoding_;
};

bool has_element(Values& values, const PlyElement& element) {
    for (const PlyProperty& property : element.properties) {
        std::uint64_t count = 1;
        if (property.count_bytes != 0) {
            const auto items = values.count(property.count_bytes);
            if (!items) return false;
            count = *items;
        }
        if (!values.skip(count, property.bytes)) return false;
    }
    return true;
}

}  // namespace

std::uint64_t check_ply_counts(std::string_view file, const std::string& path) {
    const PlyHeader header = header_of(file, path);
    Values values{file.substr(header.end), header.encoding};
    for (const PlyElement& element : header.elements) {
        const bool is_empty = element.properties.empty();  // elements without properties take no bytes
        for (std::uint64_t i = 0; i < element.count && !is_empty; ++i)
            if (!has_element(values, element))
                throw InputError(path, "element " + element.name, std::to_string(element.count) + " elements",
                                 "the values of " + std::to_string(i));
    }
    const auto edges = std::ranges::find(header.elements, "edge", &PlyElement::name);
    return edges == header.elements.end() ? 0 : edges->count;
}

namespace {

// The words of an OFF file's lines, without comments and empty lines.
class OffLines {
  public:
    explicit OffLines(std::string_view file) : rest_{file} {}

    // Empty at the end of the file.
    std::vector<std::string_view> next() {
        std::vector<std::string_view> words;
        while (words.empty() && !rest_.empty()) {
            const std::size_t stop = std::min(rest_.find('\n'), rest_.size());
            std::string_view line = rest_.substr(0, stop);
            rest_.remove_prefix(std::min(stop + 1, rest_.size()));
            ++number_;
            line = line.substr(0, line.find('#'));
            constexpr std::string_view blanks = " \t\r";
            while (line.find_first_not_of(blanks) != line.npos) {
                line.remove_prefix(line.find_first_not_of(blanks));
                words.push_back(line.substr(0, line.find_first_of(blanks)));
                line.remove_prefix(words.back().size());
            }
        }
        return words;
    }
    [[nodiscard]] std::string place() const { return "line " + std::to_string(number_); }

  private:
    std::string_view rest_;
    int number_ = 0;
};

}  // namespace

// The counts of vertices and faces are the first two numbers; only words stand before, and comments between. Vertices
// and faces have a line each, as Assimp reads them.
void check_off_counts(std::string_view file, const std::string& path) {
    OffLines lines{file};
    std::array<std::uint64_t, 2> counts{};
    std::size_t found = 0;
    while (found < 2) {
        const std::vector<std::string_view> words = lines.next();
        if (words.empty()) throw InputError(path, "header", "the numbers of vertices and faces", "the end of the file");
        for (const std::string_view word : words)
            if (found < 2 && (found > 0 || std::string_view{"-0123456789"}.find(word.front()) != word.npos)) {
                counts[found] = claimed(std::string{word}, file, path, found == 0 ? "vertices" : "faces");
                ++found;
            }
    }
    for (std::uint64_t i = 0; i < counts[0]; ++i)
        if (lines.next().empty())
            throw InputError(path, "vertices", std::to_string(counts[0]) + " lines", std::to_string(i));
    for (std::uint64_t i = 0; i < counts[1]; ++i) {
        const std::vector<std::string_view> words = lines.next();
        if (words.empty()) throw InputError(path, "faces", std::to_string(counts[1]) + " lines", std::to_string(i));
        const auto corners = whole_number(words[0]);
        if (!corners || *corners == 0 || *corners >= words.size())
            throw InputError(path, lines.place(), "the number of a face's corners and their vertices",
                             "'" + std::string{words[0]} + "' and " + std::to_string(words.size() - 1) + " numbers");
        for (std::size_t c = 1; c <= *corners; ++c) {
            const auto vertex = whole_number(words[c]);
            if (!vertex || *vertex >= counts[0])
                throw InputError(path, lines.place(), "the number of a vertex below " + std::to_string(counts[0]),
                                 "'" + std::string{words[c]} + "'");
        }
    }
}

}  // namespace strata::scenes::models
