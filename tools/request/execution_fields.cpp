// tools/request/execution_fields.cpp - the options of execution and resources. No result bit depends on them.
#include "tools/request/choices.h"
#include "tools/request/groups.h"
#include "tools/request/make_field.h"

namespace strata::tools {

namespace {

using peeling::RenderOptions;

// Parses a number of threads, up to the limit of a renderer.
std::optional<int> to_threads(std::string_view text) {
    const auto value = to_count(text);
    return value && *value <= 1024 ? value : std::nullopt;
}

}  // namespace

std::vector<OptionField> execution_fields() {
    using enum OptionGroup;
    return {
        choice<&PictureRequest::render, &RenderOptions::execution>(
            execution, "execution", executions,
            "over the whole frame, or tile by tile with a tile's fragments kept for later passes; same bits (default "
            "replay)"),
        choice<&PictureRequest::render, &RenderOptions::simd>(
            execution, "simd", simds, "instruction set; same bits (default best: what the processor has)"),
        choice<&PictureRequest::render, &RenderOptions::effects>(
            execution, "effects", effects, "simulate the stages that are needed, or all; same bits (default needed)"),
        number<&PictureRequest::render, &RenderOptions::fragment_memory>(
            resources,
            {"fragment-memory", "SIZE",
             "what replay may keep of fragments, and the audit, in bytes; same bits (default 256M)",
             "bytes such as 65536, 64M or 1G"},
            to_bytes),
        choice<&PictureRequest::render, &RenderOptions::tile_size>(
            resources, "tile", tile_sizes,
            "side of a tile in pixels; same bits (default 64; 32 where a peel runs pass by pass, 128 in large frames "
            "of one pass)"),
        number<&PictureRequest::render, &RenderOptions::threads>(
            resources,
            {"threads", "N", "threads at most; same bits (default 0: all that there are)",
             "a whole number from 0 to 1024"},
            to_threads),
        flag<&PictureRequest::render, &RenderOptions::counters>(
            measures, "counters",
            "count fragments by their fates, and bytes, for --stats: the frame runs literally, which takes longer"),
        usual(flag<&PictureRequest::render, &RenderOptions::audit>(
            measures, "audit", "do not compare with the exact A-buffer: faster, and those statistics are null")),
    };
}

}  // namespace strata::tools
