// tools/strata/other_profile.h - is a picture that a scene's profile calls wrong right by the rules of another one?
//
// Rule     By definite hypotheses alone, and only where they leave at most two codes or few values open, or the picture
//          takes at most one code: what only a wide rounding makes right under another profile is no evidence.
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
}

namespace strata::tools {

struct OtherProfile {
    std::unique_ptr<pipeline::DeviceProfile> profile;  // which the fragments refer to
    std::unique_ptr<oracle::verdict::SceneFragments> fragments;
    oracle::verdict::Verdict verdict{};

    // "  by the rules of profile llvmpipe; by those of geforce8 it would be wrong at 3 pixels\n"
    [[nodiscard]] std::string sentence(const std::string& given, std::size_t wrong_pixels) const;
};

// The first of `more` and of the built-in profiles; none if there is no such profile, or if the scene cannot be drawn
// by it.
[[nodiscard]] std::optional<OtherProfile> right_by_other_profile(const oracle::RunInput& input, std::uint64_t bytes,
                                                                 const oracle::verdict::Colors& candidate,
                                                                 const std::vector<std::uint32_t>& wrong_pixels,
                                                                 std::span<const pipeline::DeviceProfile> more = {});

}  // namespace strata::tools
