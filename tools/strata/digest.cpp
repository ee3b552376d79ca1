// tools/strata/digest.cpp - strata digest: one string a target, equal exactly if the bits are.
#include <memory>
#include <nlohmann/json.hpp>

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

int digest(const DigestOptions& options) {
    ordered_json document = ordered_json::array();
    Table table{{{"digest"}, {"target"}, {"part"}, {"format"}, {"size"}, {"file"}}, {}};
    for (const std::string& file : options.files) {
        // A PNG has one image; an EXR has one for each target of each part.
        for (const auto& [part, target, image] : scenes::read_images(file)) {
            const std::string value = pipeline::digest(image);
            const std::string format(pipeline::info(image.format).name);
            document.push_back({{"file", file},
                                {"part", part},
                                {"target", target},
                                {"format", format},
                                {"width", image.width},
                                {"height", image.height},
                                {"digest", value}});
            table.rows.push_back({value, target, part.empty() ? "-" : part, format,
                                  std::to_string(image.width) + "x" + std::to_string(image.height), file});
        }
    }
    print(options.json ? document.dump(2, ' ', false, ordered_json::error_handler_t::replace) + '\n' : to_text(table));
    return 0;
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
