// pipeline/frame/diagnostics.h - what the emulated machine got wrong, or was made to do, in one run. Nothing is
// silently wrong.
#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace strata::pipeline {

enum class Fault : std::uint8_t {
    stencil_saturated,  // INCR or DECR met its limit
    half_saturated,     // an fp16 sum or count stopped growing or overflowed
    early_end,          // a query ended the peel while fragments were left
    endless,  // a peel found the same fragments again and again (a listing as printed, or its depths), and was stopped
    truncated,            // --max-passes, fixed:N or ratio:R ended the peel while fragments were left
    merged_ties,          // equal depths met in one layer: colours mixed or fragments lost
    depth_quantized,      // a program had to quantise its z like the buffer before comparing
    non_finite_vertices,  // triangles dropped for NaN or infinite coordinates
    count_limit,        // a count in the stencil buffer reached what its pass allows: more iterations, no wrong picture
    equal_at_bound,     // fragments of equal depth at the bound of a peel
    buffer_overflow,    // more fragments at a pixel than its k entries can hold or order
    as_published,       // a listing as printed lost, repeated or misplaced fragments
    out_of_order,       // what an algorithm takes for sorted is not
    ties_with_opaque,   // fragments at the very depth of an opaque surface: hidden, where LEQUAL would show them
    non_finite_target,  // a target came to hold infinity or NaN
    unlike_depths,      // layers lost or repeated because the compared depths are not the stored ones
    emulator_extension,  // a feature no real device had (STRATA_depth_units ...)
};

[[nodiscard]] constexpr std::string_view name(Fault fault) noexcept {
    switch (fault) {
        case Fault::stencil_saturated: return "stencil_saturated";
        case Fault::half_saturated: return "half_saturated";
        case Fault::early_end: return "early_end";
        case Fault::endless: return "endless";
        case Fault::truncated: return "truncated";
        case Fault::merged_ties: return "merged_ties";
        case Fault::depth_quantized: return "depth_quantized";
        case Fault::non_finite_vertices: return "non_finite_vertices";
        case Fault::count_limit: return "count_limit";
        case Fault::equal_at_bound: return "equal_at_bound";
        case Fault::buffer_overflow: return "buffer_overflow";
        case Fault::as_published: return "as_published";
        case Fault::out_of_order: return "out_of_order";
        case Fault::ties_with_opaque: return "ties_with_opaque";
        case Fault::non_finite_target: return "non_finite_target";
        case Fault::unlike_depths: return "unlike_depths";
        case Fault::emulator_extension: return "emulator_extension";
    }
    return "";  // unreachable: the enum is closed
}

// `first` is the first pixel concerned, row by row from the top left; (-1, -1) where no pixel is meant.
struct Diagnostic {
    Fault fault{};
    std::uint64_t pixels = 0;
    int first_x = -1, first_y = -1;
    std::string detail;
    friend bool operator==(const Diagnostic&, const Diagnostic&) = default;
};

// Adds to `all` what another region found: counts add up, the earlier first pixel stays. Order of calls does not
// matter.
void merge(std::vector<Diagnostic>& all, const Diagnostic& one);

}  // namespace strata::pipeline
