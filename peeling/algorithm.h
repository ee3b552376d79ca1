// peeling/algorithm.h - the registry: every algorithm with its paper, its needs, its tie policy and its pass formula.
#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "peeling/tie_policy.h"
#include "pipeline/check.h"
#include "pipeline/region.h"

namespace strata::peeling {

struct Algorithm {
    std::string name;
    std::string paper;         // author and year
    std::string section;       // where in it
    std::string summary;       // one sentence
    std::string pass_formula;  // geometry passes for N layers, under --termination exact
    TiePolicy ties = TiePolicy::none;
    pipeline::DepthKey key = pipeline::DepthKey::stored_code;
    bool exact = false;        // order_errors must be 0
    bool makes_layers = false;
    bool premultiplied_layers = false;  // their colours are times alpha
    bool sorts_triangles = false;
    bool kills_alpha_zero = false;  // an alpha test keeps fragments that store alpha 0 from being layers
    bool is_oracle = false;    // not a device's algorithm: never refused
    int (*geometry_passes)(int layers) = nullptr;  // the formula
    void (*run)(pipeline::Region&) = nullptr;
    bool (*closed_form)(pipeline::Region&) = nullptr;  // peeling/closed_form.h; null if it has none
    // What its geometry passes look at, all together: what replay captures. Empty: one pass, nothing to replay.
    std::optional<rasterizer::FragmentNeeds> replayed{};
    std::vector<pipeline::Feature> features{};  // what a profile must have
    int render_targets = 1;
    std::optional<rasterizer::DepthPath> stores{};    // the depth path that it writes, whatever the options say
    std::optional<rasterizer::DepthPath> compares{};  // the one that it compares, unless the options say otherwise
};

// unsorted, painter, depth_units, shadow_map, shadow_map_depth_replace, front_to_back, dual, dual_independent, weighted_average, weighted_sum, a_buffer.
[[nodiscard]] const std::vector<Algorithm>& algorithms();
[[nodiscard]] const Algorithm* find_algorithm(std::string_view name);  // null if there is none

// The first feature that the profile lacks for it.
[[nodiscard]] pipeline::Verdict refusal(const Algorithm& algorithm, const pipeline::DeviceProfile& profile);

}  // namespace strata::peeling
