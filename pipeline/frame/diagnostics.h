// pipeline/frame/diagnostics.h - errors of the emulated device in one run, and unusual behaviour that was requested. No
// known error is silent.
#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "rasterizer/base/enum_values.h"

namespace strata::pipeline {

enum class Fault : std::uint8_t {
    stencil_saturated,  // INCR or DECR reached its limit
    half_saturated,     // an fp16 sum or count stopped increasing or overflowed
    early_end,          // a query ended the peel while fragments were left
    endless,      // a peel found the same fragments repeatedly (a listing as printed, or its depths) and was stopped
    truncated,    // --max-passes, fixed:N or ratio:R ended the peel while fragments were left
    merged_ties,  // equal depths in one layer: colours mixed or fragments lost
    depth_quantized,      // a program had to quantize its z like the buffer before comparing
    non_finite_vertices,  // triangles dropped for NaN or infinite coordinates
    count_limit,          // a stencil count reached the limit of its pass: more iterations, same image
    equal_at_bound,       // fragments of equal depth at the bound of a peel
    buffer_overflow,      // more fragments at a pixel than its k entries can store or sort
    as_published,         // a listing as printed lost, repeated or misplaced fragments
    out_of_order,         // fragments that an algorithm requires to be sorted are not
    ties_with_opaque,     // fragments at exactly the depth of an opaque surface: hidden, while LEQUAL would show them
    non_finite_target,    // a target received infinity or NaN
    unlike_depths,        // layers lost or repeated because the compared depths differ from the stored ones
    emulator_extension,   // a feature that no real device had (STRATA_depth_units ...)
};

[[nodiscard]] constexpr std::string_view name(Fault fault) noexcept { return enum_name(fault); }

// `first` is the first affected pixel, row by row from the top left; (-1, -1) if the diagnostic has no pixel.
struct Diagnostic {
    Fault fault{};
    std::uint64_t pixels = 0;
    int first_x = -1, first_y = -1;
    std::string detail;
    friend bool operator==(const Diagnostic&, const Diagnostic&) = default;
};

// Merges the diagnostic of another region into `all`: counts are added, the earlier first pixel is kept. The order of
// calls does not matter.
void merge(std::vector<Diagnostic>& all, const Diagnostic& one);

}  // namespace strata::pipeline
