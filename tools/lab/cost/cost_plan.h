// tools/lab/cost/cost_plan.h - the cells of `strata cost`: every option that trades accuracy for work, changed one at a
// time from the defaults.
//
// Rule     scenes/reference/reports.md 10.1 lists the knobs and their values. Depth format and path, and algorithm or
//          number of peels and colour format, are combined. A feature that a knob needs and the profile lacks is
//          enabled in a copy of the profile, and reported. Cells are numbered scene by scene, knob by knob.
// Tests    tests/tools/lab/cost/cost_test.cpp
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "peeling/registry.h"
#include "peeling/render_options.h"
#include "peeling/truth/chain.h"
#include "pipeline/device/profile.h"

namespace strata::tools {

struct CostCell {
    std::size_t scene = 0;    // index in the list of scenes
    std::string knob, value;  // value: the text that follows the knob in a sentence
    std::string opened;       // the feature enabled in the profile; empty: none
    pipeline::DeviceProfile profile;
    peeling::RenderOptions options;
    const peeling::Algorithm* algorithm = nullptr;
    std::optional<peeling::Chain> chain{};  // for an image computed by a chain, which has no run time
    bool is_timed_with_audit = false;
};

// The default cell, from which all others differ in one step.
struct CostBase {
    std::size_t scene = 0;
    pipeline::DeviceProfile profile;
    peeling::RenderOptions options;
    const peeling::Algorithm* algorithm = nullptr;
    int layers = 0;  // of the pixel that has the most
};

// In the order of the plan; "default" is always included.
[[nodiscard]] const std::vector<std::string>& cost_knobs();

// The cells of one scene; `knobs` are the requested ones.
[[nodiscard]] std::vector<CostCell> cost_cells(const CostBase& base, const std::vector<std::string>& knobs);

// The pass counts that the knob of peels tries: all up to 8, then each 1.5 times the previous one, and the last.
[[nodiscard]] std::vector<int> peel_steps(int all);

}  // namespace strata::tools
