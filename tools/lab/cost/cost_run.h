// tools/lab/cost/cost_run.h - measures one cell of `strata cost`: its error against the truth, its counted work, its
// times.
//
// Rule     Errors and counts depend on the cell alone. Times are measured from the scene in memory to finished pixels
//          without audit. A round times the default cell, this cell, and this cell in literal execution; if literal
//          execution takes over 2 s it is timed once, and compared with every round's default. A time is stored as its
//          ratio to the default's of the same round. A cell has five rounds, and up to 25 while they take less than 2 s
//          in total: other processes interrupt for milliseconds, which averages out in a long run but not in a short
//          one.
// Tests    tests/tools/lab/cost/cost_test.cpp
#pragma once
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "peeling/truth/real_error.h"
#include "pipeline/frame/counters.h"
#include "tools/lab/cost/cost_card.h"
#include "tools/lab/cost/cost_plan.h"
#include "tools/strata/render/run.h"

namespace strata::tools {

// A scene with the references for all of its cells.
struct CostScene {
    std::string name;  // without its folder
    Session session;
    CostBase base;
    std::uint64_t vertices = 0;          // of the draw list
    peeling::RealImage truth, pictured;  // pictured: the image of the default cell
};

struct CostResult {
    std::string refusal;  // the message; empty: it ran
    peeling::RealError error;
    // RMSE from the A-buffer of the cell's device and formats, which sorts the same fragments exactly; empty if the
    // device refuses the A-buffer.
    std::optional<double> sorted_rmse;
    double from_default = 0;  // the share of pixels that differ from the default cell's image
    std::optional<std::uint64_t> order_errors;
    int layers = 0;
    pipeline::PassCount passes;
    CardWork work;
    double modelled = 0;         // seconds
    double bytes_per_pixel = 0;  // of the algorithm's targets and buffers, beside the opaque scene's
};

// Ratios to the default cell, one per round; empty if nothing was timed.
struct CostTimes {
    std::vector<double> seconds, ratios, literal;
};

// The clock: wall-clock time, or the CPU time of all threads, which other processes hardly affect.
enum class CostClock : std::uint8_t { wall, processor };
[[nodiscard]] double seconds_on(CostClock clock);  // since an arbitrary start

struct CostTiming {
    int rounds = 0;  // the exact number; 0: by the rule above
    CostClock clock = CostClock::wall;
};

[[nodiscard]] CostResult run_cell(const CostScene& scene, const CostCell& cell);
[[nodiscard]] CostTimes time_cell(const CostScene& scene, const CostCell& cell, const CostTiming& timing);

// True if a cell that was timed in `done` rounds, `seconds` in total, needs another round.
[[nodiscard]] constexpr bool wants_round(int done, double seconds, int rounds) noexcept {
    constexpr int least = 5, most = 25;
    constexpr double enough = 2;
    if (rounds > 0) return done < rounds;
    return done < least || (done < most && seconds < enough);
}

// Renders the truth and the default cell of a scene whose session and base are set.
void complete(CostScene& scene);

// The number of layers of the deepest pixel, as counted by the audit.
[[nodiscard]] int layers_of(const Session& session, const CostBase& base);

}  // namespace strata::tools
