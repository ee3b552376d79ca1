// tools/oracle/program/drawing/surfaces.cpp - draws all surfaces as transparent ones, and sorts them into opaque ones
// and layers (surfaces.h).
#include "tools/oracle/program/drawing/surfaces.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "tools/oracle/fragments/fragments.h"

namespace strata::oracle::program {

namespace {

bool is_opaque(const pipeline::DrawList& list, std::uint32_t material) {
    return list.materials[material].alpha_mode != pipeline::AlphaMode::blend;
}

// All of them as transparent surfaces.
peeling::RenderOptions with_all(const peeling::FrameRequest& input) {
    peeling::RenderOptions options = input.options;
    options.alpha = 1.0f;
    return options;
}

std::string name_of(const pipeline::DrawList& list, std::uint32_t instance) {
    const std::string& name = list.materials[list.instances[instance].material].name;
    return fmt::format("instance {}{}", instance, name.empty() ? "" : " (" + name + ")");
}

// The layers before an opaque surface, over it.
Color composite_before(std::span<const verdict::Fragment> all, const verdict::Fragment& opaque,
                       const pipeline::DrawList& list) {
    Color color{double{opaque.color[0]}, double{opaque.color[1]}, double{opaque.color[2]}};
    for (auto f = all.rbegin(); f != all.rend(); ++f)
        if (f->code < opaque.code && !is_opaque(list, f->material))
            for (std::size_t c = 0; c < 3; ++c)
                color[c] = double{f->color[c]} * double{f->color[3]} + color[c] * (1 - double{f->color[3]});
    return color;
}

}  // namespace

std::string shown_surface(const peeling::FrameRequest& input, int x, int y, const Color& seen) {
    if (input.options.alpha) return "";
    const verdict::SceneFragments scene{input.with(with_all(input)), input.options.fragment_memory};
    const auto all = scene.visible_at(x, y);
    const verdict::Fragment* nearest = nullptr;
    for (const verdict::Fragment& f : all) {
        if (!is_opaque(input.list, f.material)) continue;
        if (nearest == nullptr) {
            nearest = &f;
            continue;
        }
        const Color color = composite_before(all, f, input.list);
        const double most = (1.5 + static_cast<double>(all.size()) / 2) / 255;
        if (std::ranges::equal(color, seen, [&](double a, double b) { return std::fabs(a - b) <= most; }))
            return fmt::format(
                "it comes out so if the opaque surface of {}, depth {:.9g}, is shown, which lies behind {}",
                name_of(input.list, f.instance), f.shader_z, name_of(input.list, nearest->instance));
    }
    return "";
}

SceneSurfaces surfaces_of(const peeling::FrameRequest& input, const Lists& alike) {
    SceneSurfaces surfaces;
    const bool has_opaque =
        std::ranges::any_of(input.list.instances, [&](const auto& i) { return is_opaque(input.list, i.material); });
    if (input.options.alpha || !has_opaque) return surfaces;
    const verdict::SceneFragments scene{input.with(with_all(input)), input.options.fragment_memory};
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
            if (is_opaque(input.list, f.material)) made.alpha = 1;
            (is_opaque(input.list, f.material) ? opaque.fragments : layers).push_back(made);
        }
    }
    complete(opaque);
    return surfaces;
}

}  // namespace strata::oracle::program
