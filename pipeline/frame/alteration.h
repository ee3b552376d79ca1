// pipeline/frame/alteration.h - what a run does otherwise than its algorithm says: a deliberate mistake, for a caller
// that wants to know what it looks like.
//
// Rule     An altered run is literal: one region, one thread, every step in order. Before each step of the algorithm
//          its function is asked, which may change the step, or answer false to leave it out. The emulator's own work
//          (opaque priming) is never altered.
// Tests    tests/pipeline/region/alteration_test.cpp
#pragma once
#include <cstdint>
#include <functional>
#include <string_view>

#include "pipeline/frame/pass.h"

namespace strata::pipeline {

class Region;

enum class PassKind : std::uint8_t { geometry, full_screen };

// One batch of a pass on its way through the pass's program.
struct ProgramCall {
    const PassState& state;
    PassKind kind{};
    FragmentBatch& in;
    const Loads& own;
    Outputs& out;
};

// Empty functions change nothing.
struct Alteration {
    std::function<void(Target target, std::string_view name)> named{};
    std::function<bool(Region& region, Target& target, ClearValue& value)> clear{};
    std::function<bool(Region& region, Target& from, Target& to)> copy{};
    std::function<void(Region& region, PassState& state, PassKind kind)> pass{};
    // Stands in for the program, and calls `run` where the program itself shall run.
    std::function<void(const ProgramCall& call, const std::function<void()>& run)> program{};
    // A pass has ended, and `passed` fragments got through its tests.
    std::function<void(PassKind kind, std::uint64_t passed)> drawn{};
    // The answer to a query that asks about `count`.
    std::function<bool(std::uint64_t count, bool goes_on)> query{};
};

}  // namespace strata::pipeline
