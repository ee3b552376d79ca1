// strata/catch2.h - Catch2 matchers: REQUIRE_THAT(picture, strata::MatchesReference("teapot.exr")), and MatchesScene.
//
// Rule     Compares a Picture with a file, or with a picture that has a name. The message of a failure contains the
//          kinds of differences, the first pixel of each, and the path of the written pictures (strata/compare.h).
//          Works with Catch2 2 and 3; the project's own tests use 2.13.
#pragma once
#if __has_include(<catch2/matchers/catch_matchers.hpp>)
#include <catch2/matchers/catch_matchers.hpp>
#else
#include <catch2/catch.hpp>
#endif
#include <string>
#include <utility>

#include "strata/compare.h"
#include "strata/diagnose.h"

namespace strata {
inline namespace v0_1 {

#if __has_include(<catch2/matchers/catch_matchers.hpp>)
using CatchMatcher = Catch::Matchers::MatcherBase<Picture>;
#else
using CatchMatcher = Catch::MatcherBase<Picture>;
#endif

class MatchesReference : public CatchMatcher {
  public:
    explicit MatchesReference(Reference reference, const Tolerances& tolerances = {})
        : reference_{std::move(reference)}, tolerances_{tolerances} {}
    bool match(const Picture& candidate) const override {
        const Checked checked = check(candidate, reference_, tolerances_);
        message_ = checked.message;
        return checked.is_accepted;
    }
    std::string describe() const override { return message_; }

  private:
    Reference reference_;
    Tolerances tolerances_;
    mutable std::string message_;
};

// REQUIRE_THAT(picture, strata::MatchesScene(scene, strata::profile("geforce8"))): the verdict of judge() is "right".
class MatchesScene : public CatchMatcher {
  public:
    MatchesScene(const Scene& scene, DeviceProfile profile, const RenderOptions& options = {})
        : scene_{&scene}, profile_{std::move(profile)}, options_{options} {}
    bool match(const Picture& candidate) const override {
        const Judgement found = judge(*scene_, candidate, profile_, options_);
        message_ = "is a right picture of the scene: " + found.text;
        return found.is_right;
    }
    std::string describe() const override { return message_; }

  private:
    const Scene* scene_;  // must outlive the matcher
    DeviceProfile profile_;
    RenderOptions options_;
    mutable std::string message_;
};

}  // namespace v0_1
}  // namespace strata

// Prints a picture's size and formats, because its codes would fill pages.
template <>
struct Catch::StringMaker<strata::Picture> {
    static std::string convert(const strata::Picture& picture) { return strata::size_text(picture); }
};
