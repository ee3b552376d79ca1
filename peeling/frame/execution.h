// peeling/frame/execution.h - decides how a frame runs: literally or in tiles, of which size, with which record.
//
// Rule     Literal: whole_frame algorithms; samples that may be left out; a count of passes or nodes across tiles; and
//          counters. Every way gives the same bits.
// Source   pipeline/reference/execution.md
// Tests    tests/peeling/frame/path_test.cpp
#pragma once
#include "peeling/algorithms/algorithm.h"
#include "peeling/render_options.h"
#include "pipeline/frame/frame.h"
#include "pipeline/frame/frame_result.h"
#include "pipeline/frame/instruments.h"

namespace strata::peeling {

[[nodiscard]] pipeline::Execution execution_of(const Algorithm& algorithm, const RenderOptions& options,
                                               const pipeline::Instruments& instruments);

// Why the frame ran as it did: the executor's reason, or one that the executor does not know.
[[nodiscard]] std::string reason_for(const pipeline::Work& work, const Algorithm& algorithm,
                                     const RenderOptions& options, const pipeline::Instruments& instruments);

// The record of fragments that passes read instead of rasterizing again. `compares_apart`: programs compare another
// depth than the stored one.
[[nodiscard]] pipeline::Replay replay_of(const Algorithm& algorithm, const RenderOptions& options, bool compares_apart);

}  // namespace strata::peeling
