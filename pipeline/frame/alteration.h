// pipeline/frame/alteration.h - deliberate changes of a run's steps, for a caller that wants to see the effect of a
// mistake.
//
// Rule     An altered run is literal: one region, one thread, every step in order. Before each step of the algorithm
//          the corresponding function is called; it may change the step, or return false to skip it. The emulator's own
//          work (opaque priming) is never altered.
// Tests    tests/pipeline/region/alteration_test.cpp
#pragma once
#include <cstdint>
#include <functional>
#include <string_view>

#include "pipeline/frame/pass.h"

namespace strata::pipeline {

class Region;

enum class PassKind : std::uint8_t { geometry, full_screen };

// A program's call for one batch of a pass.
struct ProgramCall {
    const PassState& state;
    PassKind kind{};
    FragmentBatch& in;
    const Loads& loads;
    Outputs& out;
};

// Empty functions change nothing.
struct Alteration {
    std::function<void(Target target, std::string_view name)> named{};
    std::function<bool(Region& region, Target& target, ClearValue& value)> clear{};
    std::function<bool(Region& region, Target& from, Target& to)> copy{};
    std::function<void(Region& region, PassState& state, PassKind kind)> pass{};
    // Called in place of the program for each batch; `run` executes the program itself.
    std::function<void(const ProgramCall& call, const std::function<void()>& run)> program{};
    // Called after a pass; `passed` fragments passed its tests.
    std::function<void(PassKind kind, std::uint64_t passed)> drawn{};
    // Returns the answer to a query; `count` is the queried count, `goes_on` the unaltered answer.
    std::function<bool(std::uint64_t count, bool goes_on)> query{};
};

}  // namespace strata::pipeline
