// tests/tools/oracle/verdict/opened_scene.h - loads a scene with a view, a profile and options, and renders pictures of
// it.
#pragma once
#include <string>

#include "peeling/registry.h"
#include "peeling/render.h"
#include "pipeline/device/profile.h"
#include "scenes/camera.h"
#include "scenes/scene.h"
#include "tools/oracle/fragments/fragments.h"
#include "tools/oracle/fragments/sample.h"
#include "tools/oracle/picture/picture.h"
#include "tools/oracle/verdict/verdict.h"

namespace strata::test {

struct OpenedScene {
    scenes::Scene scene;
    pipeline::View view;
    pipeline::DeviceProfile profile = *pipeline::find_profile("geforce8");
    peeling::RenderOptions options{};
    bool is_linear = false;

    explicit OpenedScene(const std::string& name, int width, int height) : scene{scenes::load_scene(name, {})} {
        options.width = width;
        options.height = height;
        options.background = {0.2f, 0.3f, 0.5f, 1};
        view = scene.own_view.value_or(scenes::orbit_view(scene.bounds, 30, 20, double(width) / height));
    }
    // Loads the scene again with decoded colours.
    void open_linear(const std::string& name) {
        scene = scenes::load_scene(name, {.color_space = pipeline::ColorSpace::linear});
        is_linear = true;
    }
    [[nodiscard]] peeling::FrameRequest input() const { return {scene.list, view, profile, options}; }
    [[nodiscard]] oracle::verdict::SceneFragments fragments() const {
        return oracle::verdict::SceneFragments{input(), std::uint64_t{1} << 30};
    }
    // Empty if the profile lacks a feature.
    [[nodiscard]] std::optional<oracle::TargetImage> picture(const std::string& algorithm,
                                                             pipeline::Format format) const {
        peeling::RenderOptions chosen = options;
        chosen.color_format = format;
        chosen.audit = false;
        peeling::RenderResult result =
            peeling::Renderer{scene.list, view, profile, chosen}.render(*peeling::find_algorithm(algorithm));
        if (result.refusal) return std::nullopt;
        return oracle::as_target(result.frame.color, "color");
    }
};

// The verdict on a picture of the scene.
[[nodiscard]] inline oracle::verdict::Verdict judged(const OpenedScene& opened, const oracle::TargetImage& picture) {
    oracle::verdict::SceneFragments fragments = opened.fragments();
    return judge(fragments, oracle::verdict::Colors{picture});
}

}  // namespace strata::test
