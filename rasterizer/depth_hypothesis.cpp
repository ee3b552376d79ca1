#include "rasterizer/rules.h"

namespace strata::rasterizer {
namespace {

// Appends `rules` changed by `change`, if that changes them.
void vary(std::vector<NamedHypothesis>& all, std::string name, auto change) {
    RasterRules rules = all.front().rules;
    change(rules);
    if (rules != all.front().rules) all.push_back({std::move(name), rules});
}

}  // namespace

std::vector<NamedHypothesis> depth_hypotheses(const RasterRules& rules) {
    std::vector<NamedHypothesis> all{{"as given", rules}};
    const auto numbers = [&](const std::string& name, int DepthHypothesis::*constant, int low, int high) {
        for (int n = low; n <= high; ++n)
            vary(all, name + "=" + std::to_string(n), [&](RasterRules& r) { r.hypothesis.*constant = n; });
    };
    numbers("interpolant_bits", &DepthHypothesis::interpolant_bits, 16, 24);
    vary(all, "interpolant_bits=double", [](RasterRules& r) { r.hypothesis.interpolant_bits = full_double; });
    vary(all, "divide=exact", [](RasterRules& r) { r.hypothesis.divide = DivideRule::exact; });
    vary(all, "divide=cut_reciprocal", [](RasterRules& r) { r.hypothesis.divide = DivideRule::cut_reciprocal; });
    vary(all, "divide=low_reciprocal", [](RasterRules& r) { r.hypothesis.divide = DivideRule::low_reciprocal; });
    vary(all, "window_z=chip", [](RasterRules& r) { r.hypothesis.window_z = WindowZRule::chip; });
    vary(all, "window_z=exact", [](RasterRules& r) { r.hypothesis.window_z = WindowZRule::exact; });
    vary(all, "window_z=float32", [](RasterRules& r) { r.hypothesis.window_z = WindowZRule::float32; });
    numbers("reciprocal_bits", &DepthHypothesis::reciprocal_bits, 24, 30);
    numbers("sum_bits", &DepthHypothesis::sum_bits, 24, 29);
    vary(all, "depth_rounding=floor", [](RasterRules& r) { r.depth_rounding = DepthRounding::floor; });
    vary(all, "depth_rounding=nearest", [](RasterRules& r) { r.depth_rounding = DepthRounding::nearest; });
    vary(all, "quantize_reference=true", [](RasterRules& r) { r.hypothesis.quantize_reference = true; });
    vary(all, "quantize_reference=false", [](RasterRules& r) { r.hypothesis.quantize_reference = false; });
    vary(all, "plane_anchor=first_vertex",
         [](RasterRules& r) { r.hypothesis.plane_anchor = PlaneAnchor::first_vertex; });
    vary(all, "plane_anchor=window_corner",
         [](RasterRules& r) { r.hypothesis.plane_anchor = PlaneAnchor::window_corner; });
    return all;
}

}  // namespace strata::rasterizer
