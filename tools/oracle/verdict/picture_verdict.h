// tools/oracle/verdict/picture_verdict.h - the verdict on the picture of a port: the one answer that compare, diagnose,
// the library and Python give.
//
// Rule     In this order: the right structure under a narrow hypothesis, equality with a picture of the program
//          (equal_picture.h), the search for mistakes (verdict.h), the rules of the other profiles (other_profile.h).
//          Of a file with straight colours the form with fewer wrong pixels is used (form.h). A file for display of a
//          linear frame is read as encoded values, as codes of an sRGB target, then as linear ones. A picture that
//          needs more pixels at edges than real snapping moves is not decided; it is wrong if all of them are moved in
//          one direction (shifted_edges.h). One that loses fragments of one depth is wrong of an algorithm that keeps
//          them.
// Tests    tests/tools/oracle/verdict/picture_verdict_test.cpp, tests/tools/strata/compare/compare_scene_test.cpp
#pragma once
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>

#include "peeling/frame_request.h"
#include "tools/oracle/fragments/form.h"
#include "tools/oracle/fragments/fragments.h"
#include "tools/oracle/show_progress.h"
#include "tools/oracle/verdict/verdict.h"

namespace strata::peeling {
struct Algorithm;
}

namespace strata::oracle::verdict {

// One sample per pixel; resolved.h judges pictures with several.
struct PictureQuestion {
    const TargetImage& colors;
    bool is_form_stated = false;                      // an option says whether colours are straight or premultiplied
    bool has_alpha = true;                            // false: alpha is not compared
    bool is_frame_linear = false;                     // --color-space linear
    const peeling::Algorithm* algorithm = nullptr;    // that the port runs; null: not known
    std::span<const pipeline::DeviceProfile> more{};  // profiles that are tried before the built-in ones
    ShowProgress progress{};
};

struct PictureVerdict {
    Verdict found{};
    Formed formed{};
    std::string reading{};  // lines on how the picture was read, and by which profile; each indented and ended
    std::unique_ptr<pipeline::DeviceProfile> other_profile{};  // null: right or wrong by the given one
    std::unique_ptr<SceneFragments> fragments{};               // of the profile that `found` is about

    [[nodiscard]] State state() const noexcept { return found.state(); }
    [[nodiscard]] bool is_right() const noexcept { return found.is_right; }
};

// Objects that `input` and `question` refer to must outlive the result. Throws Refused and InputError like a renderer.
[[nodiscard]] PictureVerdict judge_picture(const peeling::FrameRequest& input, const PictureQuestion& question);

[[nodiscard]] std::string to_text(const PictureVerdict& verdict, const pipeline::DrawList& list);
// With the form that colours were read in and the name of the profile as its last keys.
[[nodiscard]] nlohmann::ordered_json json_of(const PictureVerdict& verdict, const pipeline::DrawList& list,
                                             const std::string& given_profile);

}  // namespace strata::oracle::verdict
