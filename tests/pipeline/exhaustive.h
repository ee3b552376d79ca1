// tests/pipeline/exhaustive.h - checks a rule for all 2^32 float bit patterns, on all cores.
#pragma once
#include <atomic>
#include <cstdint>

#include "rasterizer/base/parallel.h"

namespace strata::pipeline {

struct Exhausted {
    std::uint64_t wrong = 0;
    std::uint32_t first = 0;  // the smallest wrong bit pattern
};

template <class Rule>
[[nodiscard]] Exhausted over_all_floats(Rule&& holds) {
    constexpr std::uint64_t chunk = 1u << 22;
    std::atomic<std::uint64_t> wrong{0}, first{~std::uint64_t{0}};
    parallel_for((std::uint64_t{1} << 32) / chunk, 0, [&](std::size_t part) {
        for (std::uint64_t bits = part * chunk; bits < (part + 1) * chunk; ++bits) {
            if (holds(static_cast<std::uint32_t>(bits))) continue;
            ++wrong;
            std::uint64_t earlier = first;
            while (bits < earlier && !first.compare_exchange_weak(earlier, bits)) {
            }
        }
    });
    return {wrong, static_cast<std::uint32_t>(first)};
}

}  // namespace strata::pipeline
