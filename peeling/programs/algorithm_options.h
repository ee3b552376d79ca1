// peeling/programs/algorithm_options.h - the options of single algorithms. The comment of a field names the algorithms
// that read it.
#pragma once
#include <cstdint>
#include <optional>

#include "peeling/programs/weight_formula.h"

namespace strata::peeling {

// The weight of a fragment in weighted_blended, McGuire and Bavoil 2013 (peeling/reference/algorithms.md 18): equations
// 7 to 9 by the distance from the eye, equation 10 by the window depth; constant: 1.
enum class Weight : std::uint8_t { eq7, eq8, eq9, eq10, constant };

// How the fragments behind those that are composited in order are shown (algorithms.md 21.3).
enum class Tail : std::uint8_t { none, blend, average, weighted };

// What happens to a fragment for which a list has no node left (algorithms.md 20).
enum class Overflow : std::uint8_t { drop_new, drop_far, blend };

// What has a list of fragments of its own in a frame of several samples (algorithms.md 21.4).
enum class ListGranularity : std::uint8_t { sample, pixel };

inline constexpr int most_nodes = 8, most_stochastic_samples = 8;

struct AlgorithmOptions {
    Weight weight = Weight::eq10;                   // weighted_blended, weighted_blended_shared, tails
    std::optional<WeightFormula> weight_formula{};  // instead of `weight`
    int nodes = 4;               // k, nodes per pixel: multi_layer, adaptive, atomic_loop, hybrid_transparency
    std::optional<Tail> tail{};  // atomic_loop (blend), hybrid_transparency (average), front_to_back and dual (none)
    int pixel_nodes = 0;         // linked_list: nodes per pixel; 0: no limit
    int frame_nodes = 0;         // linked_list: nodes per frame; 0: no limit
    Overflow overflow{};         // linked_list
    ListGranularity list_granularity{};  // algorithms with lists of fragments (Algorithm::has_lists)
    int moments = 4;                     // moments: 4, 6 or 8
    std::optional<float> moment_bias{};  // moments: share of a fixed distribution, 0 to 1; default by `moments`
    float overestimation = 0.25f;        // moments: share of its own absorbance that dims a fragment
    int stochastic_samples = 4;          // stochastic: samples per pixel
    std::uint32_t stochastic_seed = 0;
    friend bool operator==(const AlgorithmOptions&, const AlgorithmOptions&) = default;
};

// The distance from the eye along its axis, as a program computes it from the window depth z with uniforms of the
// projection: |a + b z| / |c + d z| (algorithms.md 18.2), in binary32, each operation rounded.
struct EyeDistance {
    float a = 0, b = 0, c = 1, d = 0;
};

// The inputs of an algorithm in addition to its region.
struct ListingInputs {
    AlgorithmOptions options;
    EyeDistance eye;
};

}  // namespace strata::peeling
