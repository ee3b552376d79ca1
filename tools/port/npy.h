// tools/port/npy.h - arrays as NPY 1.0 files: little endian, C order, a header of 128 bytes.
#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "tools/port/objects.h"

namespace strata::port {

// Elements as they lie in the file, rows first. `type` is u1, u2, u4, i4, f2 or f4.
struct Array {
    std::string type;
    std::vector<std::size_t> shape;
    std::vector<std::uint8_t> bytes;
};

// Throws std::runtime_error, naming the file, for what is no such array.
[[nodiscard]] Array read_npy(const std::string& file);

// The array of this file as values of T, which must be as wide as its elements and stand for `type`; `width` elements a
// row.
template <class T>
[[nodiscard]] std::vector<T> read_rows(const std::string& file, const std::string& type, std::size_t width);

// A picture as packs name its shape: (rows, columns) or (rows, columns, channels).
void write_npy(const std::string& file, const Image& image);

}  // namespace strata::port
