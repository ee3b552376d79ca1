// tests/faults/failing_memory.h - memory that runs out when a test says so: operator new and oneTBB's allocator,
// counted and failed.
#pragma once
#include <cstdint>

namespace strata::test {

// The `n`-th request from now on, n from 1, throws std::bad_alloc, and no other one; 0: none.
void fail_request(std::uint64_t n) noexcept;

// How many requests there were since fail_request was last called.
[[nodiscard]] std::uint64_t requests() noexcept;

// Blocks that were taken and not given back.
[[nodiscard]] std::int64_t blocks_held() noexcept;

}  // namespace strata::test
