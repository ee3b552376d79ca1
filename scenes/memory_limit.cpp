// scenes/memory_limit.cpp - reads what is free from /proc and from the control group (memory_limit.h).
#include "scenes/memory_limit.h"

#include <algorithm>
#include <atomic>
#include <fstream>
#include <sstream>

#include "rasterizer/base/input_error.h"

namespace strata::scenes {

namespace {

std::atomic<std::uint64_t> limit = 0, least_for_a_pixel = 0;  // 0: none
std::atomic<std::uint64_t> unchecked = 0;                     // bytes of needs for which the memory was not looked up

// Reads the value of a line "NAME:   123 kB" of a file in /proc, in bytes.
std::optional<std::uint64_t> kilobytes(const char* file, const std::string& name) {
    std::ifstream in(file);
    for (std::string line; std::getline(in, line);) {
        if (line.rfind(name, 0) != 0) continue;
        std::uint64_t value = 0;
        if (std::istringstream(line.substr(name.size())) >> value) return value << 10;
    }
    return std::nullopt;
}

std::optional<std::uint64_t> number_in(const char* file) {
    std::ifstream in(file);
    std::uint64_t value = 0;
    if (in >> value) return value;  // "max", which means no limit, is not a number
    return std::nullopt;
}

}  // namespace

void limit_memory(std::uint64_t bytes) noexcept { limit = bytes; }

void expect_for_a_pixel(std::uint64_t bytes) noexcept { least_for_a_pixel = bytes; }

std::uint64_t held_memory() { return kilobytes("/proc/self/status", "VmRSS:").value_or(0); }

std::optional<std::uint64_t> free_memory() {
    std::optional<std::uint64_t> free = kilobytes("/proc/meminfo", "MemAvailable:");
    const auto most = number_in("/sys/fs/cgroup/memory.max"), used = number_in("/sys/fs/cgroup/memory.current");
    if (most && used) free = std::min(free.value_or(~std::uint64_t{0}), *most - std::min(*most, *used));
    return free;
}

std::string memory_text(std::uint64_t bytes) {
    constexpr std::uint64_t megabyte = std::uint64_t{1} << 20, gigabyte = std::uint64_t{1} << 30;
    if (bytes < megabyte) return std::to_string(bytes) + " bytes";
    if (bytes < gigabyte) return std::to_string((bytes + megabyte - 1) / megabyte) + " MB";
    const std::uint64_t tenths = (bytes * 10 + gigabyte - 1) / gigabyte;
    return std::to_string(tenths / 10) + (tenths % 10 == 0 ? "" : "." + std::to_string(tenths % 10)) + " GB";
}

void check_memory_need(const std::string& file, const std::string& place, const NeededMemory& need) {
    const bool has_limit = limit > 0;
    const std::uint64_t step = std::uint64_t{has_limit ? 16u : 64u} << 20;
    if ((unchecked += need.bytes) < step) return;
    unchecked = 0;
    const auto free = has_limit ? std::optional{limit - std::min<std::uint64_t>(limit, held_memory())} : free_memory();
    if (!free || need.bytes <= *free) return;
    throw InputError(file, place,
                     need.kind + " at most " + memory_text(*free) +
                         (has_limit ? ", which --max-memory leaves" : ", which this computer has free"),
                     need.amount + " about " + memory_text(need.bytes));
}

void check_file_memory(const std::string& file, std::uint64_t bytes) {
    check_memory_need(
        file, "size",
        {.kind = "a file that takes", .amount = std::to_string(bytes) + " bytes, which take", .bytes = bytes});
}

// A number of two characters becomes a value of 16 bytes, in a vector that grows by copying.
void check_json_memory(const std::string& file, std::uint64_t bytes) {
    check_memory_need(file, "size",
                      {.kind = "JSON that takes",
                       .amount = std::to_string(bytes) + " bytes, which take",
                       .bytes = std::uint64_t{16} * bytes});
}

void check_pixels(const std::string& file, std::uint64_t width, std::uint64_t height, std::uint64_t bytes_a_pixel) {
    check_memory_need(file, "size",
                      {.kind = "a picture that takes",
                       .amount = std::to_string(width) + "x" + std::to_string(height) + ", which takes",
                       .bytes = width * height * std::max<std::uint64_t>(bytes_a_pixel, least_for_a_pixel)});
}

}  // namespace strata::scenes
