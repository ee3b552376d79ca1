// tools/oracle/program/drawing/surfaces.cpp - draws all surfaces as transparent ones, and sorts them into opaque ones
// and layers (surfaces.h).
#include "tools/oracle/program/drawing/surfaces.h"

#include <algorithm>

#include "tools/oracle/fragments/fragments.h"

namespace strata::oracle::program {

SceneSurfaces surfaces_of(const peeling::FrameRequest& input, const Lists& alike) {
    SceneSurfaces surfaces;
    const auto is_opaque = [&](std::uint32_t material) {
        return input.list.materials[material].alpha_mode != pipeline::AlphaMode::blend;
    };
    const bool has_opaque =
        std::ranges::any_of(input.list.instances, [&](const auto& i) { return is_opaque(i.material); });
    if (input.options.alpha || !has_opaque) return surfaces;
    peeling::RenderOptions options = input.options;
    options.alpha = 1.0f;
    const verdict::SceneFragments scene{input.with(options), input.options.fragment_memory};
    if (!scene.keeps()) return surfaces;
    for (std::size_t c = 0; c < 3; ++c) surfaces.background[c] = double{input.options.background[c]};
    Lists& opaque = surfaces.opaque;
    opaque.width = alike.width;
    opaque.height = alike.height;
    opaque.format = alike.format;
    for (const ListPixel& pixel : alike.pixels) {
        const auto all = scene.visible_at(pixel.x, pixel.y);
        opaque.pixels.push_back({.x = pixel.x, .y = pixel.y, .first = opaque.fragments.size(), .seen = pixel.seen});
        std::vector<ListFragment>& layers = surfaces.layers.emplace_back();
        for (const verdict::Fragment& f : all) {
            ListFragment made = list_fragment(f, all);
            if (is_opaque(f.material)) made.alpha = 1;
            (is_opaque(f.material) ? opaque.fragments : layers).push_back(made);
        }
    }
    complete(opaque);
    return surfaces;
}

}  // namespace strata::oracle::program
