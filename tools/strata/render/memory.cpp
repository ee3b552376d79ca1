#include "tools/strata/render/memory.h"

#include <algorithm>
#include <fstream>
#include <sstream>

#include "peeling/memory_need.h"

namespace strata::tools {

namespace {

// Bytes per pixel that a file writer allocates for a frame with one colour and one depth: the codes as numbers, and
// OpenEXR's buffers.
constexpr std::uint64_t png_bytes_a_pixel = 36, exr_bytes_a_pixel = 28;

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

std::uint64_t writer_bytes(const RunOptions& options) {
    const std::uint64_t pixels =
        std::uint64_t{static_cast<unsigned>(options.render.width)} * static_cast<unsigned>(options.render.height);
    if (options.output.ends_with(".png")) return pixels * png_bytes_a_pixel;
    if (options.output.ends_with(".exr")) return pixels * exr_bytes_a_pixel;
    return 0;
}

// True if the limit is above the needs of any algorithm that keeps no layers, so that the exact estimate can be
// skipped.
bool is_surely_enough(const RunOptions& options, std::uint64_t limit, std::uint64_t held) {
    constexpr std::uint64_t most_bytes_a_pixel = 512;
    const std::uint64_t pixels =
        std::uint64_t{static_cast<unsigned>(options.render.width)} * static_cast<unsigned>(options.render.height);
    const auto samples = static_cast<std::uint64_t>(options.samples);
    const std::uint64_t most =
        (1 + samples) * held + samples * pixels * most_bytes_a_pixel + 2 * options.render.fragment_memory;
    return !options.max_memory && !options.render.keep_layers && most < limit;
}

// Formats as "16.5 GB" or "300 MB", in units of 2^30 and 2^20 bytes, the same as the suffixes G and M of options.
std::string in_words(std::uint64_t bytes) {
    constexpr std::uint64_t megabyte = std::uint64_t{1} << 20, gigabyte = std::uint64_t{1} << 30;
    if (bytes < gigabyte) return std::to_string((bytes + megabyte - 1) / megabyte) + " MB";
    const std::uint64_t tenths = (bytes * 10 + gigabyte - 1) / gigabyte;
    return std::to_string(tenths / 10) + (tenths % 10 == 0 ? "" : "." + std::to_string(tenths % 10)) + " GB";
}

}  // namespace

std::uint64_t held_memory() { return kilobytes("/proc/self/status", "VmRSS:").value_or(0); }

std::optional<std::uint64_t> free_memory() {
    std::optional<std::uint64_t> free = kilobytes("/proc/meminfo", "MemAvailable:");
    const auto limit = number_in("/sys/fs/cgroup/memory.max"), used = number_in("/sys/fs/cgroup/memory.current");
    if (limit && used) free = std::min(free.value_or(~std::uint64_t{0}), *limit - std::min(*limit, *used));
    return free;
}

void check_memory(const RunOptions& options, const Session& session, const peeling::Algorithm& algorithm) {
    const std::uint64_t held = held_memory();
    std::optional<std::uint64_t> limit = options.max_memory;
    if (!limit) limit = free_memory();
    if (!limit) return;
    if (!options.max_memory) *limit += held;
    if (is_surely_enough(options, *limit, held)) return;
    const std::uint64_t need = held + writer_bytes(options) +
                               peeling::memory_need(session.scene.list, session.view, session.profile, options.render,
                                                    algorithm, sampling(options))
                                   .total();
    if (need <= *limit) return;
    throw CLI::ValidationError(
        "--max-memory", algorithm.name + " at " + std::to_string(options.render.width) + "x" +
                            std::to_string(options.render.height) + " needs about " + in_words(need) +
                            (options.max_memory ? ", the limit is " : ", this machine has free ") + in_words(*limit) +
                            "; a smaller --size or --fragment-memory takes less");
}

}  // namespace strata::tools
