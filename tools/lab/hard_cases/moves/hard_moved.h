// tools/lab/hard_cases/moves/hard_moved.h - stability and flicker of a case on a device, for a line of a sweep.
//
// Rule     Both are measured for cases with is_moved, with the algorithms of is_moved. Flicker is measured for the
//          device's own depth path, and with front_to_back, whose result depends only on stored depths, for every depth
//          path of the device and for exact depths.
// Tests    tests/tools/lab/hard_cases/hard_flicker_test.cpp
#pragma once
#include <nlohmann/json.hpp>

#include "tools/lab/hard_cases/hard_run.h"
#include "tools/lab/hard_cases/moves/hard_flicker.h"

namespace strata::tools {

// True for dual, front_to_back, depth_units, shadow_map and weighted_average.
[[nodiscard]] bool is_moved(const peeling::Algorithm& algorithm);

struct MovedRow {
    StabilityRow stability;
    Flicker own;
    std::vector<std::pair<std::string, std::optional<Flicker>>> paths;  // by name; empty: refused
};

// The measurements of one case; exact answers are computed on first use.
class MovedCaseRenderer {
  public:
    explicit MovedCaseRenderer(const scenes::HardCase& hard) : moved_{hard}, path_{hard} {}
    // `row` is the algorithm's result for the unmoved case.
    [[nodiscard]] MovedRow run(const pipeline::DeviceProfile& profile, pipeline::DepthFormat depth,
                               const peeling::Algorithm& algorithm, const HardRow& row) const;

  private:
    MovedCase moved_;
    PathCase path_;
};

[[nodiscard]] nlohmann::ordered_json flicker_json(const MovedRow& row);

}  // namespace strata::tools
