// pipeline/frame/pass_log.h - the passes and queries of a run as they were decided, for whoever wants to see them.
//
// Rule     Every region logs by itself; the frame's log is theirs in the order of the regions, each as it ran last. So it does not
//          depend on threads, and literal execution, which has one region, logs the frame's passes once.
// Tests    tests/pipeline/region/pass_log_test.cpp
#pragma once
#include <vector>

#include "pipeline/frame/pass.h"

namespace strata::pipeline {

// One geometry pass of one region.
struct PassRecord {
    PassState state;
    rasterizer::FragmentNeeds needs;       // what is simulated
    rasterizer::FragmentNeeds called_for;  // what is under Effects::needed
    bool samples_textures = false;
    bool is_opaque_priming = false;
    int iteration = 0;  // 0: before the first
};

struct PassLog {
    std::vector<PassRecord> passes;
    int queries = 0;  // whose answer was asked for
};

}  // namespace strata::pipeline
