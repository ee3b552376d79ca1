// tools/request/complete.h - which options exclude each other, and what the profile completes.
//
// Source   scenes/reference/reports.md 6
// Tests    tests/tools/strata/render/samples_test.cpp, tests/tools/python/test_scenes.py
#pragma once
#include <optional>
#include <string>

#include "scenes/camera.h"
#include "tools/request/picture_request.h"

namespace strata::tools {

// Options that do not go together. `option` is the one to blame ("--sample"), or empty if the sentence names them.
struct OptionConflict {
    std::string option, sentence;
};
[[nodiscard]] std::optional<OptionConflict> option_conflict(const PictureRequest& request);

// Sets where programs are evaluated, from shades_pixels and interpolate. A request of one sample keeps its own.
void take_interpolation(PictureRequest& request);

// Sets the clip convention of the request, else of the profile, and returns it.
scenes::ClipConvention take_clip_convention(PictureRequest& request, const pipeline::DeviceProfile& profile);

// Sets the background of the frame, premultiplied and in the frame's colour space, if the request has one.
void take_background(PictureRequest& request);

// Sets the position of --sample. Throws Refused if the profile lacks the number of samples.
void take_sample(PictureRequest& request, const pipeline::DeviceProfile& profile);

}  // namespace strata::tools
