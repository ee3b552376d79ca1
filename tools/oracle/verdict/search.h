// tools/oracle/verdict/search.h - which mistake in the structure makes a picture that is not right.
//
// Rule     Rules are tried on a sample first, under the hypotheses that hold all others, so that most of them fall at once; what is left has to
//          hold at every pixel under a definite hypothesis. Explanations that cost much more bits than the best one are none. What explains some
//          wrong pixels alone is a lead: by the pixels that it explains less the right ones that speak against it.
// Tests    tests/tools/oracle/verdict/search_test.cpp
#pragma once
#include "tools/oracle/verdict/match.h"

namespace strata::oracle::verdict {

// What a scene has, for the rules that can be told apart in it.
struct SceneFacts {
    std::size_t most_layers = 0;  // visible fragments of a pixel
    std::vector<std::uint32_t> instances{}, materials{};
    std::vector<float> alphas{};  // some of them, ascending, where they are few
    bool has_opaque = false, has_hidden = false, has_two_facings = false;
};
[[nodiscard]] SceneFacts facts_of(const SceneFragments& scene, const Sample& sample);

// All that are tried, the plainest first.
[[nodiscard]] std::vector<Rule> rules_for(const SceneFacts& facts);

struct Lead {
    Rule rule{};
    std::uint64_t explained = 0, of = 0;        // wrong pixels, of those that were looked at
    std::uint64_t contradicted = 0, right = 0;  // right pixels that speak against it, of those that were looked at
};

struct Findings {
    std::vector<Checked> explanations{};  // each whole; the first is the best
    std::vector<Lead> leads{};            // the best first
    std::uint64_t tried = 0;
};

// `definite`: the hypotheses under which an explanation has to hold; `closest`: the right structure's account that has the fewest wrong pixels;
// `sample`: pixels with some of the wrong ones among them.
[[nodiscard]] Findings search(const SceneFragments& scene, const Colors& candidate,
                              const std::vector<Hypothesis>& definite, const Checked& closest, const Sample& sample);

// "only the nearest 3 layers of 6 are composited": what a port does that goes by the rule.
[[nodiscard]] std::string sentence(const Rule& rule, const SceneFacts& facts, const pipeline::DrawList& list);

}  // namespace strata::oracle::verdict
