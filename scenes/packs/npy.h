// scenes/packs/npy.h - reads and writes NumPy's array files.
//
// Rule     NPY 1.0, C order, little endian; the header is padded to 128 bytes, where the array begins in every file
//          that is written. Versions 1 to 3 with any header length are read.
// Source   NumPy Enhancement Proposal 1.
// Tests    tests/scenes/packs/npy_test.cpp
#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace strata::scenes {

enum class Element : std::uint8_t { u1, u2, u4, i4, f2, f4 };

// "u1" and so on, as in manifests.
[[nodiscard]] std::string_view name(Element element) noexcept;
[[nodiscard]] std::size_t bytes_of(Element element) noexcept;

struct NumberArray {
    Element element = Element::u1;
    std::vector<std::size_t> shape{};
    std::string bytes{};  // as in the file

    // The product of the shape.
    [[nodiscard]] std::size_t count() const noexcept;
    // Element number i, its bits zero-extended.
    [[nodiscard]] std::uint32_t word(std::size_t i) const noexcept;
    // Appends the low bytes of a word.
    void append(std::uint32_t word);
    friend bool operator==(const NumberArray&, const NumberArray&) = default;
};

inline constexpr std::size_t npy_header_bytes = 128;
// The whole file. At most 4 dimensions.
[[nodiscard]] std::string to_npy(const NumberArray& array);

// `file` is the name for errors. InputError for other files, other element types and a wrong size.
[[nodiscard]] NumberArray parse_npy(std::string_view bytes, const std::string& file);
[[nodiscard]] NumberArray read_npy(const std::string& path);

}  // namespace strata::scenes
