// tools/oracle/picture/numbers_file.h - files of plain numbers: NumPy's .npy, and raw bytes with a given layout.
#pragma once
#include <string_view>

#include "scenes/packs/npy.h"
#include "tools/oracle/picture/picture.h"

namespace strata::oracle {

// The code type of elements in a file without further description; InputError names `file` for i4, which is not an
// image type.
[[nodiscard]] Code code_of(scenes::Element element, const std::string& file);

// InputError for element types that are not u1, u2, u4, f2 or f4, for big-endian or Fortran order, and for a wrong
// size.
[[nodiscard]] TargetImage read_npy(const std::string& path);
// The size of a code in a file, in bytes; and of a row without padding.
[[nodiscard]] std::size_t bytes_of(Code code) noexcept;
[[nodiscard]] std::size_t own_row_bytes(const RawLayout& layout) noexcept;
inline constexpr int max_side = 16384;  // of an image in plain numbers

// `thing` names the bytes in error messages.
[[nodiscard]] TargetImage raw_target(std::string_view bytes, const std::string& thing, const RawLayout& layout);
[[nodiscard]] TargetImage read_raw(const std::string& path, const RawLayout& layout);

}  // namespace strata::oracle
