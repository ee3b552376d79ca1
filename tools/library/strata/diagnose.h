// strata/diagnose.h - decides whether a picture of a scene that another renderer drew is right, and finds which known
// mistake, or which two, explain it.
//
// Rule     `judge` is the verdict of `strata compare`: a picture is right if a port that composites the right fragments
//          in the right order can make it, whatever its formats and rounding. `diagnose` renders the scene with each
//          known mistake at the candidate's size as well; mistakes are ranked by the number of pixels that equal the
//          candidate's (tools/oracle/judge/diagnose_picture.h). "unknown_mistake" is a possible verdict. A picture that
//          `judge` calls right has no mistake.
// Cost     `judge`: milliseconds to seconds. `diagnose`: about a hundred pictures of the scene, and up to as many again
//          for pairs of mistakes: only for small scenes.
// Tests    tests/tools/library/diagnose_test.cpp, tests/tools/library/judge_test.cpp
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "strata/compare.h"
#include "strata/names.h"
#include "strata/render.h"
#include "strata/scene.h"
#include "tools/oracle/diagnosis/diagnosis.h"
#include "tools/oracle/judge/judge.h"

namespace strata {
inline namespace v0_1 {

struct Diagnosed {
    oracle::Diagnosis diagnosis{};
    Comparison comparison{};  // of the right picture with the candidate

    std::shared_ptr<const std::vector<oracle::Mistake>> options{};  // which findings may point to

    // True for "right", "other_options" and "right_structure".
    [[nodiscard]] bool is_right() const noexcept;
    // "right", "other_options", "right_structure", "one_mistake", "two_mistakes", "unknown_mistake"
    [[nodiscard]] std::string verdict() const;
    // The names of the mistakes: one ("culls_front") or two. Empty for a right picture and for an unknown mistake.
    [[nodiscard]] std::vector<std::string> mistakes() const;
    // Other mistakes with the same picture of this scene.
    [[nodiscard]] std::vector<std::string> alike() const;
    [[nodiscard]] std::string text() const;  // as `strata diagnose` prints it
    [[nodiscard]] std::string json() const;
};

// is_right, is_undecided, sentence, leads, text, json.
using oracle::Judgement;

// The verdict on a picture, whatever exact algorithm made it. The candidate's size replaces that of `options`.
// Throws InputError for a candidate without colours, and Refused if the device lacks
// a feature.
[[nodiscard]] Judgement judge(const Scene& scene, const Picture& candidate, const DeviceProfile& profile,
                              const RenderOptions& options = {});

// The candidate's size replaces that of `options`. Throws InputError for a candidate
// without a target, and Refused if the device lacks a feature.
[[nodiscard]] Diagnosed diagnose(const Scene& scene, const Picture& candidate, const Algorithm& algorithm,
                                 const DeviceProfile& profile, const RenderOptions& options = {},
                                 const Tolerances& tolerances = {});

}  // namespace v0_1
}  // namespace strata
