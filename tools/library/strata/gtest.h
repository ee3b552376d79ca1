// strata/gtest.h - a GoogleTest matcher: EXPECT_THAT(picture, strata::MatchesReference("teapot.exr")), or without gmock
// EXPECT_TRUE(strata::matches_reference(picture, "teapot.exr")).
//
// Rule     As strata/catch2.h: the message of a failure contains the kinds of differences, the first pixel of each, and
//          the path of the written pictures.
#pragma once
#include <gtest/gtest.h>
#if __has_include(<gmock/gmock-matchers.h>)
#include <gmock/gmock-matchers.h>
#endif

#include <ostream>

#include "strata/compare.h"
#include "strata/diagnose.h"

namespace strata {
inline namespace v0_1 {

[[nodiscard]] inline testing::AssertionResult matches_reference(const Picture& candidate, const Reference& reference,
                                                                const Tolerances& tolerances = {}) {
    const Checked checked = check(candidate, reference, tolerances);
    return (checked.is_accepted ? testing::AssertionSuccess() : testing::AssertionFailure()) << checked.message;
}

// EXPECT_TRUE(strata::matches_scene(picture, scene, profile)): the verdict of judge() is "right".
[[nodiscard]] inline testing::AssertionResult matches_scene(const Picture& candidate, const Scene& scene,
                                                            const DeviceProfile& profile,
                                                            const RenderOptions& options = {}) {
    const Judgement found = judge(scene, candidate, profile, options);
    return (found.is_right ? testing::AssertionSuccess() : testing::AssertionFailure()) << found.text;
}

#if __has_include(<gmock/gmock-matchers.h>)
class ReferenceMatcher {
  public:
    using is_gtest_matcher = void;
    ReferenceMatcher(Reference reference, const Tolerances& tolerances)
        : reference_{std::move(reference)}, tolerances_{tolerances} {}
    bool MatchAndExplain(const Picture& candidate, std::ostream* out) const {
        const Checked checked = check(candidate, reference_, tolerances_);
        if (out != nullptr) *out << checked.message;
        return checked.is_accepted;
    }
    void DescribeTo(std::ostream* out) const { *out << "equals " << reference_.name(); }
    void DescribeNegationTo(std::ostream* out) const { *out << "differs from " << reference_.name(); }

  private:
    Reference reference_;
    Tolerances tolerances_;
};

[[nodiscard]] inline ReferenceMatcher MatchesReference(Reference reference, const Tolerances& tolerances = {}) {
    return {std::move(reference), tolerances};
}
#endif

}  // namespace v0_1

namespace oracle {
// Prints a picture's size and formats, because its codes would fill pages.
inline void PrintTo(const Picture& picture, std::ostream* out) { *out << size_text(picture); }
}  // namespace oracle
}  // namespace strata
