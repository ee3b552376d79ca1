// tools/strata/render/memory.h - is there memory for a picture? Asked before it is drawn.
//
// Rule     What a run takes is what the program holds already, what its frame will (peeling/memory_need.h) and what the
//          writer of its file will. The limit is --max-memory, or without it what the machine has free: the kernel's
//          own estimate (MemAvailable of /proc/meminfo), and no more than the control group allows. A machine that
//          tells neither has no limit.
// Tests    tests/tools/max_memory_test.cpp
#pragma once
#include <cstdint>

#include "tools/strata/options/options.h"
#include "tools/strata/render/run.h"

namespace strata::tools {

// Throws CLI::ValidationError that names --max-memory, what is needed and what there is.
void check_memory(const RunOptions& options, const Session& session, const peeling::Algorithm& algorithm);

// Bytes of memory that the program holds by now; 0 where the system does not tell.
[[nodiscard]] std::uint64_t held_memory();

// Bytes that the machine can still give; nothing where the system does not tell.
[[nodiscard]] std::optional<std::uint64_t> free_memory();

}  // namespace strata::tools
