// tools/oracle/rules/rules.h - lists the rules that are tried on a scene, and describes them in words.
//
// Tests    tests/tools/oracle/search/search_test.cpp
#pragma once
#include <string>
#include <vector>

#include "rasterizer/base/vector.h"
#include "tools/oracle/rules/rule.h"

namespace strata::pipeline {
struct DrawList;
}

namespace strata::oracle::verdict {

class Sample;
class SceneFragments;

// Facts about a scene that determine which rules can be distinguished in it.
struct SceneFacts {
    std::size_t most_layers = 0;  // largest number of visible fragments of a pixel
    std::vector<std::uint32_t> instances{}, materials{};
    Rgba background{};  // the colour of background_other
    bool has_opaque = false, has_hidden = false, has_two_facings = false, has_centres_on_edges = false,
         has_other_background = false, is_dark_behind = true;  // what is behind all layers is black
};
[[nodiscard]] SceneFacts facts_of(const SceneFragments& scene, const Sample& sample);

// All rules that are tried, the simplest first.
[[nodiscard]] std::vector<Rule> rules_for(const SceneFacts& facts);
// The rank of a mistake by how often ports make it: 0 the usual ones. Explanations that this scene cannot distinguish
// are reported in this order.
[[nodiscard]] int commonness_of(RuleKind kind) noexcept;
// One rule per kind; if the kind has parameters, the values with the smallest effect.
[[nodiscard]] std::vector<Rule> one_of_each_kind(const SceneFacts& facts);

// "instance 2 (mesh decal)".
[[nodiscard]] std::string instance_name(std::uint32_t n, const pipeline::DrawList& list);
// Describes a port with this mistake: "only the nearest 3 layers of up to 6 are composited".
[[nodiscard]] std::string description(const Rule& rule, const SceneFacts& facts, const pipeline::DrawList& list);
[[nodiscard]] std::string description(const std::vector<Rule>& rules, const SceneFacts& facts,
                                      const pipeline::DrawList& list);

}  // namespace strata::oracle::verdict
