// tools/strata/options/resource_options.cpp - the options of execution, resources and outputs. No result bit depends on
// them.
#include <algorithm>

#include "scenes/memory_limit.h"
#include "tools/strata/messages.h"
#include "tools/strata/options/choices.h"
#include "tools/strata/options/names.h"
#include "tools/strata/options/options.h"
#include "tools/strata/options/parse.h"

namespace strata::tools {

namespace {

// Parses a number of bytes, with an optional suffix K, M or G.
std::optional<std::uint64_t> to_bytes(std::string_view text) {
    constexpr std::string_view suffixes = "KMG";
    const std::size_t suffix = text.empty() ? suffixes.npos : suffixes.find(text.back());
    const unsigned shift = suffix == suffixes.npos ? 0 : 10 * (static_cast<unsigned>(suffix) + 1);
    if (shift > 0) text.remove_suffix(1);
    const auto count = to_int<std::uint64_t>(text);
    // More than 2^64 - 1 bytes is an error: the shift would lose the upper bits.
    if (!count || *count > ~std::uint64_t{0} >> shift) return std::nullopt;
    return *count << shift;
}

// Parses a number of threads, up to the limit of a renderer.
std::optional<int> to_threads(std::string_view text) {
    const auto value = to_count(text);
    return value && *value <= 1024 ? value : std::nullopt;
}

}  // namespace

void add_execution_options(CLI::App& app, RunOptions& options) {
    add_choice(app, options.render.execution, "--execution", executions,
               "over the whole frame, or tile by tile with a tile's fragments kept for later passes; same bits "
               "(default replay)");
    add_choice(app, options.simd, "--simd", simds, "instruction set; same bits (default best: what the processor has)");
    add_choice(app, options.render.effects, "--effects", effects,
               "simulate the stages that are needed, or all; same bits (default needed)");
    add_resource_options(app, options);
}

void add_resource_options(CLI::App& app, RunOptions& options) {
    add_option(app, options.render.fragment_memory,
               {"--fragment-memory", "SIZE",
                "what replay may keep of fragments, and the audit, in bytes; same bits (default 256M)",
                "bytes such as 65536, 64M or 1G"},
               to_bytes);
    add_choice(app, options.render.tile_size, "--tile", tile_sizes,
               "side of a tile in pixels; same bits (default 64; 32 where a peel runs pass by pass, 128 in large "
               "frames of one pass)");
    add_option(app, options.render.threads,
               {"--threads", "N", "threads at most; same bits (default 0: all that there are)",
                "a whole number from 0 to 1024"},
               to_threads);
}

void check_simd(Simd simd) {
    const auto available = available_simd();
    if (simd == Simd::best || std::find(available.begin(), available.end(), simd) != available.end()) return;
    std::vector<std::string> names;
    for (const Simd has : available) names.push_back(name_of(simds, has));
    throw CLI::ValidationError("--simd", "expected best or what this processor has (" + one_of(names) + "), found '" +
                                             name_of(simds, simd) + "'");
}

void add_output_options(CLI::App& app, RunOptions& options, const std::string& output_help) {
    add_path(app, options.output, {"-o,--output", "FILE", output_help, "a file name or -"});
    add_path(
        app, options.stats,
        {"--stats", "FILE|-", "statistics as JSON, one object an algorithm; - is standard output", "a file name or -"});
    app.add_flag(
        "--counters", options.render.counters,
        "count fragments by their fates, and bytes, for --stats: the frame runs literally, which takes longer");
    app.add_flag_callback(
        "--no-audit", [&options] { options.render.audit = false; },
        "do not compare with the exact A-buffer: faster, and those statistics are null");
    add_memory_option(app, options);
}

void add_memory_option(CLI::App& app, RunOptions& options) {
    const auto set_limit = [](std::string_view text) {
        const auto bytes = to_bytes(text);
        if (bytes) scenes::limit_memory(*bytes);
        return bytes;
    };
    add_option(app, options.max_memory,
               {"--max-memory", "SIZE",
                "refuse a file, a scene or a picture that needs more bytes (default: the free memory of the computer)",
                "bytes such as 65536, 64M or 1G"},
               set_limit);
}

void add_format_option(CLI::App& app, RunOptions& options, const std::string& help) {
    const std::vector<Choice<scenes::ImageFile>> kinds{{"png", scenes::ImageFile::png},
                                                       {"exr", scenes::ImageFile::exr}};
    add_choice(app, options.format, "--format", kinds, help);
}

}  // namespace strata::tools
