// tools/lab/cost/cost_plan.h - the cells of `strata cost`: every knob that trades accuracy for work, one at a time from
// the defaults.
//
// Rule     reports.md 10.1 lists the knobs and their values. Depth format times path, and algorithm or number of peels
//          times colour format, are products. What a knob asks for and the profile lacks is opened on a copy of it, and
//          named. Cells are numbered scene by scene, knob by knob.
// Tests    tests/tools/cost_test.cpp
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
    std::size_t scene = 0;    // in the list of scenes
    std::string knob, value;  // value: the words that follow the knob in a sentence
    std::string opened;       // what the profile got for it; empty: nothing
    pipeline::DeviceProfile profile;
    peeling::RenderOptions options;
    const peeling::Algorithm* algorithm = nullptr;
    std::optional<peeling::Chain> chain{};  // a picture of the chain, which no machine draws and no run times
    bool is_timed_with_audit = false;
};

// The cell that all others are a step away from.
struct CostBase {
    std::size_t scene = 0;
    pipeline::DeviceProfile profile;
    peeling::RenderOptions options;
    const peeling::Algorithm* algorithm = nullptr;
    int layers = 0;  // of the deepest pixel
};

// In the order of the plan; "default" is always there.
[[nodiscard]] const std::vector<std::string>& cost_knobs();

// The cells of one scene; `knobs` names those that are wanted.
[[nodiscard]] std::vector<CostCell> cost_cells(const CostBase& base, const std::vector<std::string>& knobs);

// Passes that a knob of peels tries: all up to 8, then every 1.5 times as many, and the last.
[[nodiscard]] std::vector<int> peel_steps(int all);

}  // namespace strata::tools
