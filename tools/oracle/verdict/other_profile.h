// tools/oracle/verdict/other_profile.h - finds another profile or origin under which a picture is right that is wrong
// under those given.
//
// Rule     Only definite hypotheses are used, and only if they leave at most two codes or few values possible, or the
//          picture contains at most one code: a hypothesis with wide rounding would explain too many pictures to be
//          evidence.
// Tests    tests/tools/strata/compare/compare_scene_test.cpp
#pragma once
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "peeling/frame_request.h"
#include "tools/oracle/fragments/fragments.h"
#include "tools/oracle/verdict/other_rules.h"
#include "tools/oracle/verdict/verdict.h"

namespace strata::oracle::verdict {

class Colors;

// The verdict on a picture that is right under a hypothesis which leaves little open, with the coverage of other
// rasterizers if the scene has it. Empty if there is none.
[[nodiscard]] std::optional<Verdict> right_narrowly(const SceneFragments& scene, const Colors& candidate);

struct OtherProfile {
    std::unique_ptr<pipeline::DeviceProfile> profile;  // `fragments` refers to it
    std::unique_ptr<SceneFragments> fragments;
    Verdict verdict{};
    OtherRules rules{};

    // Returns "  by the rules of profile llvmpipe; by those of geforce8 it would be wrong at 3 pixels\n".
    [[nodiscard]] std::string description(const std::string& given, std::size_t wrong_pixels) const;
};

// The verdict by the rules if the picture is right by them; empty if it is not, or if they cannot render the scene.
// `wrong_pixels`: by the rules given; those are compared first.
[[nodiscard]] std::optional<OtherProfile> right_by_rules(const peeling::FrameRequest& input, OtherRules rules,
                                                         const Colors& candidate,
                                                         const std::vector<std::uint32_t>& wrong_pixels);

// The same by the first of other_rules.h.
[[nodiscard]] std::optional<OtherProfile> right_by_other_profile(const peeling::FrameRequest& input,
                                                                 const Colors& candidate,
                                                                 const std::vector<std::uint32_t>& wrong_pixels,
                                                                 std::span<const pipeline::DeviceProfile> more = {});

}  // namespace strata::oracle::verdict
