// tools/lab/hard_cases/hard_sweep.h - the sweep of hard cases: every selected case by every algorithm on every device
// and depth format.
//
// Rule     A row is a combination, in the order case, profile, depth format, algorithm; the last changes fastest. A
//          line has every key; values that a refused combination does not have are null.
// Tests    tests/tools/lab/hard_cases/hard_sweep_test.cpp
#pragma once
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "tools/lab/hard_cases/moves/hard_moved.h"
#include "tools/lab/sweep/sweep.h"

namespace strata::tools {

struct HardSweep {
    std::vector<const scenes::HardCase*> cases;
    std::vector<pipeline::DeviceProfile> profiles;
    std::vector<pipeline::DepthFormat> formats;
    std::vector<const peeling::Algorithm*> algorithms;
    bool moves = true;  // measure stability and flicker of the cases with is_moved (hard_moved.h)
};

// One line. The keys up to `moves` are known before the run.
[[nodiscard]] nlohmann::ordered_json to_line(const HardSweep& sweep, std::size_t number, const HardRow& row,
                                             const std::optional<MovedRow>& moved = {});

// Consecutive rows share the preparation of a case, profile and format. `sweep` must outlive the result.
[[nodiscard]] Sweep sweep_of(const HardSweep& sweep);

// One row per case with the number of its combinations per verdict; then every combination that failed or is unstable.
[[nodiscard]] std::string summary(const HardSweep& sweep, const Lines& lines);
// True if a line is failed or unstable.
[[nodiscard]] bool has_failed(const Lines& lines);

}  // namespace strata::tools
