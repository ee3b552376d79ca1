// tools/oracle/verdict/ties.h - what a right port may do with fragments at one depth.
//
// Source   keys-and-counts.md 2.2
// Tests    tests/tools/oracle/verdict/structure_test.cpp
#pragma once
#include <cstdint>
#include <string_view>

namespace strata::oracle::verdict {

enum class TieRule : std::uint8_t {
    first,                 // all, the first submitted in front
    last,                  // all, the last submitted in front
    unique,                // the first submitted alone
    unique_last,           // the last submitted alone
    merged,                // one layer, MAX of each channel: premultiplied in the near half, straight in the far half
    merged_premultiplied,  // the same, premultiplied in both halves
    first_then_last,       // `first` in the near half of the depths, `last` in the far half
    other                  // all, in another order: `permutation` of each depth's fragments
};
enum class DepthKey : std::uint8_t {
    code,
    shader_z
};  // what is one depth: the stored code, or binary32 as a program sees it

struct Ties {
    TieRule rule = TieRule::first;
    DepthKey key = DepthKey::code;
    std::uint32_t permutation =
        0;  // of `other`, below permutations; groups of more than `most_permuted` keep their order
    friend bool operator==(const Ties&, const Ties&) = default;
};
inline constexpr std::size_t tie_rule_count = 7, ties_count = 2 * tie_rule_count;  // `other` is none of them
inline constexpr std::uint32_t permutations = 24;
inline constexpr std::size_t most_permuted = 4;  // fragments of a group
// All, in the order of the enums: number n has bit n in a mask of them.
[[nodiscard]] Ties ties_number(std::size_t number) noexcept;
[[nodiscard]] std::string_view describe(const Ties& ties) noexcept;

}  // namespace strata::oracle::verdict
