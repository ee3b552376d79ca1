// tools/lab/hard_cases/hard_moved.h - stability and flicker of a case on a device: what stands in a sweep's line.
//
// Rule     Both are measured for cases that name them, by the algorithms of is_moved. Flicker stands there for the
//          device's own depth path, and with front_to_back for every depth path that the device has and for exact
//          depths: there nothing but stored depths decides.
// Tests    tests/tools/hard_cases/hard_flicker_test.cpp
#pragma once
#include <nlohmann/json.hpp>

#include "tools/lab/hard_cases/hard_flicker.h"
#include "tools/lab/hard_cases/hard_run.h"

namespace strata::tools {

// dual, front_to_back, depth_units, shadow_map and weighted_average.
[[nodiscard]] bool is_moved(const peeling::Algorithm& algorithm);

struct MovedRow {
    StabilityRow stability;
    Flicker own;
    std::vector<std::pair<std::string, std::optional<Flicker>>> paths;  // by name; none: refused
};

// The exact side of one case; what it is asked for first is computed then.
class MovedMachine {
  public:
    explicit MovedMachine(const scenes::HardCase& hard) : moved_{hard}, path_{hard} {}
    // `row` is what the algorithm left of the case as it is.
    [[nodiscard]] MovedRow run(const pipeline::DeviceProfile& profile, pipeline::DepthFormat depth,
                               const peeling::Algorithm& algorithm, const HardRow& row) const;

  private:
    MovedCase moved_;
    PathCase path_;
};

[[nodiscard]] nlohmann::ordered_json flicker_json(const MovedRow& row);

}  // namespace strata::tools
