// tools/oracle/verdict/verdict.h - decides whether a picture of a scene is right, and if not, which fragments it
// composited differently.
//
// Rule     A picture is right if the right structure reaches every pixel under one rounding hypothesis. Definite
//          hypotheses (one rounding and one format per end, attributes with an error of at most some units in the last
//          place) are tried first. If none holds, a loose one must describe the picture in fewer bits than the closest
//          definite one with its wrong pixels (pricing.h). Otherwise the picture is wrong: a mistake that explains all
//          of it is an explanation, one that explains a part of it is a lead. Explanations that this scene cannot
//          distinguish are all reported; none is preferred.
// Tests    tests/tools/oracle/verdict/verdict_test.cpp
#pragma once
#include <optional>
#include <string>

#include "tools/oracle/rules/rules.h"
#include "tools/oracle/search/account.h"
#include "tools/oracle/search/alpha.h"

namespace strata::oracle::verdict {

// right_but_excused: right, apart from pixels that the verdict counts and names: edges that only another rasterizer
// covers so, fragments of one depth of which one is lost.
enum class State : std::uint8_t { right, right_but_excused, undecided, wrong };

struct Verdict {
    bool is_right = false;
    int width = 0;                         // of the picture, in pixels
    std::uint64_t shown_at_far_plane = 0;  // pixels at which the port has no depth test against the cleared depth
    SceneFacts facts{};
    CheckedAccount right{};                      // the closest account of the right structure
    AlphaChecked alpha{};                        // of a picture whose colours are all right
    std::vector<CheckedAccount> explanations{};  // mistakes, if colours are wrong
    std::vector<Lead> leads{};                   // if no mistake explains the whole picture
    // The kinds of mistakes that give the same picture of this scene: if it is right, those that would be called right,
    // too.
    std::vector<Rule> alike{};
    std::size_t kinds = 0;                 // number of kinds that were tried
    std::string equal_to{};                // the algorithm whose picture this is; "": none, or not asked
    std::string doubt{};                   // why a picture that a right port may leave is not called right
    std::string finding{};                 // a mistake that is no rule, as words after "wrong: "
    bool is_stopped = false;               // the search ended before all mistakes were tried
    std::string distinguishing_command{};  // command of a scene that distinguishes the explanations, if one is known

    // True if rounding explains every pixel, but the search ended before all mistakes that may explain the picture
    // better were tried.
    [[nodiscard]] bool is_undecided() const noexcept {
        return !is_right && finding.empty() && explanations.empty() && right.is_whole() &&
               alpha.state != AlphaState::wrong;
    }
    [[nodiscard]] State state() const noexcept {
        if (!is_right) return is_undecided() ? State::undecided : State::wrong;
        return equal_to.empty() && right.excused() > 0 ? State::right_but_excused : State::right;
    }
};

class SceneFragments;
class Colors;

// Limits of a search, in layers listed or composited (work.h); about 15 million take a second. Deciding that a picture
// is right is not limited.
struct SearchLimits {
    std::uint64_t mistakes = 60'000'000;   // for the mistake of a wrong picture
    std::uint64_t narrower = 450'000'000;  // for mistakes that fit better than the wide intervals of a right account
    std::uint64_t leads = 30'000'000;
    std::uint64_t of_fragment = 4;  // added per fragment of the scene
};

// Decides if the picture is clearly right: by the given fragments alone, with little left open. Empty if not.
[[nodiscard]] std::optional<Verdict> judge_quickly(SceneFragments& scene, const Colors& candidate,
                                                   const SearchLimits& limits = {});
// Decides what is not clearly right. Makes the scene compute the other coverage of its edges (coverages.h).
[[nodiscard]] Verdict judge_at_length(SceneFragments& scene, const Colors& candidate, const SearchLimits& limits = {});
// The one, and if it is empty the other.
[[nodiscard]] Verdict judge(SceneFragments& scene, const Colors& candidate, const SearchLimits& limits = {});

}  // namespace strata::oracle::verdict
