// strata/diagnose.h - which known mistake, or which two, made a picture of a scene that another renderer drew.
//
// Rule     Machines with one mistake each draw the scene at the candidate's size; they are ranked by the pixels that
//          are the candidate's (tools/oracle/mistakes/diagnosis.h). "None that is known" is an answer.
// Cost     About a hundred pictures of the scene, and up to as many pairs again: meant for small scenes.
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
    Comparison comparison{};  // with the right picture

    [[nodiscard]] bool is_right() const noexcept { return diagnosis.verdict == oracle::Verdict::right; }
    // "right", "one_mistake", "two_mistakes", "unknown_mistake"
    [[nodiscard]] std::string verdict() const;
    // What is named: "culls_front"; of two, both. Empty for a right picture and for none that is known.
    [[nodiscard]] std::vector<std::string> mistakes() const;
    // Others that leave the same picture of this scene.
    [[nodiscard]] std::vector<std::string> alike() const;
    [[nodiscard]] std::string text() const;  // as `strata diagnose` prints it
    [[nodiscard]] std::string json() const;
};

// The candidate's size stands for that of `options`. InputError for a candidate without a target, Refused for what the
// device lacks.
[[nodiscard]] Diagnosed diagnose(const Scene& scene, const Picture& candidate, const Algorithm& algorithm,
                                 const DeviceProfile& profile, const RenderOptions& options = {},
                                 const Tolerances& tolerances = {});

}  // namespace v0_1
}  // namespace strata
