// peeling/audit/audit_result.h - the figures of an audit (audit.h): what the algorithm did, and what it lost.
#pragma once
#include <cstdint>
#include <optional>

namespace strata::peeling {

// Pixels that have something, and the first of them in row-major order; (-1, -1) if there is none.
struct PixelCount {
    std::uint64_t pixels = 0;
    int first_x = -1, first_y = -1;
    friend bool operator==(const PixelCount&, const PixelCount&) = default;
};

// The figures are the same for every number of threads, size of tiles and memory (audit.h).
struct AuditResult {
    int layers_max = 0;     // N: distinct visible keys of the deepest pixel
    int fragments_max = 0;  // M: visible fragments of the deepest pixel
    std::optional<std::uint64_t>
        order_errors;                // positions where the sequences differ; empty for an algorithm without an order
    std::uint64_t lost_by_ties = 0;  // visible fragments that the tie policy does not keep
    PixelCount ties, misordered;     // pixels with equal keys; pixels with order errors
    PixelCount opaque_ties;          // pixels with fragments at the very depth of the opaque surface, which LESS hides
    std::uint64_t hidden_by_opaque_ties = 0;  // these fragments
    double max_difference = 0;                // in 1/255, over r, g and b, and alpha where the background has not 1
    double max_difference_without_ties = 0;   // the same over pixels where no tie loses or reorders anything
    friend bool operator==(const AuditResult&, const AuditResult&) = default;
};

}  // namespace strata::peeling
