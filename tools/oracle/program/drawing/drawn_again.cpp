// tools/oracle/program/drawing/drawn_again.cpp - draws a scene in other ways (fit_drawings.h).
#include <fmt/format.h>

#include "pipeline/device/profile.h"
#include "tools/oracle/fragments/fragments.h"
#include "tools/oracle/program/drawing/fit_drawings.h"

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

}  // namespace

std::vector<OtherLists> other_drawings(const peeling::FrameRequest& input, const Lists& given,
                                       const verdict::Colors& candidate) {
    std::vector<OtherLists> all = other_opaque_passes(surfaces_of(input, given));
    add_grids(input, candidate, all);
    return all;
}

}  // namespace strata::oracle::program
