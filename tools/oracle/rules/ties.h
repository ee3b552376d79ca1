// tools/oracle/rules/ties.h - the correct ways to composite fragments of equal depth.
//
// Source   peeling/reference/keys-and-counts.md 2.2
// Tests    tests/tools/oracle/rules/structure_test.cpp
#pragma once
#include <cstdint>
#include <string_view>

namespace strata::oracle::verdict {

enum class TieHandling : std::uint8_t {
    first,                 // all, with the first submitted in front
    last,                  // all, with the last submitted in front
    unique,                // only the first submitted
    unique_last,           // only the last submitted
    merged,                // one layer, MAX of each channel: premultiplied in the near half, straight in the far half
    merged_premultiplied,  // the same, premultiplied in both halves
    first_then_last,       // `first` in the near half of the depths, `last` in the far half
    other                  // all, in another order: `permutation` of the fragments of each depth
};
enum class ComparedDepth : std::uint8_t {
    code,
    shader_z
};  // the depth that is compared: the stored code, or binary32 as in a program

struct Ties {
    TieHandling rule = TieHandling::first;
    ComparedDepth key = ComparedDepth::code;
    std::uint32_t permutation =
        0;  // of `other`, less than `permutations`; groups of more than `most_permuted` keep their order
    friend bool operator==(const Ties&, const Ties&) = default;
};
inline constexpr std::size_t tie_rule_count = 7, ties_count = 2 * tie_rule_count;  // not counting `other`
inline constexpr std::uint32_t permutations = 24;
inline constexpr std::size_t most_permuted = 4;  // fragments of a group
// The rules in the order of the enums. Rule n is bit n of a mask.
[[nodiscard]] Ties ties_number(std::size_t number) noexcept;
[[nodiscard]] std::string_view describe(const Ties& ties) noexcept;

}  // namespace strata::oracle::verdict
