// tools/strata/invariance/invariance_cell.h - runs one cell of a sweep: scene, profile and view, then peeling::measure.
#pragma once
#include <map>
#include <optional>
#include <string>

#include "scenes/scene.h"
#include "tools/strata/invariance/invariance_plan.h"

namespace strata::tools {

struct CellView {
    pipeline::View view;
    double near = 0, far = 0;  // of the projection
    int subpixel_bits = 0;     // of the device
};

struct CellResult {
    CellView view;
    peeling::Measurement measured;
    std::string refusal;  // the sentence; empty: it ran
};

// Scenes and profiles are read once.
class CellRunner {
  public:
    CellRunner(scenes::SceneOptions scene_options, peeling::RenderOptions resources)
        : scene_options_{scene_options}, resources_{std::move(resources)} {}

    // A cell of hypothesis "all" is one of each that its profile leaves open, the profile's own first.
    [[nodiscard]] std::vector<Cell> expanded(const std::vector<Cell>& cells);
    // Reads what the cell names, so that a wrong name or file is told before anything runs. Throws InputError.
    void check(const Cell& cell);
    [[nodiscard]] CellView view(const Cell& cell);
    [[nodiscard]] CellResult run(const Cell& cell);

  private:
    [[nodiscard]] const scenes::Scene& scene(const std::string& name);
    [[nodiscard]] pipeline::DeviceProfile profile(const Cell& cell);
    [[nodiscard]] const pipeline::DrawList* split_list(const Cell& cell);  // null: the scene's own

    scenes::SceneOptions scene_options_;
    peeling::RenderOptions resources_;  // threads, tile size, fragment memory: no bit depends on them
    std::map<std::string, scenes::Scene> scenes_;
    std::map<std::string, pipeline::DrawList> splits_;
    std::map<std::string, pipeline::DeviceProfile> profiles_;
};

}  // namespace strata::tools
