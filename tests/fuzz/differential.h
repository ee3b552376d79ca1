// tests/fuzz/differential.h - compares every way of running a frame with the first one, and reduces a case that
// differs.
//
// Rule     Results do not depend on execution, instruction set, tile size, effects or fragment memory.
// Tests    A difference is printed as a reduced case with the bytes that made it.
#pragma once
#include <iosfwd>
#include <string>

#include "tests/fuzz/frame_case.h"

namespace strata::fuzz {

[[nodiscard]] peeling::RenderResult run(const FrameCase& frame, const ExecutionWay& way);

// Name of the first way that differs and of the result that differs; empty if all are equal.
[[nodiscard]] std::string first_difference(const FrameCase& frame);

// The frame without triangles, state and ways that the difference does not need.
[[nodiscard]] FrameCase reduced(FrameCase frame);

// True if every way agrees, on up to `threads` threads; else prints the difference, the reduced case and the bytes.
[[nodiscard]] bool check(std::span<const std::uint8_t> bytes, std::ostream& out, int threads = 1);

}  // namespace strata::fuzz
