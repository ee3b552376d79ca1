// pipeline/region/region_loop.h - a region's iterations, queries and termination, and the layers that it keeps. The
// frame's counterpart is executor.cpp.
//
// Source   pipeline/reference/execution.md 4; peeling/reference/keys-and-counts.md 3.
// Tests    tests/pipeline/region/executor_test.cpp, tests/peeling/execution/execution_test.cpp
#pragma once
#include "pipeline/frame/pass.h"

namespace strata::pipeline {

class Targets;
struct RegionShared;

class Loop {
  public:
    Loop(const RegionShared& shared, const Targets& targets) noexcept : shared_{shared}, targets_{targets} {}

    [[nodiscard]] bool any(Count count, Idle idle);
    void begin_iteration();
    void begin_loop();
    [[nodiscard]] bool limit_reached(int passes) const;
    void keep_layer(Target color, Target depth, Side side);
    void keep_no_layer(Target color, Target depth);

  private:
    const RegionShared& shared_;
    const Targets& targets_;
};

}  // namespace strata::pipeline
