// pipeline/frame/termination.h - decides from a frame-wide query count whether a loop continues
// (pipeline/reference/execution.md 4.1).
#pragma once
#include <cstdint>

#include "pipeline/frame/frame.h"

namespace strata::pipeline {

// exact, paper, any: continue if the count is not 0. ratio: continue if it is at least ratio x width x height, times
// the samples whose fragments the query counts. fixed makes no queries.
[[nodiscard]] inline bool continues(const Termination& termination, const rasterizer::Rect& frame, std::uint64_t count,
                                    int samples) {
    if (termination.rule != TerminationRule::ratio) return count > 0;
    const double limit = (termination.ratio * frame.width()) * frame.height() * samples;
    return count > 0 && static_cast<double>(count) >= limit;
}

}  // namespace strata::pipeline
