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
    const auto limit = number_in("/sys/fs/cgroup/memory.max"), used = number_in("/sys/fs/cgroup/memory.current");
    if (limit && used) free = std::min(free.value_or(~std::uint64_t{0}), *limit - std::min(*limit, *used));
    return free;
}

std::string memory_text(std::uint64_t bytes) {
    constexpr std::uint64_t megabyte = std::uint64_t{1} << 20, gigabyte = std::uint64_t{1} << 30;
    if (bytes < gigabyte) return std::to_string((bytes + megabyte - 1) / megabyte) + " MB";
    const std::uint64_t tenths = (bytes * 10 + gigabyte - 1) / gigabyte;
    return std::to_string(tenths / 10) + (tenths % 10 == 0 ? "" : "." + std::to_string(tenths % 10)) + " GB";
}

void check_pixels(const std::string& file, std::uint64_t width, std::uint64_t height, std::uint64_t bytes_a_pixel) {
    const bool has_limit = limit > 0;
    const std::uint64_t need = width * height * std::max<std::uint64_t>(bytes_a_pixel, least_for_a_pixel);
    constexpr std::uint64_t surely_enough = std::uint64_t{64} << 20;
    if (!has_limit && need < surely_enough) return;
    const auto free = has_limit ? std::optional{limit - std::min<std::uint64_t>(limit, held_memory())} : free_memory();
    if (!free || need <= *free) return;
    throw InputError(file, "size",
                     "a picture that takes at most " + memory_text(*free) +
                         (has_limit ? ", which --max-memory leaves" : ", which this computer has free"),
                     std::to_string(width) + "x" + std::to_string(height) + ", which takes about " + memory_text(need));
}

}  // namespace strata::scenes
