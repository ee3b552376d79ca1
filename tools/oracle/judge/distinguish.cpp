// tools/oracle/judge/distinguish.cpp - looks for a scene of the suite that distinguishes explanations (distinguish.h).
#include "tools/oracle/judge/distinguish.h"

#include "tools/oracle/diagnosis/distinguishing_scene.h"
#include "tools/oracle/fragments/fragments.h"
#include "tools/oracle/rules/distinguish_rules.h"
#include "tools/oracle/suite/suite.h"
#include "tools/oracle/verdict/verdict.h"

namespace strata::oracle {

std::string distinguishing_command(const verdict::Verdict& found) {
    std::vector<std::vector<verdict::Rule>> rules;
    for (const verdict::CheckedAccount& c : found.explanations)
        if (is_of_any_scene(c.account.rules)) rules.push_back(c.account.rules);
    if (rules.size() < 2) return "";
    for (const SuiteScene& scene : suite()) {
        if (scene.samples > 1) continue;  // the rules are about pictures of one
        const OpenScene opened = open(scene);
        const verdict::SceneFragments fragments{opened.input(), opened.options.fragment_memory};
        if (distinguishes(fragments, rules)) return command_of(scene);
    }
    return "";
}

const SuiteScene* scene_for(const Diagnosis& found, bool is_open) {
    constexpr std::size_t most = 4;
    std::vector<const Mistake*> mistakes;
    const Finding& best = found.findings.front();
    if (found.conclusion == Conclusion::one_mistake) {
        mistakes = best.mistakes;
        mistakes.insert(mistakes.end(), best.alike.begin(), best.alike.end());
    } else if (is_open) {
        for (const Finding& f : found.findings)
            if (f.mistakes.size() == 1 && f.explained > 0 && mistakes.size() < most) mistakes.push_back(f.mistakes[0]);
    }
    return distinguishing_scene(mistakes);
}

}  // namespace strata::oracle
