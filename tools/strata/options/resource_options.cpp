// tools/strata/options/resource_options.cpp - the options of execution, resources and outputs. No result bit depends on
// them.
#include <algorithm>

#include "scenes/memory_limit.h"
#include "tools/request/choices.h"
#include "tools/request/names.h"
#include "tools/request/parse.h"
#include "tools/strata/messages.h"
#include "tools/strata/options/options.h"

namespace strata::tools {

void add_execution_options(CLI::App& app, PictureRequest& request) {
    add_options(app, request, OptionGroup::execution);
    add_options(app, request, OptionGroup::resources);
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
    add_options(app, options, OptionGroup::measures);
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
