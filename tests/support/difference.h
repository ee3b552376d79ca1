// tests/support/difference.h - compares the results of two runs that should be equal.
#pragma once
#include <algorithm>
#include <string>

#include "peeling/render.h"

namespace strata::testing {

// Names of the members that differ between two results; empty if they are equal. `work` and `seconds` may differ.
[[nodiscard]] inline std::string difference(const peeling::RenderResult& a, const peeling::RenderResult& b) {
    const auto same_layer = [](const auto& x, const auto& y) {
        return x.color == y.color && x.depth == y.depth && x.side == y.side;
    };
    if (a.outcome != b.outcome || a.refusal != b.refusal) return "outcome";
    if (a.frame.color != b.frame.color) return "colour";
    if (a.frame.samples != b.frame.samples) return "samples";
    if (a.frame.depth != b.frame.depth) return "depth";
    if (a.frame.iterations != b.frame.iterations) return "iterations";
    if (a.frame.passes != b.frame.passes) return "passes";
    if (a.frame.counters && b.frame.counters && a.frame.counters != b.frame.counters) return "counters";
    if (a.frame.layers.size() != b.frame.layers.size()) return "number of layers";
    if (!std::ranges::equal(a.frame.layers, b.frame.layers, same_layer)) return "layers";
    if (a.frame.diagnostics != b.frame.diagnostics) return "diagnostics";
    return a.audit == b.audit ? "" : "audit";
}

}  // namespace strata::testing
