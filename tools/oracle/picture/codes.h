// tools/oracle/picture/codes.h - channel types of images from any program: the value of a code, and the distance
// between two codes.
//
// Rule     Two codes are equal if their values are: integers of one type by their bits, integers of two types as exact
//          quotients. A float equals an integer's value if it is that value rounded to the float type, and that type
//          has enough bits to distinguish all values of the integer type (half: 8 and 10 bits; binary32: 8, 10, 16 and
//          24). A NaN equals no other bits. The distance counts codes of the reference's type between two values (of
//          floats: units in the last place), at least 1 where they differ.
// Numbers  k / (2^n - 1) for n up to 24 is one division in binary64, which is finer than all codes here.
// Tests    tests/tools/oracle/picture/codes_test.cpp
#pragma once
#include <cstdint>
#include <string_view>

namespace strata::oracle {

enum class Code : std::uint8_t { unorm8, unorm10, unorm16, unorm24, half, single, integer };

// "unorm8", as in reports.
[[nodiscard]] std::string_view name(Code code) noexcept;
// The value of a code: an integer itself for plain integers, k / (2^n - 1) for normalised ones, the float for floats.
[[nodiscard]] double value(Code code, std::uint32_t word) noexcept;
// The code nearest to `v`, halves to even for floats and up for integers; integers are clamped to their range.
[[nodiscard]] std::uint32_t nearest(Code code, double v) noexcept;

struct StoredCode {
    Code code = Code::unorm8;
    std::uint32_t word = 0;
};

[[nodiscard]] bool is_equal(StoredCode reference, StoredCode candidate) noexcept;
// 0 exactly if they are equal; 2^32 - 1 if only one is NaN.
[[nodiscard]] std::uint32_t distance(StoredCode reference, StoredCode candidate) noexcept;

}  // namespace strata::oracle
