// tools/strata/render/layers.cpp - strata layers: writes the layers that an algorithm peeled, and optionally every
// fragment of the frame.
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <numeric>

#include "peeling/render.h"
#include "scenes/files/image_io.h"
#include "tools/oracle/passes/contact_sheet.h"
#include "tools/strata/command.h"
#include "tools/strata/options/option.h"
#include "tools/strata/recorded_command.h"
#include "tools/strata/render/run.h"

namespace strata::tools {

namespace {

// The options of the command line; `deep` is the file of --deep, empty for none.
struct LayersOptions {
    RunOptions run;
    std::string deep;
};

// Sorts the fragments by pixel, in submission order within each pixel.
scenes::DeepFragments as_deep(const std::vector<pipeline::CapturedFragment>& fragments, const RunOptions& options) {
    scenes::DeepFragments deep{
        .width = options.render.width, .height = options.render.height, .space = options.scene_options.color_space};
    deep.count.assign(static_cast<std::size_t>(deep.width) * static_cast<std::size_t>(deep.height), 0);
    for (const auto& fragment : fragments) ++deep.count[fragment.pixel];
    std::vector<std::size_t> next(deep.count.size());
    std::exclusive_scan(deep.count.begin(), deep.count.end(), next.begin(), std::size_t{0});
    deep.depth_code.resize(fragments.size());
    deep.z.resize(fragments.size());
    deep.rgba.resize(fragments.size());
    deep.primitive.resize(fragments.size());
    for (const auto& fragment : fragments) {
        const std::size_t place = next[fragment.pixel]++;
        deep.depth_code[place] = fragment.code;
        deep.z[place] = fragment.shader_z;
        deep.rgba[place] = fragment.color;
        deep.primitive[place] = fragment.primitive;
    }
    return deep;
}

// Moves the layers out of the result, from near to far. An algorithm that peels both ends returns them in the order of
// its passes, possibly with empty ones at the end; its layers are named by end and pass, and the layer behind
// everything is last.
std::vector<scenes::OutputColor> take_layers(const CompletedRun& finished) {
    std::vector<scenes::OutputColor> front, back;
    for (auto& layer : finished.result.frame.layers) {
        const bool is_back = layer.side == pipeline::Side::back;
        std::vector<scenes::OutputColor>& end = is_back ? back : front;
        end.push_back({.color = std::move(layer.color), .depth = std::move(layer.depth)});
        if (!finished.algorithm.takes_both_ends) continue;
        end.back().part = fmt::format("{}.{:03}", is_back ? "back" : "front", end.size() - 1);
        if (std::ranges::all_of(end.back().color.codes, [](std::uint32_t code) { return code == 0; })) end.pop_back();
    }
    front.insert(front.end(), back.rbegin(), back.rend());
    return front;
}

// One image row per layer, from near to far, with the layer's colours and depths.
pipeline::Image contact_sheet(const std::vector<scenes::OutputColor>& layers) {
    oracle::ContactSheet sheet;
    for (std::size_t i = 0; i < layers.size(); ++i) {
        std::vector<oracle::NamedImage> targets{{"colour", layers[i].color}};
        if (!layers[i].depth.codes.empty()) targets.push_back({"depth - near is bright", layers[i].depth});
        sheet.add(layers[i].part.empty() ? fmt::format("layer {}", i) : layers[i].part, targets, {});
    }
    return sheet.image();
}

// Writes the layers (-o) and the fragments (--deep) of one algorithm.
void write_layers(const LayersOptions& options, const CompletedRun& finished) {
    const scenes::Attributes attributes = attributes_of("layers", options.run, finished);
    if (!options.run.output.empty()) {
        std::vector<scenes::OutputColor> layers = take_layers(finished);
        for (scenes::OutputColor& layer : layers) {
            layer.premultiplied = finished.algorithm.premultiplied_layers;
            layer.space = options.run.scene_options.color_space;
            layer.attributes = attributes;
        }
        if (layers.empty()) {  // nothing was peeled: write one layer without fragments
            layers.push_back(
                {.color = {finished.result.frame.color.format, options.run.render.width, options.run.render.height},
                 .space = options.run.scene_options.color_space,
                 .attributes = attributes});
        }
        const std::string path = path_for(options.run.output, options.run, finished.algorithm);
        if (kind_of(options.run, scenes::ImageFile::exr) == scenes::ImageFile::png)
            scenes::write_image(path, {.color = contact_sheet(layers), .attributes = attributes},
                                scenes::ImageFile::png);
        else
            scenes::write_layers(path, layers);
    }
    if (!options.deep.empty()) {
        const peeling::FrameFragments found = finished.renderer.fragments(finished.algorithm);
        std::vector<scenes::DeepFragments> samples;
        for (std::size_t sample = 0; sample < found.samples; ++sample)
            samples.push_back(as_deep(found.of_sample(sample).all, options.run));
        scenes::write_deep(path_for(options.deep, options.run, finished.algorithm), samples, attributes);
    }
}

int layers(LayersOptions& options) {
    check_outputs(
        {{"-o", options.run.output, {".exr", ".png"}, StandardOutput::possibly}, {"--deep", options.deep, {".exr"}}});
    if (options.run.output.empty() && options.deep.empty()) {
        throw CLI::ValidationError("-o is missing: the file for the layers; or --deep FILE, for the fragments");
    }
    options.run.render.keep_layers = true;
    return run_algorithms(options.run, [&](const CompletedRun& finished) { write_layers(options, finished); });
}

}  // namespace

Command add_layers(CLI::App& root) {
    auto* app = root.add_subcommand("layers", "write the layers that an algorithm peels, and every fragment");
    const auto options = std::make_shared<LayersOptions>();
    options->run.default_algorithm = "front_to_back";  // its layers are in the order in which they are peeled
    add_picture_options(*app, options->run);
    add_from_option(*app, options->run.files_in);
    add_execution_options(*app, options->run);
    add_output_options(
        *app, options->run,
        "the layers: .exr has part layer.000, the nearest, and so on, of a dual peel front.000 and back.000; .png is "
        "one sheet with all of them; - is standard output");
    add_format_option(*app, options->run, "what -o - writes (default exr)");
    add_path(*app, options->deep,
             {"--deep", "FILE",
              "every transparent fragment as a deep EXR, in submission order; of several samples a part for each, "
              "sample.0 ...",
              "a file name"});
    app->footer(
        footer("  strata layers teapot --size 200x150 -o layers.exr\n"
               "  strata layers volume-beam:slices=4 --algorithm depth_units --size 64x64 -o beam.exr --deep "
               "fragments.exr\n"
               "  strata layers teapot --algorithm dual --size 160x120 -o dual.png\n"));
    return {app, [options] { return layers(*options); }};
}

}  // namespace strata::tools
