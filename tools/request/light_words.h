// tools/request/light_words.h - the lights of a scene and the lighting model as words of an option.
//
// Rule     Lights have / between them, the parts of a light commas, and the channels of a colour colons:
//            directional,DX,DY,DZ
//            point,X,Y,Z[,A0,A1,A2]
//            spot,X,Y,Z,DX,DY,DZ,CUTOFF[,EXPONENT[,A0,A1,A2]]
//          each with any of color=R:G:B (diffuse and specular), diffuse=, specular=, ambient=, range=DISTANCE behind.
//          "none": no lights. A value that lights may not have is read, and refused by the renderer with its place.
// Source   scenes/reference/reports.md 6; pipeline/reference/lighting.md 1.
// Tests    tests/tools/request/light_words_test.cpp
#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "pipeline/lighting/light.h"

namespace strata::tools {

[[nodiscard]] std::optional<std::vector<pipeline::Light>> to_lights(std::string_view text);
[[nodiscard]] std::string lights_text(const std::vector<pipeline::Light>& lights);

// Any of ambient=R:G:B, specular=R:G:B, emission=R:G:B, shininess=N, local-viewer, two-sided and separate-specular,
// with commas between.
[[nodiscard]] std::optional<pipeline::LightModel> to_light_model(std::string_view text);
[[nodiscard]] std::string light_model_text(const pipeline::LightModel& model);

}  // namespace strata::tools
