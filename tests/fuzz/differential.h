// tests/fuzz/differential.h - every way of running a frame against the first one, and the smallest case that still
// differs.
//
// Rule     Nothing that a user sees depends on execution, instruction set, tile size, effects or fragment memory.
// Tests    A difference is printed as a reduced case with the bytes that made it.
#pragma once
#include <iosfwd>
#include <string>

#include "tests/fuzz/frame_case.h"

namespace strata::fuzz {

[[nodiscard]] peeling::RenderResult run(const FrameCase& frame, const Way& way);

// Which way differs from the first, and in what; empty if none does.
[[nodiscard]] std::string first_difference(const FrameCase& frame);

// Without the triangles, state and ways that the difference does not need.
[[nodiscard]] FrameCase reduced(FrameCase frame);

// True if every way agrees, on up to `threads` threads; else prints the difference, the reduced case and the bytes.
[[nodiscard]] bool check(std::span<const std::uint8_t> bytes, std::ostream& out, int threads = 1);

}  // namespace strata::fuzz
