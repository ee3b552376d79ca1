// tools/oracle/verdict/other_profile.h - finds a profile under which a picture is right that is wrong under the scene's
// own profile.
//
// Rule     Only definite hypotheses are used, and only if they leave at most two codes or few values possible, or the
//          picture contains at most one code: a hypothesis with wide rounding would explain too many pictures to be
//          evidence.
// Tests    tests/tools/compare_scene_test.cpp
#pragma once
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "tools/oracle/run_input.h"
#include "tools/oracle/verdict/fragments.h"
#include "tools/oracle/verdict/verdict.h"

namespace strata::oracle::verdict {

class Colors;

struct OtherProfile {
    std::unique_ptr<pipeline::DeviceProfile> profile;  // `fragments` refers to it
    std::unique_ptr<SceneFragments> fragments;
    Verdict verdict{};

    // Returns "  by the rules of profile llvmpipe; by those of geforce8 it would be wrong at 3 pixels\n".
    [[nodiscard]] std::string description(const std::string& given, std::size_t wrong_pixels) const;
};

// The first such profile among `more` and the built-in profiles; empty if there is none, or if it cannot render the
// scene.
[[nodiscard]] std::optional<OtherProfile> right_by_other_profile(const RunInput& input, std::uint64_t bytes,
                                                                 const Colors& candidate,
                                                                 const std::vector<std::uint32_t>& wrong_pixels,
                                                                 std::span<const pipeline::DeviceProfile> more = {});

}  // namespace strata::oracle::verdict
