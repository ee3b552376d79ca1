// tools/lab/invariance/invariance_cell.h - runs one cell of a sweep: scene, profile and view, then peeling::measure.
#pragma once
#include <map>
#include <optional>
#include <string>

#include "scenes/scene.h"
#include "tools/lab/invariance/invariance_plan.h"

namespace strata::tools {

// The camera of a cell, and the data about it for the cell's line.
struct CellView {
    pipeline::View view;
    double near = 0, far = 0;  // of the projection; 0 if it is the scene's own or a camera's
    int subpixel_bits = 0;     // of the device
    bool is_own = false;       // the view comes from the scene or a camera
};

// The outcome of one cell.
struct CellResult {
    CellView view;
    peeling::Measurement measured;
    std::string refusal;  // the message; empty: it ran
};

// Runs cells one after another; not thread-safe. Scenes and profiles are read once.
class CellRunner {
  public:
    CellRunner(scenes::SceneOptions scene_options, peeling::RenderOptions resources)
        : scene_options_{scene_options}, resources_{std::move(resources)} {}

    // A cell of hypothesis "all" is expanded to one cell per alternative of its profile, the profile's own first.
    [[nodiscard]] std::vector<Cell> expanded(const std::vector<Cell>& cells);
    // Reads the files that the cell names, so that a wrong name or file is reported before anything runs. Throws
    // InputError.
    void check(const Cell& cell);
    // The view of the cell's camera, if any; else the scene's own view, if it has one and the cell specifies no orbit;
    // else the orbit's, with the planes of the cell's range.
    [[nodiscard]] CellView view(const Cell& cell);
    // Measures the cell. If the profile refuses it, the result has a refusal.
    [[nodiscard]] CellResult run(const Cell& cell);

  private:
    [[nodiscard]] const scenes::Scene& scene(const std::string& name);
    [[nodiscard]] pipeline::DeviceProfile profile(const Cell& cell);
    // Null if the cell uses an orbit or a camera.
    [[nodiscard]] const pipeline::View* own_view(const Cell& cell);
    // The list that passes after the first draw; null: the scene's own list.
    [[nodiscard]] const pipeline::DrawList* split_list(const Cell& cell);

    scenes::SceneOptions scene_options_;
    peeling::RenderOptions resources_;  // threads, tile size, fragment memory: results do not depend on them
    std::map<std::string, scenes::Scene> scenes_;
    std::map<std::string, pipeline::View> own_views_;  // in the default clip convention
    std::map<std::string, pipeline::DrawList> splits_;
    std::map<std::string, pipeline::DeviceProfile> profiles_;
};

}  // namespace strata::tools
