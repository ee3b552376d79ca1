// tools/lab/cost/cost_run.h - measures one cell of `strata cost`: its error from the truth, its counted work, its
// times.
//
// Rule     Errors and counts depend on the cell alone. Times are those of a clock from the scene in memory to finished
//          pixels without audit, each round one of the default cell, one of this cell and one of it in literal
//          execution, in turn; literal execution once, related to every round's default, if that takes over 2 s. A time
//          is kept as its ratio to the default's of the same round. A cell has five rounds, and up to 25 while they
//          last under 2 s in all: another process takes turns of milliseconds, which a long run has many of and a short
//          one now and then.
// Tests    tests/tools/cost_test.cpp
#pragma once
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "peeling/truth/real_error.h"
#include "tools/lab/cost/cost_card.h"
#include "tools/lab/cost/cost_plan.h"
#include "tools/strata/render/run.h"

namespace strata::tools {

// A scene with what all its cells are measured against.
struct CostScene {
    std::string name;  // without its folder
    Session session;
    CostBase base;
    std::uint64_t vertices = 0;          // of the list
    peeling::RealImage truth, pictured;  // pictured: what the default cell shows
};

struct CostResult {
    std::string refusal;  // the sentence; empty: it ran
    peeling::RealError error;
    double from_default = 0;  // the share of pixels that differ from the default cell's picture
    std::optional<std::uint64_t> order_errors;
    int layers = 0;
    pipeline::PassCount passes;
    CardWork work;
    double modelled = 0;  // seconds
};

// Ratios to the default cell, one a round; empty where nothing was timed.
struct CostTimes {
    std::vector<double> seconds, ratios, literal;
};

// What a time is: as a user waits; or what all threads took of the processor, which other processes hardly change.
enum class CostClock : std::uint8_t { wall, processor };
[[nodiscard]] double seconds_on(CostClock clock);  // since some moment

struct CostTiming {
    int rounds = 0;  // exactly so many; 0: as many as the rule says
    CostClock clock = CostClock::wall;
};

[[nodiscard]] CostResult run_cell(const CostScene& scene, const CostCell& cell);
[[nodiscard]] CostTimes time_cell(const CostScene& scene, const CostCell& cell, const CostTiming& timing);

// Whether a cell that was timed in `done` rounds, `seconds` in all, is timed in another one.
[[nodiscard]] constexpr bool wants_round(int done, double seconds, int rounds) noexcept {
    constexpr int least = 5, most = 25;
    constexpr double enough = 2;
    if (rounds > 0) return done < rounds;
    return done < least || (done < most && seconds < enough);
}

// Renders the truth and the default cell of a scene whose session and base are there.
void complete(CostScene& scene);

// How many layers the deepest pixel has, as the audit counts them.
[[nodiscard]] int layers_of(const Session& session, const CostBase& base);

}  // namespace strata::tools
