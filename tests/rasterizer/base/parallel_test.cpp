// Tests parallel loops against a plain loop; each index writes to its own element.
#include "rasterizer/base/parallel.h"

#include <sys/resource.h>

#include <atomic>
#include <bit>
#include <catch2/catch.hpp>
#include <fstream>
#include <new>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "rasterizer/base/exact_sum.h"
#include "rasterizer/base/input_error.h"
#include "rasterizer/base/thread_loop.h"
#include "rasterizer/base/uninitialized.h"

TEST_CASE("a parallel loop visits every index once for any count and number of threads") {
    std::size_t wrong = 0;
    for (const int threads : {0, 1, 2, 3, 7})
        for (const std::size_t count :
             {std::size_t{0}, std::size_t{1}, std::size_t{2}, std::size_t{5}, std::size_t{1000}}) {
            std::vector<int> visits(count + 1, 0);
            strata::parallel_for(count, threads, [&](std::size_t i) { ++visits[i]; });
            for (std::size_t i = 0; i < count; ++i) wrong += visits[i] != 1 ? 1 : 0;
            wrong += visits[count] != 0 ? 1 : 0;
        }
    CHECK(wrong == 0);
}

TEST_CASE("a loop inside a loop visits every pair once") {
    std::vector<int> visits(40 * 30, 0);
    strata::parallel_for(
        40, 2, [&](std::size_t i) { strata::parallel_for(30, 2, [&, i](std::size_t k) { ++visits[30 * i + k]; }); });
    CHECK(visits == std::vector<int>(40 * 30, 1));
}

TEST_CASE("an exception of a body reaches the caller with its message from one thread or several") {
    for (const int threads : {1, 2}) {
        std::string words;
        try {
            strata::parallel_for(100, threads, [](std::size_t i) {
                if (i == 42) throw std::runtime_error{"index 42"};
            });
        } catch (const std::runtime_error& error) {
            words = error.what();
        }
        CHECK(words == "index 42");
    }
}

TEST_CASE("a loop whose bodies use up all memory ends with an exception in the caller") {
    const auto nothing = [](std::size_t) {};
    strata::parallel_for(8, 2, nothing);  // starts the threads
    std::size_t pages = 0;
    std::ifstream{"/proc/self/statm"} >> pages;
    rlimit limit{};
    REQUIRE((pages > 0 && getrlimit(RLIMIT_AS, &limit) == 0));
    if (pages > std::size_t{1} << 28) return;  // the address space of a sanitizer, which has no such limit
    const rlimit before = limit;
    limit.rlim_cur = pages * 4096 + (std::size_t{8} << 20);
    REQUIRE(setrlimit(RLIMIT_AS, &limit) == 0);
    struct Block {
        Block* next;
    };
    std::atomic<Block*> blocks = nullptr;
    const auto take_all = [&](std::size_t size) {
        try {
            for (;;) {
                auto* const block = new (strata::take_memory(size)) Block{blocks};
                while (!blocks.compare_exchange_weak(block->next, block)) {
                }
            }
        } catch (const std::bad_alloc&) {
        }
    };
    bool is_thrown = false;
    try {
        strata::parallel_for(64, 2, [&](std::size_t) {
            for (const std::size_t size : {std::size_t{1} << 16, std::size_t{1} << 10, sizeof(Block)}) take_all(size);
            throw std::bad_alloc{};
        });
    } catch (const std::bad_alloc&) {
        is_thrown = true;
    }
    setrlimit(RLIMIT_AS, &before);
    for (Block* block = blocks; block != nullptr;) strata::give_memory(std::exchange(block, block->next));
    CHECK(is_thrown);
    strata::parallel_for(8, 2, nothing);
}

TEST_CASE("a number of threads is used unchanged and 0 means that of the machine which is at least one") {
    CHECK(strata::thread_count(0) >= 1);
    CHECK(strata::thread_count(1) == 1);
    // A build without threads has one, whatever number is requested.
    const bool is_serial = strata::thread_count(2) == 1;
    for (const int n : {2, 3, 64}) CHECK(strata::thread_count(n) == (is_serial ? 1 : n));
}

