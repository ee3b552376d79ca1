// tools/oracle/search/search.h - finds the mistake in the structure of a wrong picture.
//
// Rule     Rules are first tried on a sample under the widest hypotheses, which rejects most of them quickly; a
//          remaining rule must hold at every pixel under a definite hypothesis. Explanations that need much more bits
//          than the best one are dropped. A rule that explains only some wrong pixels is a lead; leads are ranked by
//          the pixels that they explain, minus a share of the right ones that contradict them.
// Tests    tests/tools/oracle/search/search_test.cpp
#pragma once
#include <limits>

#include "tools/oracle/rules/rules.h"
#include "tools/oracle/search/match.h"
#include "tools/oracle/search/split_sample.h"

namespace strata::oracle::verdict {

// The search for the mistakes of one picture. `closest`: the account of the right structure with the least cost;
// `sample`: pixels, including some wrong ones. All that is given must outlive the search.
class MistakeSearch {
  public:
    MistakeSearch(const SceneFragments& scene, const Colors& candidate, const CheckedAccount& closest,
                  const Sample& sample);
    // Accounts with a rule that holds for the whole picture; the best is first. `definite`: the hypotheses under which
    // they must hold; `region`: the pixels at which the port makes the mistake.
    [[nodiscard]] std::vector<CheckedAccount> found(const Families& definite, const RuleRegion& region = {});
    // The rules that explain the most wrong pixels of the sample, the best first.
    [[nodiscard]] std::vector<Lead> leads() const;

  private:
    // Of these hypotheses, those that hold for the right pixels.
    [[nodiscard]] const Families& likely(const Families& definite);

    const SceneFragments& scene_;
    const Colors& candidate_;
    const CheckedAccount& closest_;
    const Sample& sample_;
    SplitSample parts_;
    std::vector<Rule> rules_;
    Families likely_{};
    const Families* likely_of_ = nullptr;
};

// Accounts of one rule without the closest account, under narrow hypotheses: accounts must explain every pixel of
// the sample, including those that a wider hypothesis would call right.
struct AgainstRight {
    double bits = 0;                                      // of the account of the right structure
    int most_rejected = std::numeric_limits<int>::max();  // hypotheses of each rule (match.h)
};
[[nodiscard]] std::vector<CheckedAccount> search_all(const SceneFragments& scene, const Colors& candidate,
                                                     const Families& narrow, const Sample& sample,
                                                     const AgainstRight& against);

// The account of the whole picture with these rules, if it is an explanation: it holds for every pixel.
[[nodiscard]] std::optional<CheckedAccount> explained_by(const std::vector<Rule>& rules, const SceneFragments& scene,
                                                         const Colors& candidate, const Families& definite,
                                                         const Sample& sample);

}  // namespace strata::oracle::verdict
