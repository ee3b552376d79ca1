// tools/strata/diagnose/diagnose_samples.h - strata diagnose --samples N: which known mistake of multisampling made a
// resolved picture.
//
// Tests    tests/tools/diagnose_samples_test.cpp
#pragma once
#include "tools/oracle/picture.h"
#include "tools/strata/render/run.h"

namespace strata::tools {

// The candidate's colours are compared with the right picture, and with the picture of each mistake that applies, code
// by code. Prints what was found; the exit status: 0 right, 1 a mistake, known or not.
[[nodiscard]] int diagnose_samples(const RunOptions& options, const Session& session, const oracle::Picture& candidate,
                                   bool json);

}  // namespace strata::tools
