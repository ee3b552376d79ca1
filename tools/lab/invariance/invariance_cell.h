// tools/lab/invariance/invariance_cell.h - runs one cell of a sweep: scene, profile and view, then peeling::measure.
#pragma once
#include <map>
#include <optional>
#include <string>

#include "scenes/scene.h"
#include "tools/lab/invariance/invariance_plan.h"

namespace strata::tools {

// The camera of a cell, with what its line says about it.
struct CellView {
    pipeline::View view;
    double near = 0, far = 0;  // of the projection; 0 where it is the scene's own or a camera's
    int subpixel_bits = 0;     // of the device
    bool is_own = false;       // the view that the scene or a camera brings
};

// The outcome of one cell.
struct CellResult {
    CellView view;
    peeling::Measurement measured;
    std::string refusal;  // the sentence; empty: it ran
};

// Runs cells one after the other; not for several threads at once. Scenes and profiles are read
// once.
class CellRunner {
  public:
    CellRunner(scenes::SceneOptions scene_options, peeling::RenderOptions resources)
        : scene_options_{scene_options}, resources_{std::move(resources)} {}

    // A cell of hypothesis "all" is one of each that its profile leaves open, the profile's own first.
    [[nodiscard]] std::vector<Cell> expanded(const std::vector<Cell>& cells);
    // Reads what the cell names, so that a wrong name or file is told before anything runs. Throws InputError.
    void check(const Cell& cell);
    // The camera's if the cell names one; the scene's own view if it has one and the cell names no orbit; else the
    // orbit's, with the planes that the cell's range asks for.
    [[nodiscard]] CellView view(const Cell& cell);
    // Measures the cell. A profile that refuses it is told in the result.
    [[nodiscard]] CellResult run(const Cell& cell);

  private:
    [[nodiscard]] const scenes::Scene& scene(const std::string& name);
    [[nodiscard]] pipeline::DeviceProfile profile(const Cell& cell);
    // Null where an orbit or a camera is what the cell is seen from.
    [[nodiscard]] const pipeline::View* own_view(const Cell& cell);
    // The list that passes after the first draw; null: the scene's own list.
    [[nodiscard]] const pipeline::DrawList* split_list(const Cell& cell);

    scenes::SceneOptions scene_options_;
    peeling::RenderOptions resources_;  // threads, tile size, fragment memory: no bit depends on them
    std::map<std::string, scenes::Scene> scenes_;
    std::map<std::string, pipeline::View> own_views_;  // as the default clip convention has them
    std::map<std::string, pipeline::DrawList> splits_;
    std::map<std::string, pipeline::DeviceProfile> profiles_;
};

}  // namespace strata::tools
