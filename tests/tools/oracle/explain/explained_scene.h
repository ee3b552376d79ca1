// tests/tools/oracle/explain/explained_scene.h - loads a scene by name with its default orbit, as the input of
// `explain`.
#pragma once
#include <string>

#include "peeling/frame_request.h"
#include "peeling/render.h"
#include "scenes/camera.h"
#include "scenes/scene.h"

namespace strata::testing {

struct ExplainedScene {
    scenes::Scene scene;
    pipeline::View view;
    peeling::RenderOptions options;
    [[nodiscard]] peeling::FrameRequest input(const char* profile) const {
        return {scene.list, view, *pipeline::find_profile(profile), options};
    }
};

[[nodiscard]] inline ExplainedScene explained_scene(const std::string& name, int columns, int rows) {
    ExplainedScene loaded{scenes::load_scene(name, {}), {}, {}};
    loaded.options.width = columns;
    loaded.options.height = rows;
    loaded.options.threads = 1;
    loaded.view = scenes::orbit_view(loaded.scene.bounds, 30, 20, static_cast<double>(columns) / rows);
    return loaded;
}

}  // namespace strata::testing
