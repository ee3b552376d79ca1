// scenes/memory_limit.h - the memory that the process may take, and a check of a picture's pixels before they are
// decoded.
//
// Rule     The limit is that of limit_memory(); without it, the free memory that the kernel estimates (MemAvailable of
//          /proc/meminfo), but at most the limit of the control group. There is no limit if the system reports neither.
// Tests    tests/tools/strata/render/max_memory_test.cpp
#pragma once
#include <cstdint>
#include <optional>
#include <string>

namespace strata::scenes {

// Sets the limit for the whole process, in bytes (--max-memory).
void limit_memory(std::uint64_t bytes) noexcept;
// Sets what the command needs for a pixel of a picture that it reads, in bytes, if that is more than its codes.
void expect_for_a_pixel(std::uint64_t bytes) noexcept;

// Bytes of memory that the process holds now; 0 if the system does not report it.
[[nodiscard]] std::uint64_t held_memory();
// Bytes of memory that the computer has free; empty if the system does not report it.
[[nodiscard]] std::optional<std::uint64_t> free_memory();
// "16.5 GB" or "300 MB", in units of 2^30 and 2^20 bytes, as the suffixes G and M of options.
[[nodiscard]] std::string memory_text(std::uint64_t bytes);

// InputError if a picture of that size, with so many bytes of codes in a pixel, takes more memory than is left.
void check_pixels(const std::string& file, std::uint64_t width, std::uint64_t height, std::uint64_t bytes_a_pixel);

}  // namespace strata::scenes