TEST_CASE("a loop on system threads visits every index once and its first exception reaches the caller") {
    std::size_t wrong = 0;
    for (const int threads : {1, 2, 5})
        for (const std::size_t count : {std::size_t{0}, std::size_t{1}, std::size_t{3}, std::size_t{1000}}) {
            std::vector<int> visits(count, 0);
            strata::thread_loop(count, threads, [&](std::size_t i) { ++visits[i]; });
            for (const int n : visits) wrong += n != 1 ? 1 : 0;
        }
    CHECK(wrong == 0);
    for (const int threads : {1, 3})
        CHECK_THROWS_WITH(strata::thread_loop(100, threads,
                                              [](std::size_t i) {
                                                  if (i == 42) throw std::runtime_error{"index 42"};
                                              }),
                          "index 42");
}

TEST_CASE("the available threads are as many as requested if the system has them and otherwise fewer") {
    CHECK(strata::available_threads(0, 1 << 20) == 0);
    CHECK(strata::available_threads(3, 1 << 20) == 3);
    // No address space has room for a stack of 2^62 bytes.
    CHECK(strata::available_threads(3, std::size_t{1} << 62) == 0);
}

TEST_CASE("an input error is one message with file and place and what was expected and found") {
    const strata::InputError error{"a.glb", "/accessors/3", "a multiple of 4", "1026"};
    CHECK(std::string{error.what()} == "a.glb: /accessors/3: expected a multiple of 4, found 1026");
}

TEST_CASE(
    "a vector without initial values keeps written ones when it grows or is copied or moved and can be initialised") {
    strata::UninitializedVector<std::uint32_t> numbers(1000);
    for (std::uint32_t i = 0; i < 1000; ++i) numbers[i] = i * i;
    numbers.resize(5000);
    for (std::uint32_t i = 1000; i < 5000; ++i) numbers[i] = i * i;
    const auto copy = numbers;
    const auto moved = std::move(numbers);
    std::size_t wrong = 0;
    for (std::uint32_t i = 0; i < 5000; ++i) wrong += copy[i] != i * i || moved[i] != i * i ? 1 : 0;
    CHECK(wrong == 0);
    CHECK(copy == moved);
    const strata::UninitializedVector<std::uint32_t> sevens(300, 7u);
    CHECK(std::vector(sevens.begin(), sevens.end()) == std::vector<std::uint32_t>(300, 7));
    strata::UninitializedVector<double> pushed;
    for (int i = 0; i < 100; ++i) pushed.push_back(i / 2.0);
    CHECK(pushed[99] == 49.5);
}

TEST_CASE("a number of elements whose bytes exceed 64 bits is rejected before memory is allocated") {
    strata::UninitializedAllocator<std::uint64_t> allocator;
    CHECK_THROWS_AS(static_cast<void>(allocator.allocate(static_cast<std::size_t>(-1) / 8 + 1)),
                    std::bad_array_new_length);
    CHECK(allocator == strata::UninitializedAllocator<std::uint64_t>{});
}

TEST_CASE("a 64-bit integer is one binary64 number up to 2^53 and beyond it two that add up to it") {
    using strata::rasterizer::as_terms;
    constexpr std::int64_t edge = std::int64_t{1} << 53;
    std::size_t wrong = 0;
    for (const std::int64_t centre : {std::int64_t{0}, edge, -edge, edge * 16, -edge * 512})
        for (std::int64_t n = centre - 3; n <= centre + 3; ++n) {
            const auto [high, low] = as_terms(n);
            wrong += static_cast<std::int64_t>(high) + static_cast<std::int64_t>(low) != n ? 1 : 0;
            wrong += n >= -edge && n <= edge && low != 0.0 ? 1 : 0;
        }
    CHECK(wrong == 0);
    using strata::rasterizer::split;
    for (const double v : {1.0, 1 + 0x1p-52, -0x1.fffffffffffffp100, 0x1.5555555555555p-30}) {
        const auto [high, low] = split(v);
        CHECK(high + low == v);
        for (const double part : {high, low})  // 26 of 53 bits each, so their products are exact
            CHECK((std::bit_cast<std::uint64_t>(part) & 0x7ffffff) == 0);
    }
}
