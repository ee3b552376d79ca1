// tools/oracle/verdict/other_rules.h - the rules that a right port may follow without an option that says so: of
// another profile, of the other origin, and with several samples per pixel of other sample positions and another
// shading.
//
// Rule     The given profile comes first, with the other origin (OpenGL draws with the origin at the lower left, so
//          that the sample positions are mirrored in the picture), then with the other shadings and sample positions,
//          then the caller's profiles and the built-in ones, each with both origins.
// Tests    tests/tools/strata/compare/compare_samples_test.cpp, tests/tools/strata/compare/compare_scene_test.cpp
#pragma once
#include <span>
#include <string>
#include <vector>

#include "peeling/frame_request.h"
#include "pipeline/device/profile.h"
#include "rasterizer/rules/raster_state.h"

namespace strata::oracle::verdict {

struct OtherRules {
    std::string name;  // "the rules of profile llvmpipe with --origin lower-left"
    pipeline::DeviceProfile profile;
    rasterizer::Interpolation interpolation{};
};

// Those that the scene was not given with, the simplest first.
[[nodiscard]] std::vector<OtherRules> other_rules(const peeling::FrameRequest& given,
                                                  std::span<const pipeline::DeviceProfile> more);

// "  by the rules of profile llvmpipe; by those of geforce8 it would be wrong at 3 pixels\n"
[[nodiscard]] std::string description(const OtherRules& rules, const std::string& given, std::size_t wrong_pixels);

// The square of a grid with the largest number of wrong pixels, in the picture: rules that do not explain it need not
// be tried on the whole picture.
[[nodiscard]] rasterizer::Rect most_wrong(const std::vector<std::uint32_t>& wrong_pixels, int width);

// The options with a scissor of that part of the picture; rows are counted from the top with either origin.
[[nodiscard]] peeling::RenderOptions scissored(peeling::RenderOptions options, const rasterizer::Rect& part);

}  // namespace strata::oracle::verdict
