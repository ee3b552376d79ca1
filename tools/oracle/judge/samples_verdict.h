// tools/oracle/judge/samples_verdict.h - the verdict on a picture with several samples per pixel. If it is wrong, other
// rules are tried.
//
// Rule     The picture is judged by the given rules; if it is wrong, it is compared with the picture of the stated
//          algorithm or of the usual ones (equal_picture.h), then judged by the others of other_rules.h. The first that
//          it is right by is the verdict's. Of a file with straight colours both forms are judged, unless the form is
//          stated.
// Tests    tests/tools/strata/compare/compare_samples_test.cpp
#pragma once
#include <optional>
#include <vector>

#include "peeling/frame_request.h"
#include "tools/oracle/verdict/other_rules.h"
#include "tools/oracle/verdict/resolved.h"

namespace strata::oracle::verdict {
struct PictureQuestion;
}

namespace strata::oracle {

// Throws Refused if the profile lacks the number of samples.
[[nodiscard]] verdict::ResolvedVerdict judge_samples(const peeling::FrameRequest& input,
                                                     const verdict::PictureQuestion& question);

// The fragments of each sample by the rules, of a part of the picture or of all of it. Throws Refused.
[[nodiscard]] verdict::Samples samples_by(const verdict::OtherRules& rules, const peeling::FrameRequest& input,
                                          const std::optional<rasterizer::Rect>& within = {});

// The verdict by the rules if the picture is right by them. `wrong`: pixels that are wrong by the rules given, which
// are compared first.
[[nodiscard]] std::optional<verdict::ResolvedVerdict> right_samples_by(const verdict::OtherRules& rules,
                                                                       const peeling::FrameRequest& input,
                                                                       const verdict::Colors& candidate,
                                                                       const std::vector<std::uint32_t>& wrong);

}  // namespace strata::oracle
