// tools/oracle/rounding/remembered.h - a function of a float whose last values are kept.
//
// Rule     Every hypothesis asks the same colours, and the power of sRGB costs more than all else. Only equal bits have
//          the value of before, so that nothing but the time depends on what is kept.
#pragma once
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace strata::oracle::verdict {

template <auto function>
float remembered(float v) {
    struct Known {
        std::uint32_t bits = 0;
        float value = function(0);
    };
    constexpr int bits_of_place = 13;
    thread_local std::vector<Known> known(std::size_t{1} << bits_of_place);
    const auto bits = std::bit_cast<std::uint32_t>(v);
    Known& at = known[bits * 2654435761u >> (32 - bits_of_place)];
    if (at.bits != bits) at = {bits, function(v)};
    return at.value;
}

}  // namespace strata::oracle::verdict
