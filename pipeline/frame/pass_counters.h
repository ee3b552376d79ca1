// pipeline/frame/pass_counters.h - the counts of the parts of a pass, each rule once: for the stages, for rows, and for
// resolves, which count passes that they do not execute.
//
// Rule     Bytes are counted as if there were no cache: a load, a test and a blend read the target's pixel for every
//          fragment that arrives, and every fragment that passes is written. `bytes` is the size of one sample of a
//          pixel; a full-screen pass has a fragment at every pixel.
// Tests    tests/peeling/execution/execution_test.cpp compares literal execution with the resolves;
//          tests/pipeline/region/region_test.cpp
#pragma once
#include "pipeline/frame/counters.h"

namespace strata::pipeline {

[[nodiscard]] constexpr Counters of_loads(std::uint64_t bytes, std::uint64_t fragments) noexcept {
    return {.bytes_read = bytes * fragments};
}
[[nodiscard]] constexpr Counters of_clear(std::uint64_t bytes, std::uint64_t pixels) noexcept {
    return {.bytes_written = bytes * pixels};
}
[[nodiscard]] constexpr Counters of_copy(std::uint64_t bytes, std::uint64_t pixels) noexcept {
    return {.bytes_read = bytes * pixels, .bytes_written = bytes * pixels};
}
// `passed` of the `arriving` fragments pass the test.
[[nodiscard]] constexpr Counters of_depth_test(std::uint64_t bytes, std::uint64_t arriving, std::uint64_t passed,
                                               bool writes) noexcept {
    return {.depth_killed = arriving - passed,
            .bytes_read = bytes * arriving,
            .bytes_written = writes ? bytes * passed : 0};
}
[[nodiscard]] constexpr Counters of_color(std::uint64_t bytes, std::uint64_t fragments, bool blends) noexcept {
    return {.bytes_read = blends ? bytes * fragments : 0, .bytes_written = bytes * fragments};
}

}  // namespace strata::pipeline
