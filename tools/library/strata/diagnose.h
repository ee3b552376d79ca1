// strata/diagnose.h - decides whether a picture of a scene that another renderer drew is right, and finds which known
// mistake, or which two, explain it.
//
// Rule     `judge` is the verdict of `strata compare`: a picture is right if a port that composites the right fragments
//          in the right order can make it, whatever its formats and rounding. `diagnose` renders the scene with each
//          known mistake at the candidate's size as well; mistakes are ranked by the number of pixels that equal the
//          candidate's. "unknown_mistake" is a possible verdict. Both are efforts of one judge and do not contradict
//          each other (tools/oracle/judge/judge.h).
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
    oracle::Judgement judgement{};
    oracle::Diagnosis diagnosis{};  // of the emulations
    Comparison comparison{};        // of the right picture with the candidate

    // True for "right", "other_options" and "right_structure".
    [[nodiscard]] bool is_right() const noexcept;
    // "right", "other_options", "right_structure", "one_mistake", "two_mistakes", "unknown_mistake"
    [[nodiscard]] std::string verdict() const;
    // The names of the mistakes: one ("culls_front") or two. Empty for a right picture and for an unknown mistake.
    [[nodiscard]] std::vector<std::string> mistakes() const;
    // Other mistakes with the same picture of this scene.
    [[nodiscard]] std::vector<std::string> alike() const;
    [[nodiscard]] std::string sentence() const;
    [[nodiscard]] std::string text() const;  // as `strata diagnose` prints it
    [[nodiscard]] std::string json() const;
};

// state, is_right, is_undecided, sentence, mistakes, forgotten, leads, text, json.
using oracle::Judgement;

// The verdict on a picture of the algorithm, or of any exact one. The candidate's size replaces that of `options`.
// Throws InputError for a candidate without colours, and Refused if the device lacks
// a feature.
[[nodiscard]] Judgement judge(const Scene& scene, const Picture& candidate, const DeviceProfile& profile,
                              const RenderOptions& options = {}, const Algorithm* algorithm = nullptr);

// The candidate's size replaces that of `options`. Throws InputError for a candidate
// without a target, and Refused if the device lacks a feature.
[[nodiscard]] Diagnosed diagnose(const Scene& scene, const Picture& candidate, const Algorithm& algorithm,
                                 const DeviceProfile& profile, const RenderOptions& options = {},
                                 const Tolerances& tolerances = {});

}  // namespace v0_1
}  // namespace strata
