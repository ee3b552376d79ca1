// tools/lab/hard_cases/hard_sweep.h - every chosen hard case by every algorithm on every device and depth format: the
// work of a sweep.
//
// Rule     A cell is a combination, in the order case, profile, depth format, algorithm; the last changes fastest. A
//          line has every key, null where a refused combination has nothing to say. Lines depend on neither threads,
//          shards nor interruptions (sweep.h).
// Tests    tests/tools/hard_cases/hard_sweep_test.cpp
#pragma once
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "tools/lab/hard_cases/hard_moved.h"
#include "tools/lab/sweep/sweep.h"

namespace strata::tools {

struct HardSweep {
    std::vector<const scenes::HardCase*> cases;
    std::vector<pipeline::DeviceProfile> profiles;
    std::vector<pipeline::DepthFormat> formats;
    std::vector<const peeling::Algorithm*> algorithms;
    bool moves = true;  // stability and flicker of the cases that name them (hard_moved.h)
};

// One line. The keys up to `moves` are known beforehand.
[[nodiscard]] nlohmann::ordered_json to_line(const HardSweep& sweep, std::size_t number, const HardRow& row,
                                             const std::optional<MovedRow>& moved = {});

// Cells one after the other share what is prepared for a case, profile and format. `sweep` must outlive it.
[[nodiscard]] Work hard_work(const HardSweep& sweep);

// What a page says: how often each verdict came, by case; every combination that failed or is unstable.
[[nodiscard]] Findings findings(const HardSweep& sweep, const Lines& lines);
// A row a case, how many combinations of it have which verdict; then every combination that failed or is unstable.
[[nodiscard]] std::string summary(const HardSweep& sweep, const Lines& lines);
// Whether one of them failed or is unstable.
[[nodiscard]] bool has_failed(const Lines& lines);

}  // namespace strata::tools
