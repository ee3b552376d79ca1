// tools/oracle/program/drawing/other_colors.cpp - the scene's layers as they are without fog, without light, without
// textures, or on their other side: all or some of them have these colours (lookups.h).
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "tools/oracle/fragments/fragments.h"
#include "tools/oracle/program/drawing/lookups.h"

namespace strata::oracle::program {

namespace {

// Changes the scene; false: it has nothing of that kind.
struct ColorChange {
    std::string_view words{}, of_one{};
    bool (*change)(pipeline::DrawList& list, peeling::RenderOptions& options) = nullptr;
};

template <auto change>
bool of_materials(pipeline::DrawList& list, peeling::RenderOptions&) {
    const std::vector<pipeline::Material> given = list.materials;
    for (pipeline::Material& material : list.materials) change(material);
    return list.materials != given;
}

const ColorChange changes_of_color[] = {
    {"have no fog", "has no fog",
     [](pipeline::DrawList&, peeling::RenderOptions& options) { return std::exchange(options.fog, {}).has_value(); }},
    {"have the colours of their other side", "has the colour of its other side",
     of_materials<[](pipeline::Material& m) { std::swap(m.front, m.back); }>},
    {"have the colours of their front", "has the colour of its front",
     of_materials<[](pipeline::Material& m) { m.back = m.front; }>},
    {"have no light", "has no light", of_materials<[](pipeline::Material& m) { m.unlit = true; }>},
    {"have no texture", "has no texture", of_materials<[](pipeline::Material& m) { m.texture = -1; }>},
};

Lists with_colors(const Lists& given, const Lists& colors, const LayerChoice& choice, std::size_t step) {
    Lists made = empty_like(given);
    for (std::size_t i = 0; i < given.pixels.size(); i += step) {
        const ListPixel& pixel = given.pixels[i];
        add_like(pixel, made);
        for (std::size_t k = 0; k < pixel.fragments.size(); ++k)
            made.fragments.push_back(choice.has(pixel, k) ? colors.pixels[i].fragments[k] : pixel.fragments[k]);
    }
    complete(made);
    return made;
}

// The share of the fog's colour in a layer.
double share_of(const Color& fog, const Color& fogged, const Color& clear) {
    std::size_t most = 0;
    for (std::size_t c = 1; c < 3; ++c)
        if (std::fabs(fog[c] - clear[c]) > std::fabs(fog[most] - clear[most])) most = c;
    const double whole = fog[most] - clear[most];
    return whole == 0 ? 0 : std::clamp((fogged[most] - clear[most]) / whole, 0.0, 1.0);
}

// Fog in front of the finished pixel, as much as a layer of it has.
Lists with_fog_at_end(const Lists& given, const Lists& clear, const Color& fog, bool is_nearest, std::size_t step) {
    Lists made = empty_like(given);
    for (std::size_t i = 0; i < given.pixels.size(); i += step) {
        add_like(given.pixels[i], made);
        const auto fogged = given.pixels[i].fragments, layers = clear.pixels[i].fragments;
        if (layers.empty()) continue;
        const std::size_t k = is_nearest ? 0 : layers.size() - 1;
        ListFragment front = layers[0];
        front.alpha = share_of(fog, fogged[k].color, layers[k].color);
        front.color = fog;
        made.fragments.push_back(front);
        made.fragments.insert(made.fragments.end(), layers.begin(), layers.end());
    }
    complete(made, false);
    return made;
}

// Alphas are multiplied by the factor of the fog, too.
Lists with_fog_in_alpha(const Lists& given, const Lists& clear, const Color& fog, std::size_t step) {
    Lists made = empty_like(given);
    for (std::size_t i = 0; i < given.pixels.size(); i += step) {
        add_like(given.pixels[i], made);
        for (std::size_t k = 0; k < given.pixels[i].fragments.size(); ++k) {
            ListFragment& layer = made.fragments.emplace_back(given.pixels[i].fragments[k]);
            layer.alpha *= 1 - share_of(fog, layer.color, clear.pixels[i].fragments[k].color);
        }
    }
    complete(made);
    return made;
}

bool are_alike(const Lists& a, const Lists& b) {
    return std::ranges::equal(a.pixels, b.pixels, [](const ListPixel& x, const ListPixel& y) {
        return x.x == y.x && x.y == y.y && x.fragments.size() == y.fragments.size();
    });
}

}  // namespace

std::vector<OtherLists> other_colors(const peeling::FrameRequest& input, const Lists& given,
                                     const verdict::Colors& candidate) {
    CheapLists cheap{given};
    for (const ColorChange& change : changes_of_color) {
        pipeline::DrawList list = input.list;
        peeling::RenderOptions options = input.options;
        if (!change.change(list, options)) continue;
        const verdict::SceneFragments scene{{list, input.view, input.profile, options, input.space},
                                            options.fragment_memory};
        if (!scene.keeps()) continue;
        const Lists colors = lists_of(scene, candidate, true);
        if (!are_alike(given, colors)) continue;
        for (const LayerChoice& choice : layer_choices())
            cheap.add(fmt::format("{} {}", choice.words, choice.is_one ? change.of_one : change.words),
                      choice.price + 4, [&](std::size_t step) { return with_colors(given, colors, choice, step); });
        if (!input.options.fog || options.fog) continue;
        const Rgba& of_fog = input.options.fog->color;
        const Color fog{double{of_fog[0]}, double{of_fog[1]}, double{of_fog[2]}};
        cheap.add("alphas are multiplied by the factor of the fog, too", 5,
                  [&](std::size_t step) { return with_fog_in_alpha(given, colors, fog, step); });
        for (const bool is_nearest : {true, false})
            cheap.add(fmt::format("the finished pixel has the fog of its {} layer, where each layer is to have its own",
                                  is_nearest ? "nearest" : "farthest"),
                      6, [&](std::size_t step) { return with_fog_at_end(given, colors, fog, is_nearest, step); });
    }
    return std::move(cheap).best();
}

}  // namespace strata::oracle::program
