// tools/strata/report/survey.h - collects, for the report page, which pass of an algorithm took each fragment, and
// which test rejected most fragments at each pixel.
//
// Rule     The algorithm runs once in literal execution with an observer. A fragment is identified by its pixel and the
//          index of its triangle. A pass that selects by key alone takes all fragments of the pixel that have that key
//          (dual peeling merges them).
// Tests    tests/tools/strata/report/report_test.cpp compares the result with `strata explain`
#pragma once
#include <cstdint>
#include <vector>

#include "peeling/render.h"
#include "tools/oracle/passes/passes.h"

namespace strata::tools {

// Fragments sorted by pixel, then from near to far; fragments of equal depth are in submission order.
struct Columns {
    std::vector<std::uint32_t> first{};  // per pixel: index of its first fragment; last, the number of all fragments
    std::vector<pipeline::CapturedFragment> fragments{};
    std::vector<std::uint32_t> arrival{};  // per fragment: its rank in the submission order of its pixel
};
[[nodiscard]] Columns columns_of(std::vector<pipeline::CapturedFragment> fragments, std::size_t pixels);

struct Survey {
    // Per fragment of the columns: 0 if it was never composited, else 1 + the pass, with the highest bit set for the
    // far end.
    std::vector<std::uint16_t> taken{};
    std::vector<std::uint8_t> killer{};  // per pixel: the Fate of most rejected fragments; 0: none was rejected
    bool has_taken = false;              // false: the algorithm does not report which fragments it composites
};
inline constexpr std::uint16_t far_end = 0x8000;

[[nodiscard]] Survey survey(const peeling::FrameRequest& input, const peeling::Algorithm& algorithm,
                            const Columns& columns);

}  // namespace strata::tools
