// tools/strata/digest.cpp - strata digest: one string a target, equal exactly if the bits are.
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "rasterizer/base/input_error.h"
#include "scenes/files/image_io.h"
#include "tools/strata/command.h"
#include "tools/strata/table.h"

namespace strata::tools {

namespace {

using nlohmann::ordered_json;

// The command line.
struct DigestOptions {
    std::vector<std::string> files;
    bool json = false;
};

using Digests = std::vector<scenes::FileDigest>;

// Nothing for a file that cannot be read; standard error then has the reason.
std::optional<Digests> digests_or_reason(const std::string& file) {
    try {
        return scenes::digests_of(file);
    } catch (const InputError& error) {
        std::fprintf(stderr, "strata: %s\n", error.what());
        return std::nullopt;
    }
}

int digest(const DigestOptions& options) {
    ordered_json document = ordered_json::array();
    Table table{{{"digest"}, {"target"}, {"part"}, {"format"}, {"size"}, {"file"}}, {}};
    bool all_read = true;
    for (const std::string& file : options.files) {
        const auto digests = digests_or_reason(file);
        all_read &= digests.has_value();
        for (const auto& [part, target, format, width, height, value] : digests.value_or(Digests{})) {
            document.push_back({{"file", file},
                                {"part", part},
                                {"target", target},
                                {"format", format},
                                {"width", width},
                                {"height", height},
                                {"digest", value}});
            table.rows.push_back({value, target, part.empty() ? "-" : part, format,
                                  std::to_string(width) + "x" + std::to_string(height), file});
        }
    }
    if (options.json) print(document.dump(2, ' ', false, ordered_json::error_handler_t::replace) + '\n');
    if (!options.json && !table.rows.empty()) print(to_text(table));
    return all_read ? 0 : 2;
}

}  // namespace

Command add_digest(CLI::App& root) {
    auto* app = root.add_subcommand("digest", "print the digests of images: equal strings, equal bits");
    const auto options = std::make_shared<DigestOptions>();
    app->add_option("FILE", options->files, ".exr and .png files")->required()->type_name("");
    app->add_flag("--json", options->json, "one JSON document instead of the table");
    app->footer(
        footer("  strata render teapot --size 64x64 -o teapot.exr && strata digest teapot.exr\n"
               "  strata render teapot --size 64x64 -o teapot.png && strata digest --json teapot.png\n"));
    return {app, [options] { return digest(*options); }};
}

}  // namespace strata::tools
