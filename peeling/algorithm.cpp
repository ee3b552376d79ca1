#include "peeling/algorithm.h"

#include <algorithm>

#include "peeling/closed_form.h"
#include "peeling/runs.h"

namespace strata::peeling {

using pipeline::DepthKey;
using pipeline::Feature;
using rasterizer::DepthPath;

namespace {

int one(int) { return 1; }
int every_layer_and_one(int layers) { return layers + 1; }
int dual_passes(int layers) { return 1 + std::max(1, (layers + 1) / 2); }
int dual_independent_passes(int layers) { return (layers + 1) / 2 + 2; }

constexpr rasterizer::FragmentNeeds code_and_color{.shader_z = false, .code = true, .color = true};
constexpr rasterizer::FragmentNeeds z_and_color{.shader_z = true, .code = false, .color = true};

std::vector<Algorithm> make_algorithms() {
    const std::string everitt = "Everitt 2001", bavoil = "Bavoil and Myers 2008";
    const std::vector<Feature> programs{Feature::fragment_programs, Feature::separate_alpha_blend};
    const std::vector<Feature> float_programs{Feature::float_targets, Feature::fragment_programs};
    const std::vector<Feature> independent{Feature::independent_blend, Feature::separate_alpha_blend, Feature::float_targets,
                                           Feature::fragment_programs};
    return {
        {.name = "unsorted", .paper = everitt, .section = "Figure 1 (b)",
         .summary = "OVER in submission order; right where every pixel's fragments arrive back to front",  .pass_formula = "1", .ties = TiePolicy::none, .key = DepthKey::stored_code,
         .geometry_passes = one, .run = unsorted},
        {.name = "painter", .paper = everitt, .section = "Introduction",
         .summary = "OVER of triangles sorted by centroid, far first; fails where triangles cross",  .pass_formula = "1", .ties = TiePolicy::last, .key = DepthKey::stored_code, .sorts_triangles = true,
         .geometry_passes = one, .run = unsorted},
        {.name = "depth_units", .paper = everitt, .section = "Multiple Depth Tests, Listing 1",
         .summary = "one layer a pass by two sequential depth units; layers composited back to front",  .pass_formula = "N + 1", .ties = TiePolicy::unique,
         .key = DepthKey::stored_code, .exact = true, .makes_layers = true, .geometry_passes = every_layer_and_one,
         .run = depth_units, .replayed = code_and_color, .features = {Feature::sequential_depth_units}},
        {.name = "shadow_map", .paper = everitt, .section = "Shadow Mapping as Depth Test; An Invariance Issue",
         .summary = "one layer a pass by shadow comparison and alpha test; its two depths may differ in their last bits", .pass_formula = "N + 1 where the compared depth is the stored one",
         .ties = TiePolicy::unique, .key = DepthKey::stored_code, .makes_layers = true, .kills_alpha_zero = true, .geometry_passes = every_layer_and_one,
         .run = shadow_map, .replayed = code_and_color, .compares = DepthPath::perspective_rq},
        {.name = "shadow_map_depth_replace", .paper = everitt, .section = "An Invariance Issue, Listing 2",
         .summary = "the same with a depth replaced by a texture shader: stored and compared depth are one quotient", .pass_formula = "N + 1",
         .ties = TiePolicy::unique, .key = DepthKey::stored_code, .exact = true, .makes_layers = true, .kills_alpha_zero = true,
         .geometry_passes = every_layer_and_one, .run = shadow_map, .replayed = code_and_color, .features = {Feature::depth_replace},
         .stores = DepthPath::depth_replace, .compares = DepthPath::perspective_rq},
        {.name = "front_to_back", .paper = bavoil, .section = "Depth Peeling; Under Blending",
         .summary = "one layer a pass, nearest first, blended UNDER",  .pass_formula = "N + 1", .ties = TiePolicy::unique,
         .key = DepthKey::stored_code, .exact = true, .makes_layers = true, .premultiplied_layers = true, .geometry_passes = every_layer_and_one,
         .run = front_to_back, .closed_form = front_to_back_closed, .replayed = code_and_color, .features = programs},
        {.name = "dual", .paper = bavoil, .section = "Dual Depth Peeling",
         .summary = "nearest and farthest layer of every pass, blended on the fly under one MAX equation",  .pass_formula = "1 + max(1, ceil(N/2))", .ties = TiePolicy::merged,
         .key = DepthKey::shader_z, .exact = true, .geometry_passes = dual_passes, .run = dual, .closed_form = dual_closed, .replayed = z_and_color, .features = float_programs, .render_targets = 3},
        {.name = "dual_independent", .paper = bavoil, .section = "Blending on the Fly (DirectX 10.1)",
         .summary = "dual peeling with a blend equation a target; no tie is lost",  .pass_formula = "ceil(N/2) + 2", .ties = TiePolicy::first_then_last,
         .key = DepthKey::shader_z, .exact = true, .geometry_passes = dual_independent_passes, .run = dual_independent, .replayed = z_and_color,
         .features = independent, .render_targets = 3},
        {.name = "weighted_average", .paper = bavoil, .section = "Weighted Average",
         .summary = "every colour replaced by the average weighted by alpha; an approximation",  .pass_formula = "1", .ties = TiePolicy::none, .key = DepthKey::shader_z,
         .geometry_passes = one, .run = weighted_average, .features = float_programs, .render_targets = 2},
        {.name = "weighted_sum", .paper = bavoil, .section = "Weighted Sum",
         .summary = "order-dependent terms ignored; darkens where alphas add up to more than 1",  .pass_formula = "1", .ties = TiePolicy::none, .key = DepthKey::shader_z,
         .geometry_passes = one, .run = weighted_sum, .features = float_programs},
        {.name = "a_buffer", .paper = "Carpenter 1984", .section = "the oracle",
         .summary = "every fragment sorted by exact depth and composited in binary64; what the others are measured against",  .pass_formula = "1", .ties = TiePolicy::first, .key = DepthKey::stored_code, .exact = true,
         .is_oracle = true, .geometry_passes = one, .run = a_buffer},
    };
}

}  // namespace

const std::vector<Algorithm>& algorithms() {
    static const std::vector<Algorithm> all = make_algorithms();
    return all;
}

const Algorithm* find_algorithm(std::string_view name) {
    const auto& all = algorithms();
    const auto found = std::find_if(all.begin(), all.end(), [&](const Algorithm& a) { return a.name == name; });
    return found == all.end() ? nullptr : &*found;
}

pipeline::Verdict refusal(const Algorithm& algorithm, const pipeline::DeviceProfile& profile) {
    if (auto lacking = check(profile, std::span{algorithm.features})) return lacking;
    const std::vector<pipeline::Blend> targets(static_cast<std::size_t>(algorithm.render_targets));
    return check(profile, std::span{targets});
}

}  // namespace strata::peeling
