// tools/oracle/verdict/right_picture.h - what remains to be asked of a picture that the right structure reaches at
// every pixel: whether a mistake explains it better, whether rounding does, and its alpha.
//
// Rule     In this order, the first that finds something decides. A mistake that explains, without another rasterizer,
//          the pixels at edges that the right structure explains with one. A doubt about the rounding (doubt.h). A
//          mistake that describes the picture in fewer bits than the right account with wide intervals does: a picture
//          that only wide intervals reach is no evidence. If the search for it is cut short, the picture is not
//          decided.
// Tests    tests/tools/oracle/verdict/verdict_test.cpp, picture_verdict_test.cpp
#pragma once
#include "tools/oracle/search/match.h"
#include "tools/oracle/verdict/verdict.h"

namespace strata::oracle::verdict {

// Hypotheses by the possible error of colours and alpha, whose values are in [0, 1].
struct Choices {
    Families definite{};  // none, or some units in the last place of binary32
    Families coarse{};    // interpolated or stored with fewer bits
    Families loose{};     // as coarse, with blending errors of up to one code per layer
};

[[nodiscard]] Choices choices(const Colors& candidate);

// True if a right account needs no comparison with others, because its intervals are narrow: one code, or few bits per
// pixel for floats.
[[nodiscard]] bool leaves_little_open(const CheckedAccount& right);

class RightPicture {
  public:
    RightPicture(const SceneFragments& scene, const Colors& candidate, const Choices& all, const SearchLimits& limits)
        : scene_{scene},
          candidate_{candidate},
          all_{all},
          narrower_{limits.narrower + limits.of_fragment * scene.count()},
          of_edges_{limits.narrower / 30 + limits.of_fragment * scene.count()} {}

    // `verdict` has the facts of the scene, `right` is whole, and `even` is a sample of the picture.
    [[nodiscard]] Verdict decide(Verdict verdict, CheckedAccount&& right, const Sample& even) const;

  private:
    const SceneFragments& scene_;
    const Colors& candidate_;
    const Choices& all_;
    std::uint64_t narrower_, of_edges_;
};

}  // namespace strata::oracle::verdict
