// tools/oracle/verdict/search.h - which mistake in the structure makes a picture that is not right.
//
// Rule     Rules are tried on a sample first, under the hypotheses that hold all others, so that most of them fall at
//          once; what is left has to hold at every pixel under a definite hypothesis. Explanations that cost much more
//          bits than the best one are none. What explains some wrong pixels alone is a lead: by the pixels that it
//          explains less the right ones that speak against it.
// Tests    tests/tools/oracle/verdict/search_test.cpp
#pragma once
#include "tools/oracle/verdict/match.h"
#include "tools/oracle/verdict/rules.h"

namespace strata::oracle::verdict {

// Accounts with `most_rules` rules, one or two, each of which holds for the whole picture; the first is the best.
// `definite`: the hypotheses under which they have to hold; `closest`: the right structure's account that has the
// fewest wrong pixels; `sample`: pixels with some of the wrong ones among them; `region`: where a port makes the
// mistake.
[[nodiscard]] std::vector<Checked> search(const SceneFragments& scene, const Colors& candidate,
                                          const Families& definite, const Checked& closest, const Sample& sample,
                                          int most_rules, const Region& region = {});

// The same with one rule, under hypotheses that leave little open: those that explain every pixel of the sample,
// whether it is right by another one or not.
[[nodiscard]] std::vector<Checked> search_all(const SceneFragments& scene, const Colors& candidate,
                                              const Families& narrow, const Sample& sample);

// The rules that explain most of the wrong pixels of a sample, the best first.
[[nodiscard]] std::vector<Lead> leads(const SceneFragments& scene, const Checked& closest, const Sample& sample);

}  // namespace strata::oracle::verdict
