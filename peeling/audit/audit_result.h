// peeling/audit/audit_result.h - the results of an audit (audit.h): order errors, lost layers and colour error.
#pragma once
#include <cstdint>
#include <optional>

namespace strata::peeling {

// The number of pixels with a property, and the first of them in row-major order, or (-1, -1).
struct PixelCount {
    std::uint64_t pixels = 0;
    int first_x = -1, first_y = -1;
    friend bool operator==(const PixelCount&, const PixelCount&) = default;
};

// The values do not depend on the number of threads, the tile size and the memory (audit.h).
struct AuditResult {
    int layers_max = 0;     // N: distinct visible keys of the deepest pixel
    int fragments_max = 0;  // M: visible fragments of the deepest pixel
    std::optional<std::uint64_t>
        order_errors;                // positions where the sequences differ; empty for an algorithm without an order
    std::uint64_t lost_by_ties = 0;  // visible fragments that the tie policy does not keep
    PixelCount ties, misordered;     // pixels with equal keys, and pixels with order errors
    PixelCount opaque_ties;  // pixels with fragments at exactly the depth of the opaque surface, which LESS hides
    std::uint64_t hidden_by_opaque_ties = 0;  // the number of such fragments
    double max_difference = 0;  // in 1/255, over r, g and b, and over alpha where the background's is not 1
    double max_difference_without_ties = 0;  // the same over pixels where no tie loses or reorders anything
    friend bool operator==(const AuditResult&, const AuditResult&) = default;
};

}  // namespace strata::peeling
