// tools/oracle/program/drawing/drawn_again.cpp - draws a scene in other ways (fit_drawings.h).
#include <fmt/format.h>

#include <algorithm>

#include "pipeline/device/profile.h"
#include "tools/oracle/fragments/fragments.h"
#include "tools/oracle/fragments/sample.h"
#include "tools/oracle/program/drawing/fit_drawings.h"
#include "tools/oracle/program/drawing/lookups.h"

namespace strata::oracle::program {

namespace {

void add_grids(const peeling::FrameRequest& input, const verdict::Colors& candidate, std::vector<OtherLists>& all) {
    struct Grid {
        int bits;
        std::string_view words;
    };
    for (const auto& [bits, words] : {Grid{0, "whole pixels"}, Grid{1, "half pixels"}, Grid{2, "quarters of a pixel"},
                                      Grid{3, "eighths of a pixel"}}) {
        if (input.profile.raster.subpixel_bits <= bits) continue;
        pipeline::DeviceProfile profile = input.profile;
        profile.raster.subpixel_bits = bits;
        const verdict::SceneFragments scene{input.on(profile, input.options), input.options.fragment_memory};
        if (scene.keeps())
            all.push_back({fmt::format("positions are rounded to {}", words), 4, lists_of(scene, candidate, true)});
    }
}

// Of textures whose texels are multiplied by alpha before they are filtered. The colours are divided by the filtered
// alpha, as lists hold straight ones.
void add_premultiplied_texels(const peeling::FrameRequest& input, const verdict::Colors& candidate,
                              std::vector<OtherLists>& all) {
    pipeline::DrawList list = input.list;
    bool is_other = false;
    for (pipeline::Texture& texture : list.textures)
        for (std::size_t i = 0; i + 3 < texture.texels.size(); i += 4)
            for (std::size_t c = 0; c < 3; ++c) {
                const int value = texture.texels[i + c], alpha = texture.texels[i + 3];
                texture.texels[i + c] = static_cast<std::uint8_t>((value * alpha + 127) / 255);
                is_other = is_other || texture.texels[i + c] != value;
            }
    if (!is_other) return;
    const verdict::SceneFragments scene{{list, input.view, input.profile, input.options, input.space},
                                        input.options.fragment_memory};
    if (!scene.keeps()) return;
    Lists lists = lists_of(scene, candidate, true);
    for (ListFragment& f : lists.fragments) {
        const pipeline::Material& material = list.materials[f.material];
        const double of_texture = f.alpha / std::max(double{material.front[3]}, 1e-6);
        if (material.texture >= 0 && of_texture > 0)
            for (double& c : f.color) c /= of_texture;
    }
    all.push_back({"texels are multiplied by alpha before they are filtered", 4, std::move(lists)});
}

// A viewport that is a row or column short or long, fixed at one of its ends.
struct OtherViewport {
    int axis = 0, longer = 0, fixed_end = 0;  // the end at -1 or 1
    [[nodiscard]] std::string words() const {
        constexpr std::string_view ends[2][2] = {{"right", "left"}, {"upper", "lower"}};
        return fmt::format("the viewport is a {} {} at its {} end", axis == 0 ? "column" : "row",
                           longer < 0 ? "short" : "long", ends[axis][fixed_end < 0 ? 0 : 1]);
    }
    [[nodiscard]] pipeline::View view(const peeling::FrameRequest& input) const {
        const int size = axis == 0 ? input.options.width : input.options.height;
        const float scale = static_cast<float>(size + longer) / static_cast<float>(size);
        const float shift = static_cast<float>(fixed_end) * (1 - scale);
        pipeline::View view = input.view;
        for (int c = 0; c < 4; ++c)
            view.projection[c][axis] = scale * view.projection[c][axis] + shift * view.projection[c][3];
        return view;
    }
};

void add_viewports(const peeling::FrameRequest& input, const verdict::Colors& candidate, std::vector<OtherLists>& all) {
    constexpr std::size_t most_pixels = 65'536;
    if (candidate.target().pixels() > most_pixels) return;
    for (const int axis : {0, 1})
        for (const int longer : {-1, 1})
            for (const int end : {-1, 1}) {
                const OtherViewport other{axis, longer, end};
                const pipeline::View view = other.view(input);
                const verdict::SceneFragments scene{{input.list, view, input.profile, input.options, input.space},
                                                    input.options.fragment_memory};
                if (scene.keeps()) all.push_back({other.words(), 5, lists_of(scene, candidate, true)});
            }
}

}  // namespace

std::vector<OtherLists> other_drawings(const peeling::FrameRequest& input, const Lists& given,
                                       const verdict::Colors& candidate) {
    std::vector<OtherLists> all = other_opaque_passes(surfaces_of(input, given));
    for (auto* others : {other_peels, other_lookups})
        for (OtherLists& other : others(given)) all.push_back(std::move(other));
    for (OtherLists& other : other_colors(input, given, candidate)) all.push_back(std::move(other));
    add_grids(input, candidate, all);
    add_premultiplied_texels(input, candidate, all);
    add_viewports(input, candidate, all);
    return all;
}

}  // namespace strata::oracle::program
