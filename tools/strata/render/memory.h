// tools/strata/render/memory.h - checks that there is enough memory for a picture, before it is rendered.
//
// Rule     The need is the sum of the memory that the program holds already, that the frame will need
//          (peeling/memory_need.h) and that the writer of its file will need. The limit is --max-memory; without it,
//          the free memory that the kernel estimates (MemAvailable of /proc/meminfo), but at most the limit of the
//          control group. There is no limit if the system reports neither.
// Tests    tests/tools/max_memory_test.cpp
#pragma once
#include <cstdint>

#include "tools/strata/options/options.h"
#include "tools/strata/render/run.h"

namespace strata::tools {

// Throws CLI::ValidationError, which names --max-memory, the need and the limit.
void check_memory(const RunOptions& options, const Session& session, const peeling::Algorithm& algorithm);

// Bytes of memory that the program holds now; 0 if the system does not report it.
[[nodiscard]] std::uint64_t held_memory();

// Bytes of memory that the machine has free; empty if the system does not report it.
[[nodiscard]] std::optional<std::uint64_t> free_memory();

}  // namespace strata::tools
