// tools/oracle/judge/another_camera.h - finds the camera of a picture that is right but for a camera a little off.
//
// Rule     Twelve movements are tried: the eye around the scene (sideways, up), turned or moved, the picture turned
// about
//          the line of sight or moved, the field of view, and the aspect. Each is fitted by the number of pixels that
//          differ by more than 2.5 codes, if one that moves the scene by half a pixel or one makes an eighth of them
//          right; the best alone, then with a second one. The camera is named if at most a sixth of these pixels, or
//          three, differ then.
// Units    Angles in degrees; distances in the scene's units; a moved picture in pixels.
// Tests    tests/tools/strata/compare/another_camera_test.cpp
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "peeling/frame_request.h"
#include "peeling/registry.h"
#include "tools/oracle/fragments/sample.h"

namespace strata::oracle {

struct AnotherCamera {
    std::string words{};    // "the eye is turned to the left by 0.5 degrees"
    std::size_t wrong = 0;  // pixels that differ from its picture
    [[nodiscard]] std::string sentence(std::size_t pixels) const;
};

// Empty if no camera that is a little off explains the picture. `algorithm` draws the right one.
[[nodiscard]] std::optional<AnotherCamera> another_camera(const peeling::FrameRequest& input,
                                                          const peeling::Algorithm& algorithm,
                                                          const verdict::Colors& picture);

}  // namespace strata::oracle
