// strata/diagnose.h - finds which known mistake, or which two, explain a picture of a scene that another renderer drew.
//
// Rule     The scene is rendered with each known mistake at the candidate's size, and the mistakes are ranked by the
//          number of pixels that equal the candidate's (tools/oracle/mistakes/diagnosis.h). "unknown_mistake" is a
//          possible verdict.
// Cost     About a hundred pictures of the scene, and up to as many again for pairs of mistakes: only for small scenes.
// Tests    tests/tools/library/diagnose_test.cpp
#pragma once
#include <string>
#include <vector>

#include "strata/compare.h"
#include "strata/names.h"
#include "strata/render.h"
#include "strata/scene.h"
#include "tools/oracle/mistakes/diagnosis.h"

namespace strata {
inline namespace v0_1 {

struct Diagnosed {
    oracle::Diagnosis diagnosis{};
    Comparison comparison{};  // of the right picture with the candidate

    [[nodiscard]] bool is_right() const noexcept { return diagnosis.verdict == oracle::Verdict::right; }
    // "right", "one_mistake", "two_mistakes", "unknown_mistake"
    [[nodiscard]] std::string verdict() const;
    // The names of the mistakes: one ("culls_front") or two. Empty for a right picture and for an unknown mistake.
    [[nodiscard]] std::vector<std::string> mistakes() const;
    // Other mistakes with the same picture of this scene.
    [[nodiscard]] std::vector<std::string> alike() const;
    [[nodiscard]] std::string text() const;  // as `strata diagnose` prints it
    [[nodiscard]] std::string json() const;
};

// The candidate's size replaces that of `options`. `sampling`: of a resolved picture. Throws InputError for a candidate
// without a target, and Refused if the device lacks a feature.
[[nodiscard]] Diagnosed diagnose(const Scene& scene, const Picture& candidate, const Algorithm& algorithm,
                                 const DeviceProfile& profile, const RenderOptions& options = {},
                                 const Tolerances& tolerances = {}, const Multisampling& sampling = {});

}  // namespace v0_1
}  // namespace strata
