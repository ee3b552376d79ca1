// tools/strata/report/survey.h - what the page shows of each algorithm beside its picture: which pass took which
// fragment, and which test killed most at each pixel.
//
// Rule     One literal run with an observer. A fragment is known by its pixel and the number of its triangle; what a
//          pass takes by a key alone are all fragments of that key there (dual peeling merges them).
// Tests    tests/tools/report_test.cpp holds them against `strata explain`
#pragma once
#include <cstdint>
#include <vector>

#include "peeling/render.h"
#include "tools/oracle/passes.h"

namespace strata::tools {

// Fragments pixel by pixel, near to far; of equal depth in the order of submission.
struct Columns {
    std::vector<std::uint32_t> first{};  // of each pixel, and the number of all at the end
    std::vector<pipeline::CapturedFragment> fragments{};
    std::vector<std::uint32_t> arrival{};  // of each fragment, within its pixel
};
[[nodiscard]] Columns columns_of(std::vector<pipeline::CapturedFragment> fragments, std::size_t pixels);

struct Survey {
    // Of each fragment of the columns: 0 never composited; else 1 + the pass, with the highest bit set for the far end.
    std::vector<std::uint16_t> taken{};
    std::vector<std::uint8_t> killer{};  // of each pixel: the Fate of most fragments that a pass rejected; 0: none
    bool has_taken = false;              // the algorithm tells what it composites
};
inline constexpr std::uint16_t far_end = 0x8000;

[[nodiscard]] Survey survey(const oracle::RunInput& input, const peeling::Algorithm& algorithm, const Columns& columns);

}  // namespace strata::tools
