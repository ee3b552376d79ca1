// peeling/audit/audit.h - a finished frame against the exact A-buffer of the same fragments: what the algorithm did, and what it lost.
//
// Rule     For every pixel the sequence that the algorithm composited (its trace) is compared with the visible fragments in
//          the order of its own tie policy; the picture is compared with all fragments composited in binary64, sorted by the
//          exact depth.
// Source   audit.md 1 to 5.
// Tests    tests/peeling/audit/audit_test.cpp
#pragma once
#include <cstdint>
#include <optional>

#include "peeling/algorithms/algorithm.h"
#include "pipeline/region/executor.h"

namespace strata::peeling {

// Pixels that have something, and the first of them in row-major order; (-1, -1) if there is none.
struct PixelCount {
    std::uint64_t pixels = 0;
    int first_x = -1, first_y = -1;
    friend bool operator==(const PixelCount&, const PixelCount&) = default;
};

struct AuditResult {
    int layers_max = 0;     // N: distinct visible keys of the deepest pixel
    int fragments_max = 0;  // M: visible fragments of the deepest pixel
    std::optional<std::uint64_t>
        order_errors;                // places where the sequences differ; empty for an algorithm without an order
    std::uint64_t lost_by_ties = 0;  // visible fragments that the tie policy does not keep
    PixelCount ties, misordered;     // pixels with equal keys; pixels with order errors
    double max_difference = 0;       // in 1/255, over r, g and b
    double max_difference_without_ties = 0;  // the same over pixels where no tie loses or reorders anything
    friend bool operator==(const AuditResult&, const AuditResult&) = default;
};

// `result` must have been run with frame.trace set.
[[nodiscard]] AuditResult audit(const pipeline::Frame& frame, const Algorithm& algorithm,
                                const pipeline::FrameResult& result, int threads);

}  // namespace strata::peeling
