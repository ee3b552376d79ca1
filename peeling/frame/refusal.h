// peeling/frame/refusal.h - the first reason why a profile cannot run a frame.
//
// Rule     In the order of pipeline/reference/devices.md 9.2: samples, lines and points, size, depth, formats, order,
//          shading, layers, the algorithm's features.
// Tests    tests/peeling/frame/refusals_test.cpp
#pragma once
#include "peeling/frame/setup.h"
#include "pipeline/device/check.h"

namespace strata::peeling {

// Empty if the frame can run.
[[nodiscard]] std::optional<pipeline::Refusal> refusal_of(const Algorithm& algorithm, const FrameSetup& setup);
// The same for a depth pass, which stores only depth.
[[nodiscard]] std::optional<pipeline::Refusal> refusal_of_depth_pass(const Algorithm& one_pass,
                                                                     const FrameSetup& setup);

}  // namespace strata::peeling
