// tools/request/complete.h - which options exclude each other, and what the profile completes.
//
// Source   scenes/reference/reports.md 6
// Tests    tests/tools/strata/render/samples_test.cpp, tests/tools/python/test_scenes.py
#pragma once
#include <optional>
#include <string>

#include "tools/request/picture_request.h"

namespace strata::tools {

// Options that do not go together. `option` is the one to blame ("--sample"), or empty if the sentence names them.
struct OptionConflict {
    std::string option, sentence;
};
[[nodiscard]] std::optional<OptionConflict> option_conflict(const PictureRequest& request);

// A frame whose colours are encoded twice: an srgb8_alpha8 target encodes linear light. The sentence follows
// "--color-space: ".
[[nodiscard]] std::optional<std::string> light_conflict(const peeling::RenderOptions& options,
                                                        pipeline::ColorSpace space);

// Sets what depends on several options or on the profile: the clip convention, where programs are evaluated, the
// position of --sample, and the background of the frame, premultiplied and in the frame's colour space. Throws Refused
// if the profile lacks the number of samples of --sample.
void complete(PictureRequest& request, const pipeline::DeviceProfile& profile);

// The request that complete() turns into these options: those of a pack.
[[nodiscard]] PictureRequest request_of(const peeling::RenderOptions& options);

}  // namespace strata::tools
