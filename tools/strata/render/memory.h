// tools/strata/render/memory.h - checks that there is enough memory for a picture, before it is rendered.
//
// Rule     The need is the sum of the memory that the program holds already, that the frame will need
//          (peeling/memory_need.h) and that the writer of its file will need. The limit is --max-memory; without it,
//          the machine's free memory (scenes/memory_limit.h).
// Tests    tests/tools/strata/render/max_memory_test.cpp
#pragma once
#include "tools/strata/options/options.h"
#include "tools/strata/render/run.h"

namespace strata::tools {

// Throws CLI::ValidationError, which names --max-memory, the need and the limit.
void check_memory(const RunOptions& options, const Session& session, const peeling::Algorithm& algorithm);

// The same for all algorithms, each of which is executed literally, over the whole frame.
void check_literal_memory(RunOptions options, const Session& session);

}  // namespace strata::tools
