// tools/port/gl/npy.h - reads and writes arrays as NPY 1.0 files: little endian, C order, a header of 128 bytes.
#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "tools/port/gl/objects.h"

namespace strata::port {

// Elements in the order of the file, rows first. `type` is u1, u2, u4, i4, f2 or f4.
struct Array {
    std::string type;
    std::vector<std::size_t> shape;
    std::vector<std::uint8_t> bytes;
};

// Throws std::runtime_error, which names the file, if it is not such an array.
[[nodiscard]] Array read_npy(const std::string& file);

// The array of this file as values of T, which must correspond to `type` and have its width; `width` elements per row.
template <class T>
[[nodiscard]] std::vector<T> read_rows(const std::string& file, const std::string& type, std::size_t width);

// An image with the shape used in packs: (rows, columns), (rows, columns, channels), or of several samples (rows,
// columns, samples, channels).
void write_npy(const std::string& file, const PixelCodes& image);

}  // namespace strata::port
