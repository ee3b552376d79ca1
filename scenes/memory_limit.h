// scenes/memory_limit.h - the memory that the process may take, and the check that every reader and generator makes
// before it allocates memory for files, pixels, texels, vertices and triangles.
//
// Rule     The limit is that of limit_memory(); without it, the free memory that the kernel estimates (MemAvailable of
//          /proc/meminfo), but at most the limit of the control group. There is no limit if the system reports neither.
//          The needs are added up, and the memory is looked up once they reach 16 MB, or 64 MB without limit_memory().
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
// "16.5 GB", "300 MB" or "10 bytes", in units of 2^30 and 2^20 bytes, as the suffixes G and M of options.
[[nodiscard]] std::string memory_text(std::uint64_t bytes);

// A need of memory, as in "render.raw: size: expected a file that takes at most 12 MB, which --max-memory leaves, found
// 4294967296 bytes, which take about 4 GB".
struct NeededMemory {
    std::string kind;    // "a file that takes"
    std::string amount;  // "4294967296 bytes, which take"
    std::uint64_t bytes = 0;
};
// InputError with file and place if more memory is needed than is left. Called before the allocation.
void check_memory_need(const std::string& file, const std::string& place, const NeededMemory& need);
// The same for a file, and for the values of a JSON text, of so many bytes.
void check_file_memory(const std::string& file, std::uint64_t bytes);
void check_json_memory(const std::string& file, std::uint64_t bytes);

// The same for a picture with so many bytes of codes in a pixel.
void check_pixels(const std::string& file, std::uint64_t width, std::uint64_t height, std::uint64_t bytes_a_pixel);

}  // namespace strata::scenes
