// peeling/frame/make_frame.h - the pipeline's Frame for an algorithm and the options of a renderer.
//
// Rule     Defaults are those of pipeline/reference/devices.md 11.
// Tests    tests/peeling/comparison_test.cpp, frame/path_test.cpp
#pragma once
#include "peeling/frame/setup.h"
#include "pipeline/frame/frame.h"
#include "pipeline/frame/instruments.h"

namespace strata::peeling {

// Prepares and bins the lists that the algorithm draws. max_passes stays 0 (pass_limit.h). `setup` must outlive the
// frame.
[[nodiscard]] pipeline::Frame make_frame(const Algorithm& algorithm, FrameSetup& setup,
                                         const pipeline::Instruments& instruments);

}  // namespace strata::peeling
