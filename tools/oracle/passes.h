// tools/oracle/passes.h - every pass of an algorithm with all targets as it leaves them.
//
// Rule     The run is literal: its passes are the machine's. A pass is shown when it has ended and its queries are
//          answered; clears and copies before it are told with it. Targets have the names that the algorithm gives
//          them; of several of one name the second is NAME.1, and so on: a pair that is swapped keeps its names. Under
//          reversed depth, depth targets are shown as depths; colour targets that hold depths hold keys
//          (rasterizer/rules/depth_key.h). The last entry is what is published, the picture.
// Tests    tests/tools/oracle/passes_test.cpp
#pragma once
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "peeling/algorithms/algorithm.h"
#include "pipeline/frame/observer.h"
#include "tools/oracle/run_input.h"
#include "tools/oracle/target_parts.h"

namespace strata::pipeline {
struct Alteration;
}

namespace strata::oracle {

enum class PassKind : std::uint8_t { geometry, full_screen, published };
[[nodiscard]] std::string_view name(PassKind kind) noexcept;

struct Query {
    std::uint64_t count = 0;
    bool goes_on = false;
};

struct PassShown {
    int number = 0;  // from 0
    PassKind kind{};
    int iteration = 0;                  // 0: before the first
    std::vector<std::string> before{};  // "clear front", "copy opaque_depth to nearest"
    std::vector<std::string> reads{}, writes{};
    std::uint64_t passed = 0, tallied = 0;  // fragments behind all tests; events that the program counts
    std::vector<NamedImage> targets{};      // all that there are, the opaque scene's first
    std::vector<Query> queries{};           // about it, answered before the next pass
};

// `on_pass` is called with one pass after the other; it may keep the images. Throws Refused for what the profile lacks.
// `alteration` makes a machine with a mistake of it.
void passes(const RunInput& input, const peeling::Algorithm& algorithm, const std::function<void(PassShown&&)>& on_pass,
            const pipeline::Alteration* alteration = nullptr);

// Names of targets by their numbers, as observers hear them.
class TargetNames {
  public:
    void add(pipeline::Target target, std::string_view name);
    [[nodiscard]] std::string of(pipeline::Target target) const;

  private:
    std::vector<std::string> names_{"opaque_depth", "opaque_color"};
};

// Renders literally, without an audit, for an observer. Throws Refused.
void observe(const RunInput& input, const peeling::Algorithm& algorithm, const pipeline::Observer& observer,
             const pipeline::Alteration* alteration = nullptr);

}  // namespace strata::oracle
