// pipeline/frame/verdict.h - what a frame-wide query count means: go on, or stop. execution.md 4.1.
#pragma once
#include <cstdint>

#include "pipeline/frame/frame.h"

namespace strata::pipeline {

// exact, paper, any: something was left. ratio: at least ratio x width x height were left. fixed asks nothing.
[[nodiscard]] inline bool continues(const Termination& termination, const rasterizer::Rect& frame,
                                    std::uint64_t count) {
    if (termination.rule != TerminationRule::ratio) return count > 0;
    const double limit = (termination.ratio * frame.width()) * frame.height();
    return count > 0 && static_cast<double>(count) >= limit;
}

}  // namespace strata::pipeline
