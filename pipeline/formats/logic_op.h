// pipeline/formats/logic_op.h - the sixteen logical operations between a fragment's code and the stored one.
//
// Rule     Bit by bit, on the codes of fixed-point channels: s is the source after blending is skipped and after
//          dithering, d the stored code.
// Source   pipeline/reference/fragment-stages.md 8.6 (GL 4.6 core 17.3.9, table 17.3).
// Tests    tests/pipeline/stages/logic_op_test.cpp
#pragma once
#include <cstdint>

namespace strata::pipeline {

enum class LogicOp : std::uint8_t {
    clear,
    and_both,
    and_reverse,
    copy,
    and_inverted,
    noop,
    xor_both,
    or_both,
    nor,
    equiv,
    invert,
    or_reverse,
    copy_inverted,
    or_inverted,
    nand,
    set
};

// Bits beyond `mask` are 0.
[[nodiscard]] constexpr std::uint32_t combined(LogicOp op, std::uint32_t s, std::uint32_t d,
                                               std::uint32_t mask) noexcept {
    using enum LogicOp;
    switch (op) {
        case clear: return 0;
        case and_both: return s & d & mask;
        case and_reverse: return s & ~d & mask;
        case copy: return s & mask;
        case and_inverted: return ~s & d & mask;
        case noop: return d & mask;
        case xor_both: return (s ^ d) & mask;
        case or_both: return (s | d) & mask;
        case nor: return ~(s | d) & mask;
        case equiv: return ~(s ^ d) & mask;
        case invert: return ~d & mask;
        case or_reverse: return (s | ~d) & mask;
        case copy_inverted: return ~s & mask;
        case or_inverted: return (~s | d) & mask;
        case nand: return ~(s & d) & mask;
        case set: break;
    }
    return mask;
}

[[nodiscard]] constexpr bool reads_stored(LogicOp op) noexcept {
    return op != LogicOp::clear && op != LogicOp::copy && op != LogicOp::copy_inverted && op != LogicOp::set;
}

}  // namespace strata::pipeline
