#include "tools/strata/render/memory.h"

#include "peeling/memory_need.h"
#include "scenes/memory_limit.h"

namespace strata::tools {

namespace {

// Bytes per pixel that a file writer allocates for a frame with one colour and one depth: the codes as numbers, and
// OpenEXR's buffers.
constexpr std::uint64_t png_bytes_a_pixel = 36, exr_bytes_a_pixel = 28;

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
    const auto samples = static_cast<std::uint64_t>(options.sampling.samples);
    const std::uint64_t most =
        (1 + samples) * held + samples * pixels * most_bytes_a_pixel + 2 * options.render.fragment_memory;
    return !options.max_memory && !options.render.keep_layers && most < limit;
}

}  // namespace

void check_memory(const RunOptions& options, const Session& session, const peeling::Algorithm& algorithm) {
    const std::uint64_t held = scenes::held_memory();
    std::optional<std::uint64_t> limit = options.max_memory;
    if (!limit) limit = scenes::free_memory();
    if (!limit) return;
    if (!options.max_memory) *limit += held;
    if (is_surely_enough(options, *limit, held)) return;
    const std::uint64_t need =
        held + writer_bytes(options) + peeling::memory_need(session.request(options.render), algorithm).total();
    if (need <= *limit) return;
    throw CLI::ValidationError("--max-memory",
                               algorithm.name + " at " + std::to_string(options.render.width) + "x" +
                                   std::to_string(options.render.height) + " needs about " + scenes::memory_text(need) +
                                   (options.max_memory ? ", the limit is " : ", this computer has free ") +
                                   scenes::memory_text(*limit) + "; a smaller --size or --fragment-memory takes less");
}

void check_literal_memory(RunOptions options, const Session& session) {
    options.render.execution = pipeline::Execution::literal;
    for (const peeling::Algorithm* algorithm : options.algorithms) check_memory(options, session, *algorithm);
}

}  // namespace strata::tools
