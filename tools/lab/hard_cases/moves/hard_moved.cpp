#include "tools/lab/hard_cases/moves/hard_moved.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "peeling/registry.h"
#include "peeling/render.h"
#include "tools/request/choices.h"

namespace strata::tools {

using namespace pipeline;

namespace {

// The spacing of stored depths; for binary32 that of the upper half of the range.
double depth_step(DepthFormat format) {
    switch (format) {
        case DepthFormat::d16: return 1.0 / 0xffff;
        case DepthFormat::d24: return 1.0 / 0xffffff;
        case DepthFormat::d32f: return 0x1p-24;
        case DepthFormat::d16f: return 0x1p-12;
        case DepthFormat::d24f: break;
    }
    return 0x1p-16;
}

RendererProperties properties_of(const DeviceProfile& profile, DepthFormat depth, const peeling::Algorithm& algorithm,
                                 const HardRow& row) {
    const bool has_fault = std::any_of(row.diagnostics.begin(), row.diagnostics.end(),
                                       [](const Diagnostic& d) { return explains_misplaced(d.fault); });
    return {.grid = std::ldexp(1.0, -profile.raster.subpixel_bits),
            .depth = depth_step(depth),
            .is_ordered = algorithm.ties != peeling::TiePolicy::none,
            .is_excused = has_fault || row.steps_planes};
}

}  // namespace

bool is_moved(const peeling::Algorithm& algorithm) {
    constexpr std::array names{"dual", "front_to_back", "depth_units", "shadow_map", "weighted_average"};
    return std::find(names.begin(), names.end(), algorithm.name) != names.end();
}

MovedRow MovedCaseRenderer::run(const DeviceProfile& profile, DepthFormat depth, const peeling::Algorithm& algorithm,
                                const HardRow& row) const {
    const scenes::HardCase& hard = moved_.hard();
    const RenderFunction as_is = [&](const scenes::Scene& scene, const View& view) {
        peeling::Renderer renderer{scene.list, view, profile, hard_options(hard, depth)};
        return render(renderer, algorithm, hard.width);
    };
    MovedRow moved{.stability = moved_.stability(properties_of(profile, depth, algorithm, row), as_is),
                   .own = path_.flicker(as_is),
                   .paths = {}};
    if (!algorithm.shows_depth_paths) return moved;
    for (const auto& path : depth_paths()) {
        const RenderFunction depths = [&](const scenes::Scene& scene, const View& view) {
            peeling::RenderOptions options = hard_options(hard, depth);
            options.depth_path = path.value;
            peeling::Renderer renderer{scene.list, view, profile, options};
            return result_of_depths(renderer, algorithm);
        };
        try {
            moved.paths.emplace_back(path.name, path_.flicker(depths));
        } catch (const Refused&) {
            moved.paths.emplace_back(path.name, std::nullopt);
        }
    }
    moved.paths.emplace_back("exact_unstored", path_.flicker_of_exact_depths(as_is));
    return moved;
}

nlohmann::ordered_json flicker_json(const MovedRow& row) {
    nlohmann::ordered_json json = to_json(row.own);
    json["paths"] = nullptr;
    for (const auto& [name, flicker] : row.paths)
        json["paths"][name] = flicker ? to_json(*flicker) : nlohmann::ordered_json(nullptr);
    return json;
}

}  // namespace strata::tools
