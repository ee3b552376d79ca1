// tools/strata/render/render.cpp - strata render: the picture of one or more algorithms.
#include "peeling/render.h"

#include <memory>

#include "scenes/files/image_io.h"
#include "tools/strata/command.h"
#include "tools/strata/render/run.h"

namespace strata::tools {

namespace {

// Without -o nothing is written: the statistics are the result.
void write_picture(const RunOptions& options, const Finished& finished) {
    if (options.output.empty()) return;
    scenes::write_image(path_for(options.output, options, finished.algorithm),
                        {.color = finished.result.frame.color,
                         .depth = finished.result.frame.depth,
                         .premultiplied = true,  // a finished frame's alpha is 1
                         .space = options.scene_options.color_space,
                         .attributes = attributes_of("render", options, finished)});
}

int render(RunOptions& options) {
    check_outputs({{"-o", options.output, {".exr", ".png"}}});
    return run_algorithms(options, [&](const Finished& finished) { write_picture(options, finished); });
}

}  // namespace

Command add_render(CLI::App& root) {
    auto* app = root.add_subcommand(
        "render", "render a scene by one or more algorithms and compare each with the exact A-buffer");
    const auto options = std::make_shared<RunOptions>();
    add_picture_options(*app, *options);
    add_execution_options(*app, *options);
    add_output_options(*app, *options, "the picture, .exr or .png; with several algorithms out.NAME.png");
    app->footer(
        footer("  strata render teapot --size 400x300 -o teapot.png\n"
               "  strata render volume-beam:slices=16 --algorithm all --profile ideal --size 200x150\n"
               "  strata render teapot --algorithm dual,weighted_average --size 200x150 --stats - -o teapot.exr\n"));
    return {app, [options] { return render(*options); }};
}

}  // namespace strata::tools
