// tools/lab/invariance/invariance_cell.cpp - opens a cell's scene, profile and view, checks that they can run, and
// measures both depth paths (invariance_cell.h).
#include "tools/lab/invariance/invariance_cell.h"

#include <fmt/format.h>

#include "pipeline/vertices/other_splits.h"
#include "rasterizer/base/input_error.h"
#include "rasterizer/rules/hypotheses.h"
#include "scenes/camera.h"
#include "scenes/files/profile_json.h"
#include "tools/request/names.h"
#include "tools/strata/options/pack_options.h"
#include "tools/strata/render/run.h"

namespace strata::tools {

namespace {

// The experiment of a cell. `resources` has threads, tile size and memory; every setting that affects bits comes from
// the cell.
peeling::InvarianceCase experiment_of(const Cell& cell, const peeling::RenderOptions& resources) {
    peeling::InvarianceCase e;
    e.render = resources;
    e.render.width = cell.width;
    e.render.height = cell.height;
    e.render.alpha = cell.alpha;
    e.render.depth = cell.format;
    // A factor and units of 0 would still enable the offset, so it is disabled, and the plain cell is the plain device.
    const bool has_bias = cell.remedy.bias_constant != 0 || cell.remedy.bias_slope != 0;
    e.render.raster.polygon_offset = {has_bias, cell.remedy.bias_slope, cell.remedy.bias_constant};
    e.render.compare_epsilon = cell.remedy.epsilon;
    e.render.quantize_reference = cell.remedy.quantize_reference;
    e.render.vertex_paths = cell.vertex_paths;
    e.write = cell.remedy.depth_replace ? rasterizer::DepthPath::depth_replace : cell.write;
    e.compare = cell.compare;
    e.algorithm = cell.algorithm;
    e.max_passes = cell.max_passes;
    // The two other splits need another list, which run() sets.
    if (cell.split == Split::clamped) e.render.second_depth_clamp = true;
    if (cell.split == Split::diagonal) e.match = peeling::Match::quad;
    if (cell.split == Split::moved) e.moved_window = {1, 1};
    return e;
}

}  // namespace

// A reference into the map stays valid: nodes of a std::map do not move.
const scenes::Scene& CellRunner::scene(const std::string& name) {
    const auto found = scenes_.find(name);
    return found != scenes_.end() ? found->second
                                  : scenes_.emplace(name, scenes::load_scene(name, scene_options_)).first->second;
}

pipeline::DeviceProfile CellRunner::profile(const Cell& cell) {
    if (!profiles_.contains(cell.profile)) profiles_[cell.profile] = scenes::load_profile(cell.profile);
    pipeline::DeviceProfile profile = profiles_[cell.profile];
    if (cell.subpixel_bits != 0) profile.raster.subpixel_bits = cell.subpixel_bits;
    if (cell.hypothesis == "profile") return profile;
    // The device with one undetermined constant at another value. The names listed in an error begin with the two that
    // are not constants.
    std::vector<std::string> names{"profile", "all"};
    for (const auto& named : rasterizer::depth_hypotheses(profile.raster)) {
        if (named.name == cell.hypothesis) return profile.raster = named.rules, profile;
        names.push_back(named.name);
    }
    throw InputError(cell.profile, "hypothesis", one_of(names), found_but_near(cell.hypothesis, names));
}

// The number of a cell is its index in this list: a shard and a merge of the same plan must expand it identically.
std::vector<Cell> CellRunner::expanded(const std::vector<Cell>& cells) {
    std::vector<Cell> all;
    for (Cell cell : cells) {
        const bool every = cell.hypothesis == "all";
        if (every) cell.hypothesis = "profile";
        all.push_back(cell);
        if (!every) continue;
        const auto named = rasterizer::depth_hypotheses(profile(cell).raster);
        for (std::size_t i = 1; i < named.size(); ++i) {  // the first is the profile itself
            cell.hypothesis = named[i].name;
            all.push_back(cell);
        }
    }
    return all;
}

// A pack's view may have another clip convention; cells are drawn in the default one.
const pipeline::View* CellRunner::own_view(const Cell& cell) {
    if (!cell.takes_own_view || !cell.camera.empty() || !scene(cell.scene).own_view) return nullptr;
    const auto known = own_views_.find(cell.scene);
    if (known != own_views_.end()) return &known->second;
    RunOptions pack;
    take_pack_state(pack, cell.scene);
    const pipeline::View view = scenes::with_clip_convention(
        *scene(cell.scene).own_view, pack.pack_convention.value_or(scenes::ClipConvention{}), {});
    return &own_views_.emplace(cell.scene, view).first->second;
}

// Reading checks the names: both functions throw InputError.
void CellRunner::check(const Cell& cell) {
    static_cast<void>(profile(cell));
    static_cast<void>(scene(cell.scene));
    if (!cell.camera.empty()) {
        if (!cell.takes_own_view) throw InputError(cell.scene, "camera", "either a camera or an orbit", "both");
        static_cast<void>(view(cell));
    }
    if (cell.range == DepthRange{} || !view(cell).is_own) return;
    const DepthRange& r = cell.range;
    throw InputError(
        cell.scene, "near_far",
        "orbit, for the scene's own view and a camera have planes of their own (--orbit gives another view)",
        r.ratio > 0 ? fmt::format("ratio:{}", r.ratio) : fmt::format("{}:{}", r.near, r.far));
}

const pipeline::DrawList* CellRunner::split_list(const Cell& cell) {
    if (cell.split != Split::rotated && cell.split != Split::diagonal) return nullptr;
    // One list per scene and split. A split does not depend on the view.
    const std::string key = cell.scene + ' ' + name_of(cell.split);
    const pipeline::DrawList& list = scene(cell.scene).list;
    if (!splits_.contains(key))
        splits_[key] =
            cell.split == Split::rotated ? pipeline::rotate_vertices(list, 1) : pipeline::flip_diagonals(list).list;
    return &splits_[key];
}

CellView CellRunner::view(const Cell& cell) {
    const int subpixel_bits = profile(cell).raster.subpixel_bits;
    if (const pipeline::View* const own = own_view(cell)) return {*own, 0, 0, subpixel_bits, true};
    const double aspect = double(cell.width) / cell.height;
    if (!cell.camera.empty()) return {view_named(cell.camera, scene(cell.scene), aspect), 0, 0, subpixel_bits, true};
    scenes::LookAt camera = scenes::orbit_camera(scene(cell.scene).bounds, cell.azimuth, cell.elevation);
    // The far plane remains the orbit's and the near one moves towards the eye, so nothing of the scene is clipped.
    if (cell.range.ratio > 0) camera.near = camera.far / cell.range.ratio;
    if (cell.range.far > 0) {
        camera.near = cell.range.near;
        camera.far = cell.range.far;
    }
    return {scenes::look_at(camera, aspect), camera.near, camera.far, subpixel_bits, false};
}

CellResult CellRunner::run(const Cell& cell) {
    const pipeline::DeviceProfile device = profile(cell);
    CellResult result{.view = view(cell), .measured = {}, .refusal = {}};
    peeling::InvarianceCase experiment = experiment_of(cell, resources_);
    experiment.render.second_list = split_list(cell);
    result.measured = peeling::measure(scene(cell.scene).list, result.view.view, device, experiment);
    if (result.measured.refusal) result.refusal = result.measured.refusal->message(device);
    return result;
}

}  // namespace strata::tools
