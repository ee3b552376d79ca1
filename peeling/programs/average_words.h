// peeling/programs/average_words.h - the resolve of weighted_average where its targets lie as words: halves in, 8-bit
// colour out. It runs by default in place of the full-screen program of peeling/algorithms/weighted_average.cpp, on
// sets that convert halves.
//
// Rule     What loading, resolve_average (average.h) and writing without blending leave, pixel by pixel.
// Tests    tests/peeling/execution_test.cpp: against literal execution
#pragma once
#include <cstdint>

#include "pipeline/region/region_shortcuts.h"

namespace strata::peeling {

struct StuckPixels {
    std::uint64_t pixels = 0;
    std::uint32_t first = ~0u;
};

// `words`: of sums (fp16), count (fp16) and background (8 bits), and of the 8-bit colour that is written. Only where
// resolves_words.
StuckPixels resolve_average_words(const pipeline::ScreenWords& words) noexcept;
[[nodiscard]] bool resolves_words() noexcept;  // on the chosen instruction set

}  // namespace strata::peeling
