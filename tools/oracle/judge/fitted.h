// tools/oracle/judge/fitted.h - what fitting says of a picture: another way to draw the scene, another place of its
// pixels, or a program of few words.
//
// Rule     A picture that rounding alone explains at every pixel, those at edges too, is right. Drawings are asked
// first, then places, then programs; a drawing with one more edit is told only if the other
//          two explain nothing. A picture of floats that nothing explains is asked again in codes of 8 bits, as
//          ports interpolate in their own ways.
// Tests    tests/tools/oracle/program, tests/tools/library/judge_test.cpp
#pragma once
#include <string>
#include <vector>

#include "peeling/frame_request.h"
#include "tools/oracle/program/fit/fitting.h"
#include "tools/oracle/program/screen/screen.h"

namespace strata::oracle {

struct FittedPicture {
    program::Fitting fitting{};
    std::vector<program::ScreenMap> screen{};  // explains the picture instead of `fitting`, if there is any

    [[nodiscard]] bool is_explained() const noexcept {
        return !screen.empty() || fitting.state == program::Fitting::State::explained;
    }
    [[nodiscard]] double cost() const;                        // of the first explanation, in bits
    [[nodiscard]] std::vector<std::string> mistakes() const;  // if it is explained; the first one is the best
    [[nodiscard]] std::string right_sentence(std::size_t pixels) const;  // of a picture that is right
    [[nodiscard]] std::vector<std::string> leads() const;                // if it is explained in part
    [[nodiscard]] std::string lines(std::size_t pixels) const;           // that follow the first sentence
};

[[nodiscard]] FittedPicture fitted_picture(const peeling::FrameRequest& input, const verdict::SceneFragments& fragments,
                                           const verdict::Colors& colors);

// True if `own`, a right picture of the same scene, is explained in the same way: it is no mistake then.
[[nodiscard]] bool is_habit_of(const FittedPicture& seen, const verdict::SceneFragments& fragments,
                               const verdict::Colors& own);

}  // namespace strata::oracle
