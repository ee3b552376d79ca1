// tools/oracle/program/steps/entries.h - the tables of what a port may do in each step, and their parts.
//
// Rule     An entry is a name in words, what it does, and its parameter with candidates. A kind of mistake is an entry;
//          everything else (search, proof, sentence) is the same for all.
// Tests    tests/tools/oracle/program/found_test.cpp
#pragma once
#include <span>
#include <vector>

#include "tools/oracle/program/program.h"

namespace strata::oracle::program {

// Layers are lost, repeated or mixed up with their neighbours.
[[nodiscard]] std::span<const StepEntry> list_entries();
// Colours and alphas have other values.
[[nodiscard]] std::span<const StepEntry> value_entries();
// The selected fragments are composited in another order.
[[nodiscard]] std::span<const StepEntry> order_entries();
[[nodiscard]] std::span<const StepEntry> background_entries();
[[nodiscard]] std::span<const StepEntry> fold_entries();
[[nodiscard]] std::span<const StepEntry> sum_entries();
[[nodiscard]] std::span<const StepEntry> finish_entries();
// All of them.
[[nodiscard]] const std::vector<const StepEntry*>& entries();

// A change of each selected layer.
template <auto change>
void each(PortLayers& layers, const SelectedFragments& selection, Parameters parameters) {
    for (PortLayer& layer : layers)
        if (selection.has(layer)) change(layer, parameters);
}

// A fold; `is_fitted`: its parameter is continuous.
using FoldFunction = Color (*)(std::span<const PortLayer> layers, const Color& behind, const PortRounding& rounding,
                               Parameters p);
constexpr StepEntry fold_entry(std::string_view words, double price, FoldFunction fold,
                               std::span<const double> parameters = {}, bool is_fitted = false) {
    return {.step = PortStep::fold,
            .words = words,
            .price = price,
            .parameters = parameters,
            .is_continuous = is_fitted,
            .fold = fold};
}

// sRGB's curve.
[[nodiscard]] double encoded(double linear) noexcept;
[[nodiscard]] double decoded(double code) noexcept;
// To a number of codes: `bits` are 1 to 16.
[[nodiscard]] double in_bits(double v, double bits) noexcept;

}  // namespace strata::oracle::program
