// tools/oracle/judge/judge.h - the verdict on a picture of a scene, with any number of samples per pixel, as sentences.
//
// Rule     One function for `strata compare`, `strata diagnose`, the C++ library and Python, so that they agree.
// Tests    tests/tools/library/judge_test.cpp
#pragma once
#include <span>
#include <string>
#include <vector>

#include "peeling/frame_request.h"
#include "tools/oracle/judge/asked_picture.h"

namespace strata::oracle {

struct Judgement {
    bool is_right = false;
    bool is_undecided = false;             // a right port may leave the picture, but not all mistakes were excluded
    bool is_explained = false;             // a mistake explains the whole picture
    std::string sentence{};                // "right: ...", "not decided: ..." or "wrong: ..."
    std::vector<std::string> mistakes{};   // each explains the whole picture
    std::vector<std::string> forgotten{};  // which option of the view looks forgotten (forgotten.h)
    std::vector<std::string> leads{};      // what explains some of the wrong pixels
    std::string text{}, json{};            // as `strata compare` prints them
};

// `more`: profiles that are tried before the built-in ones. Throws Refused if the device lacks the number of samples.
[[nodiscard]] Judgement judge(const peeling::FrameRequest& input, const AskedPicture& picture,
                              std::span<const pipeline::DeviceProfile> more = {});

}  // namespace strata::oracle
