// tools/lab/reproduce/reproduce_everitt.cpp - Everitt 2001: Figure 3 (the teapot's layers) and Figure 5
// (composites of the first n).
#include <fmt/format.h>

#include "peeling/registry.h"
#include "peeling/render.h"
#include "scenes/camera.h"
#include "tools/lab/reproduce/figures.h"

namespace strata::tools {

namespace {

// Square images of the requested size.
peeling::RenderOptions options_for(const ReproduceOptions& options) {
    peeling::RenderOptions render;
    render.width = render.height = options.size;
    render.threads = options.threads;
    return render;
}

// The scene of the paper's figures on the profile geforce3, peeled with two depth units as in the paper's Listing 1.
struct Teapot {
    scenes::Scene scene = scenes::load_scene("teapot", {});
    pipeline::View view = scenes::orbit_view(scene.bounds, 30, 20, 1.0);

    [[nodiscard]] peeling::RenderResult render(const peeling::RenderOptions& options) const {
        return peeling::Renderer(scene.list, view, *pipeline::find_profile("geforce3"), options)
            .render(*peeling::find_algorithm("depth_units"));
    }
};

// Figure 3: each layer as an image, and the number of pixels that it covers.
Section layers(const ReproduceOptions& options, const Teapot& teapot) {
    peeling::RenderOptions render = options_for(options);
    render.alpha = 1.0f;
    // A frame keeps its layers only if requested.
    render.keep_layers = true;
    const peeling::RenderResult result = teapot.render(render);
    Section section{"Figure 3: simple depth peeling",
                    "Layer 0 holds the nearest depths, layer 1 the second nearest, and so on; red outside, green "
                    "inside, and a blue plane underneath, as in the paper, which shows layers 0 to 3. Each layer has "
                    "the scene's own alpha of 0.5."};
    section.sheet = {"figure3", {"layer", "pixels with a fragment"}, {}};
    for (std::size_t i = 0; i < result.frame.layers.size(); ++i) {
        const pipeline::Image& color = result.frame.layers[i].color;
        std::size_t covered = 0;
        // Pixels whose layer has a fragment: their alpha is not 0.
        for (std::size_t p = 0; p < color.codes.size(); p += 4) covered += color.codes[p + 3] != 0 ? 1 : 0;
        section.sheet.rows.push_back({std::to_string(i), std::to_string(covered)});
        section.pictures.push_back(write_picture(options.folder, fmt::format("layer{}.png", i),
                                                 fmt::format("layer {}", i), color, ColorForm::straight));
    }
    return section;
}

// Figure 5: the image after n layers for every n, and its difference from the complete one.
Section composites(const ReproduceOptions& options, const Teapot& teapot) {
    peeling::RenderOptions render = options_for(options);
    render.alpha = 0.5f;
    render.background = {0.2f, 0.3f, 0.6f, 1};
    const peeling::RenderResult whole = teapot.render(render);
    Section section{"Figure 5: composites of the first n layers",
                    fmt::format("Every alpha 0.5; all {} layers are {} passes. The paper says that the last two of its "
                                "pictures look \"virtually "
                                "(but not completely) identical\" and that its scene is \"good enough\" after three "
                                "layers; the table says by how much.",
                                whole.audit.layers_max, whole.frame.passes.geometry)};
    section.sheet = {
        "figure5",
        {"layers", "largest difference / 255", "mean difference / 255", "pixels that differ", "diagnosed as truncated"},
        {}};
    for (int n = 1; n <= whole.audit.layers_max; ++n) {
        // One pass peels one layer. A peel that is stopped early is composited as far as it went.
        render.max_passes = n;
        const peeling::RenderResult part = teapot.render(render);
        const PictureDifference d = difference(part.frame.color, whole.frame.color);
        // Pixels that the run itself reports as truncated, in the column next to the pixels that differ.
        std::uint64_t truncated = 0;
        for (const auto& diagnostic : part.frame.diagnostics)
            if (diagnostic.fault == pipeline::Fault::truncated) truncated += diagnostic.pixels;
        section.sheet.rows.push_back({std::to_string(n), fmt::format("{:.0f}", d.largest),
                                      fmt::format("{:.3f}", d.mean), std::to_string(d.pixels),
                                      std::to_string(truncated)});
        section.pictures.push_back(write_picture(options.folder, fmt::format("composite{}.png", n),
                                                 fmt::format("{} layers", n), part.frame.color));
    }
    return section;
}

}  // namespace

Page reproduce_everitt(const ReproduceOptions& options) {
    const Teapot teapot;
    return {"Everitt 2001: Interactive Order-Independent Transparency",
            page_note,
            everitt_2001_link,
            {layers(options, teapot), composites(options, teapot)}};
}

}  // namespace strata::tools
