// tests/faults/failing_memory.h - replaces operator new and oneTBB's allocator by functions that count requests and let
// a chosen one fail.
#pragma once
#include <cstdint>

namespace strata::test {

// Lets only the n-th request from now on fail with std::bad_alloc, n from 1; 0: none.
void fail_request(std::uint64_t n) noexcept;

// The number of requests since the last call of fail_request.
[[nodiscard]] std::uint64_t requests() noexcept;

// The number of blocks that are allocated and not freed.
[[nodiscard]] std::int64_t blocks_held() noexcept;

}  // namespace strata::test
