// tools/oracle/verdict/rules.h - the rules that are tried on a scene, and what they say.
//
// Tests    tests/tools/oracle/verdict/search_test.cpp
#pragma once
#include <string>
#include <vector>

#include "rasterizer/base/vector.h"
#include "tools/oracle/verdict/rule.h"

namespace strata::pipeline {
struct DrawList;
}

namespace strata::oracle::verdict {

class Sample;
class SceneFragments;

// What a scene has, for the rules that can be told apart in it.
struct SceneFacts {
    std::size_t most_layers = 0;  // visible fragments of a pixel
    std::vector<std::uint32_t> instances{}, materials{};
    Rgba background{};            // of background_other
    std::vector<float> alphas{};  // some of them, ascending, where they are few
    bool has_opaque = false, has_hidden = false, has_two_facings = false, has_centres_on_edges = false,
         has_other_background = false;
};
[[nodiscard]] SceneFacts facts_of(const SceneFragments& scene, const Sample& sample);

// All that are tried, the plainest first.
[[nodiscard]] std::vector<Rule> rules_for(const SceneFacts& facts);
// One a kind; where the kind has numbers, that which shows the least.
[[nodiscard]] std::vector<Rule> one_of_each_kind(const SceneFacts& facts);
// The order in which the rules of a pair are applied: what takes part, then its order, then its colours.
[[nodiscard]] int stage_of(RuleKind kind) noexcept;

// "only the nearest 3 layers of up to 6 are composited": what a port does that goes by the rule.
[[nodiscard]] std::string sentence(const Rule& rule, const SceneFacts& facts, const pipeline::DrawList& list);
[[nodiscard]] std::string sentence(const std::vector<Rule>& rules, const SceneFacts& facts,
                                   const pipeline::DrawList& list);

}  // namespace strata::oracle::verdict
