// scenes/procedural/hard_cases/alpha.cpp - alphas that round to 0, saturate or are between two 8-bit codes.
#include "scenes/procedural/hard_cases/build_case.h"

namespace strata::scenes::hard {
namespace {

// 16 flat layers, every second one with this alpha and the others with 1/2.
void alpha_layers(CaseScene& scene, float alpha) {
    for (int i = 0; i < 16; ++i)
        add_quad(scene, whole(scene), {(i * 7 % 16 + 1) / 32.0, 0, 0}, color_of(i, i % 2 == 0 ? alpha : 0.5f));
}

void alpha_zero(CaseScene& scene) { alpha_layers(scene, 0); }
void alpha_one(CaseScene& scene) { alpha_layers(scene, 1); }
void alpha_tiny(CaseScene& scene) { alpha_layers(scene, 0x1p-24f); }
void almost_one(CaseScene& scene) { alpha_layers(scene, 1 - 0x1p-24f); }
void half_a_code(CaseScene& scene) { alpha_layers(scene, 1.0f / 510); }

void alpha_zero_alone(CaseScene& scene) {
    for (int i = 0; i < 4; ++i) add_quad(scene, whole(scene), {(i + 1) / 8.0, 0, 0}, color_of(i, 0));
}

HardCase alpha_case(std::string_view name, std::string_view hard, std::string_view answer,
                    void (*build)(CaseScene& scene)) {
    return {.name = name,
            .hard = hard,
            .answer = answer,
            .width = 16,
            .height = 16,
            .build = build,
            .counts = {4096, 16, 16, 0}};
}

}  // namespace

std::span<const HardCase> alpha_cases() {
    static const HardCase cases[]{
        alpha_case("alpha-0", "Every second of 16 layers has alpha 0.", "16 layers; those of alpha 0 change no colour.",
                   alpha_zero),
        alpha_case("alpha-1", "Every second of 16 layers has alpha 1.",
                   "16 layers; nothing behind the first opaque one changes the colour.", alpha_one),
        alpha_case("alpha-tiny", "Every second of 16 layers has alpha 2^-24.",
                   "16 layers; those of tiny alpha change no 8-bit colour.", alpha_tiny),
        alpha_case("alpha-almost-1", "Every second of 16 layers has alpha 1 - 2^-24.",
                   "16 layers; what is behind the first of them changes no 8-bit colour.", almost_one),
        alpha_case("alpha-half-a-code", "Every second of 16 layers has alpha 1/510, half of an 8-bit code.",
                   "16 layers; those of half a code change a colour by less than a code each.", half_a_code),
        {.name = "alpha-0-alone",
         .hard = "All layers have alpha 0, so that a peel that looks at alpha finds nothing.",
         .answer = "Four layers, and the background's colour.",
         .build = alpha_zero_alone,
         .counts = {4096, 4, 4, 0}},
    };
    return cases;
}

}  // namespace strata::scenes::hard
