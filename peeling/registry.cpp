// peeling/registry.cpp - the algorithms as tables, one a paper: an entry an algorithm, a field a line.
//
// Rule     An entry names what differs from the defaults of Algorithm (algorithms/algorithm.h), which says what each
//          field means. The order of the entries is the order of every list and table that the command prints.
// Tests    tests/peeling/refusals_test.cpp, passes_test.cpp; tests/house/book_covers.py: each name has a section in the
//          book
#include "peeling/registry.h"

#include <algorithm>
#include <span>

#include "peeling/algorithms/runs.h"
#include "peeling/loops/dual_closed.h"

namespace strata::peeling {

using pipeline::DepthKey;
using enum pipeline::Feature;
using rasterizer::DepthPath;

namespace {

// Geometry passes of a frame of N layers under exact termination, as the sections of algorithms.md derive them: a pass
// a layer and one that finds nothing; for dual peeling a pass that finds the first range, and two layers in each of the
// others.
int one(int) { return 1; }
int every_layer_and_one(int layers) { return layers + 1; }
int find_and_composite(int layers) { return 2 * layers + 1; }
int dual_passes(int layers) { return 1 + std::max(1, (layers + 1) / 2); }
int dual_independent_passes(int layers) { return (layers + 1) / 2 + 2; }

// The values that an algorithm's geometry passes look at, and so what replay captures: by key, the code or the float.
constexpr rasterizer::FragmentNeeds code_and_color{.shader_z = false, .code = true, .color = true};
constexpr rasterizer::FragmentNeeds z_and_color{.shader_z = true, .code = false, .color = true};

// Peels of the first paper, and the unsorted pictures that it starts from.
std::span<const Algorithm> of_everitt() {
    static const Algorithm table[] = {
        {.name = "unsorted",
         .paper = "Everitt 2001",
         .section = "Figure 1 (b)",
         .summary = "OVER in submission order; right where every pixel's fragments arrive back to front",
         .pass_formula = "1",
         .ties = TiePolicy::none,
         .key = DepthKey::stored_code,
         .geometry_passes = one,
         .run = unsorted},
        {.name = "painter",
         .paper = "Everitt 2001",
         .section = "Introduction",
         .summary = "OVER of triangles sorted by centroid, far first; fails where triangles cross",
         .pass_formula = "1",
         .ties = TiePolicy::last,
         .key = DepthKey::stored_code,
         .order = ListOrder::back_to_front,
         .geometry_passes = one,
         .run = unsorted},
        {.name = "depth_units",
         .paper = "Everitt 2001",
         .section = "Multiple Depth Tests, Listing 1",
         .summary = "one layer a pass by two sequential depth units; layers composited back to front",
         .pass_formula = "N + 1",
         .ties = TiePolicy::unique,
         .key = DepthKey::stored_code,
         .exact = true,
         .makes_layers = true,
         .geometry_passes = every_layer_and_one,
         .run = depth_units,
         .replayed = code_and_color,
         .features = {sequential_depth_units}},
        {.name = "shadow_map",
         .paper = "Everitt 2001",
         .section = "Shadow Mapping as Depth Test; An Invariance Issue",
         .summary =
             "one layer a pass by shadow comparison and alpha test; its two depths may differ in their last bits",
         .pass_formula = "N + 1 where the compared depth is the stored one",
         .ties = TiePolicy::unique,
         .key = DepthKey::stored_code,
         .makes_layers = true,
         .kills_alpha_zero = true,
         .geometry_passes = every_layer_and_one,
         .run = shadow_map,
         .replayed = code_and_color,
         .compares = DepthPath::perspective_rq},
        {.name = "shadow_map_depth_replace",
         .paper = "Everitt 2001",
         .section = "An Invariance Issue, Listing 2",
         .summary = "the same with a depth replaced by a texture shader: stored and compared depth are one quotient",
         .pass_formula = "N + 1",
         .ties = TiePolicy::unique,
         .key = DepthKey::stored_code,
         .exact = true,
         .makes_layers = true,
         .kills_alpha_zero = true,
         .geometry_passes = every_layer_and_one,
         .run = shadow_map,
         .replayed = code_and_color,
         .features = {depth_replace},
         .stores = DepthPath::depth_replace,
         .compares = DepthPath::perspective_rq},
    };
    return table;
}

// Front to back and dual peeling, and the two approximations that need no order.
std::span<const Algorithm> of_bavoil_and_myers() {
    static const Algorithm table[] = {
        {.name = "front_to_back",
         .paper = "Bavoil and Myers 2008",
         .section = "Depth Peeling; Under Blending",
         .summary = "one layer a pass, nearest first, blended UNDER",
         .pass_formula = "N + 1",
         .ties = TiePolicy::unique,
         .key = DepthKey::stored_code,
         .exact = true,
         .makes_layers = true,
         .premultiplied_layers = true,
         .geometry_passes = every_layer_and_one,
         .run = front_to_back,
         .replayed = code_and_color,
         .features = {fragment_programs, separate_alpha_blend}},
        {.name = "dual",
         .paper = "Bavoil and Myers 2008",
         .section = "Dual Depth Peeling",
         .summary = "nearest and farthest layer of every pass, blended on the fly under one MAX equation",
         .pass_formula = "1 + max(1, ceil(N/2))",
         .ties = TiePolicy::merged,
         .key = DepthKey::shader_z,
         .exact = true,
         .makes_layers = true,
         .takes_both_ends = true,
         .geometry_passes = dual_passes,
         .run = dual,
         .closed_form = dual_closed,
         .replayed = z_and_color,
         .features = {float_targets, fragment_programs},
         .render_targets = 3},
        {.name = "dual_independent",
         .paper = "Bavoil and Myers 2008",
         .section = "Blending on the Fly (DirectX 10.1)",
         .summary = "dual peeling with a blend equation a target; no tie is lost",
         .pass_formula = "ceil(N/2) + 2",
         .ties = TiePolicy::first_then_last,
         .key = DepthKey::shader_z,
         .exact = true,
         .makes_layers = true,
         .takes_both_ends = true,
         .geometry_passes = dual_independent_passes,
         .run = dual_independent,
         .replayed = z_and_color,
         .features = {independent_blend, separate_alpha_blend, float_targets, fragment_programs},
         .render_targets = 3},
        {.name = "weighted_average",
         .paper = "Bavoil and Myers 2008",
         .section = "Weighted Average",
         .summary = "every colour replaced by the average weighted by alpha; an approximation",
         .pass_formula = "1",
         .ties = TiePolicy::none,
         .key = DepthKey::shader_z,
         .geometry_passes = one,
         .run = weighted_average,
         .features = {float_targets, fragment_programs},
         .render_targets = 2},
        {.name = "weighted_sum",
         .paper = "Bavoil and Myers 2008",
         .section = "Weighted Sum",
         .summary = "order-dependent terms ignored; darkens where alphas add up to more than 1",
         .pass_formula = "1",
         .ties = TiePolicy::none,
         .key = DepthKey::shader_z,
         .geometry_passes = one,
         .run = weighted_sum,
         .features = {float_targets, fragment_programs}},
    };
    return table;
}

// Peels of runs that arrive in depth order, and the baseline that they are compared with.
std::span<const Algorithm> of_carr() {
    static const Algorithm table[] = {
        {.name = "layer_peel",
         .paper = "Carr, Mech and Miller 2008",
         .section = "section 2, Table 1",
         .summary = "a pass finds the nearest layer left, another composites it: the baseline of Carr's paper",
         .pass_formula = "2 N + 1",
         .ties = TiePolicy::first,
         .exact = true,
         .compares_own_codes = true,
         .has_published_form = true,
         .geometry_passes = find_and_composite,
         .run = layer_peel,
         .replayed = code_and_color,
         .features = {fragment_programs, separate_alpha_blend}},
        {.name = "hybrid",
         .paper = "Carr, Mech and Miller 2008",
         .section = "Algorithm 1",
         .summary = "unordered meshes peeled, an ordered set (--sorted) composited between the peels",
         .pass_formula = "3 U + 2, U layers unordered",
         .ties = TiePolicy::first,
         .exact = true,
         .order = ListOrder::sets,
         .compares_own_codes = true,
         .has_published_form = true,
         .run = hybrid,
         .replayed = code_and_color,
         .features = {fragment_programs, separate_alpha_blend}},
        {.name = "coherent_stencil",
         .paper = "Carr, Mech and Miller 2008",
         .section = "section 5 (A)",
         .summary = "runs of fragments in order, found by counting in the stencil buffer",
         .pass_formula = "1 + 6 an iteration",
         .ties = TiePolicy::first,
         .exact = true,
         .compares_own_codes = true,
         .has_published_form = true,
         .run = coherent_stencil,
         .replayed = code_and_color,
         .features = {fragment_programs, separate_alpha_blend}},
        {.name = "coherent_blend",
         .paper = "Carr, Mech and Miller 2008",
         .section = "section 6 (B)",
         .summary = "the same runs, with the depth before the nearest shifted into the colour by blending",
         .pass_formula = "1 + 5 an iteration",
         .ties = TiePolicy::first,
         .exact = true,
         .compares_own_codes = true,
         .has_published_form = true,
         .run = coherent_blend,
         .replayed = code_and_color,
         .features = {float_targets, fragment_programs, separate_alpha_blend}},
        {.name = "coherent_ideal",
         .paper = "Carr, Mech and Miller 2008",
         .section = "Algorithm 2",
         .summary = "the same runs in two passes, by depths and a flag that the rasterizer reads and writes",
         .pass_formula = "2 an iteration - 1",
         .ties = TiePolicy::first,
         .exact = true,
         .compares_own_codes = true,
         .has_published_form = true,
         .run = coherent_ideal,
         .replayed = code_and_color,
         .features = {ordered_rmw, float_targets, fragment_programs, separate_alpha_blend},
         .render_targets = 2},
    };
    return table;
}

// The algorithms that Carr's paper compares itself with, and at last the oracle.
std::span<const Algorithm> of_others() {
    static const Algorithm table[] = {
        {.name = "stencil_routed_k_buffer",
         .paper = "Myers and Bavoil 2007",
         .section = "",
         .summary = "eight fragments a pass, routed by the stencil test into samples, sorted afterwards",
         .pass_formula = "ceil(M/8), M fragments",
         .ties = TiePolicy::first,
         .exact = true,
         .compares_own_codes = true,
         .run = stencil_routed_k_buffer,
         .replayed = code_and_color,
         .features = {fragment_programs, separate_alpha_blend},
         .samples = 8},
        {.name = "k_buffer",
         .paper = "Bavoil et al. 2007",
         .section = "",
         .summary = "the four nearest fragments so far, sorted as they come; the fifth pushes the nearest out",
         .pass_formula = "1",
         .ties = TiePolicy::first,
         .compares_own_codes = true,
         .geometry_passes = one,
         .run = k_buffer,
         .features = {ordered_rmw, float_targets, fragment_programs, separate_alpha_blend},
         .render_targets = 6},
        {.name = "batched",
         .paper = "Wexler et al. 2005",
         .section = "",
         .summary = "objects taken in batches by depth, each batch's interval of depth peeled by itself",
         .pass_formula = "sum of L + 1 over intervals",
         .ties = TiePolicy::unique,
         .exact = true,
         .order = ListOrder::objects,
         .runs_loops = true,
         .compares_own_codes = true,
         .run = batched,
         .replayed = code_and_color,
         .features = {fragment_programs, separate_alpha_blend}},
        {.name = "object_sorted",
         .paper = "Govindaraju et al. 2005",
         .section = "",
         .summary = "objects ordered by occlusion queries, then composited; wrong where objects or their own triangles "
                    "overlap out of order",
         .pass_formula = "3 n - 2 to n^2 + 2 n - 2, n objects",
         .ties = TiePolicy::first,
         .order = ListOrder::objects,
         .whole_frame = true,
         .compares_own_codes = true,
         .run = object_sorted,
         .features = {fragment_programs, separate_alpha_blend}},
        {.name = "a_buffer",
         .paper = "Carpenter 1984",
         .section = "the oracle",
         .summary =
             "every fragment sorted by exact depth and composited in binary64; what the others are measured against",
         .pass_formula = "1",
         .ties = TiePolicy::first,
         .key = DepthKey::stored_code,
         .exact = true,
         .is_oracle = true,
         .geometry_passes = one,
         .run = a_buffer},
    };
    return table;
}

std::vector<Algorithm> all_tables() {
    std::vector<Algorithm> all;
    for (const auto& table : {of_everitt(), of_bavoil_and_myers(), of_carr(), of_others()})
        all.insert(all.end(), table.begin(), table.end());
    return all;
}

}  // namespace

const std::vector<Algorithm>& algorithms() {
    static const std::vector<Algorithm> all = all_tables();
    return all;
}

const Algorithm* find_algorithm(std::string_view name) {
    const auto& all = algorithms();
    const auto found = std::find_if(all.begin(), all.end(), [&](const Algorithm& a) { return a.name == name; });
    return found == all.end() ? nullptr : &*found;
}

// Targets count by their number alone here: their blends are checked by each pass (pipeline/region/check_pass.h).
pipeline::Verdict refusal(const Algorithm& algorithm, const pipeline::DeviceProfile& profile) {
    if (auto lacking = check(profile, std::span{algorithm.features})) return lacking;
    const std::vector<pipeline::Blend> targets(static_cast<std::size_t>(algorithm.render_targets));
    if (auto lacking = check(profile, std::span{targets})) return lacking;
    return check_samples(profile, algorithm.samples);
}

}  // namespace strata::peeling
