// pipeline/diagnostics.h - what the emulated machine got wrong, or was made to do, in one run. Nothing is silently wrong.
#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace strata::pipeline {

enum class Fault : std::uint8_t {
    stencil_saturated,      // INCR or DECR met its limit
    half_saturated,         // an fp16 sum or count stopped growing or overflowed
    early_end,              // a query ended the peel while fragments were left
    endless,                // a peel whose compared depth misses the stored one found the same fragments again and again
    truncated,              // --max-passes, fixed:N or ratio:R ended the peel while fragments were left
    merged_ties,            // equal depths met in one layer: colours mixed or fragments lost
    depth_quantized,        // a program had to quantise its z like the buffer before comparing
    non_finite_vertices,    // triangles dropped for NaN or infinite coordinates
    emulator_extension,     // a feature no real device had (STRATA_depth_units ...)
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

// Adds to `all` what another region found: counts add up, the earlier first pixel stays. Order of calls does not matter.
void merge(std::vector<Diagnostic>& all, const Diagnostic& one);

}  // namespace strata::pipeline
