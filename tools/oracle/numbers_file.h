// tools/oracle/numbers_file.h - files of bare numbers: NumPy's .npy, and bytes with a stated layout.
#pragma once
#include <string_view>

#include "tools/oracle/picture.h"

namespace strata::oracle {

// InputError for element types that are not u1, u2, u4, f2 or f4, for big-endian or Fortran order, and for a wrong size.
[[nodiscard]] Target read_npy(const std::string& path);
// `thing` names the bytes in errors.
[[nodiscard]] Target raw_target(std::string_view bytes, const std::string& thing, const RawLayout& layout);
[[nodiscard]] Target read_raw(const std::string& path, const RawLayout& layout);

}  // namespace strata::oracle
