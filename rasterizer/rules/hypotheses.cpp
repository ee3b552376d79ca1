// rasterizer/rules/hypotheses.cpp - the alternatives of every uncertain constant, as listed by hypotheses.h.
#include "rasterizer/rules/hypotheses.h"

namespace strata::rasterizer {
namespace {

// The list that is built. `vary` appends a changed copy of the given rules if the change has an effect.
struct List {
    std::vector<NamedHypothesis> all;

    explicit List(const RasterRules& rules) : all{{"as given", rules, {}}} {}
    void vary(HypothesisSubject subject, std::string name, auto change) {
        RasterRules rules = all.front().rules;
        change(rules);
        if (rules != all.front().rules) all.push_back({std::move(name), rules, subject});
    }
    void vary(HypothesisSubject subject, const std::string& name, int DepthHypothesis::*constant, int low, int high) {
        for (int n = low; n <= high; ++n)
            vary(subject, name + "=" + std::to_string(n), [&](RasterRules& r) { r.hypothesis.*constant = n; });
    }
};

void vary_quotients(List& list) {
    constexpr HypothesisSubject subject = HypothesisSubject::texture_depth;
    list.vary(subject, "interpolant_bits", &DepthHypothesis::interpolant_bits, 16, 24);
    list.vary(subject, "interpolant_bits=double", [](RasterRules& r) { r.hypothesis.interpolant_bits = full_double; });
    list.vary(subject, "divide=exact", [](RasterRules& r) { r.hypothesis.divide = DivideRule::exact; });
    list.vary(subject, "divide=cut_reciprocal",
              [](RasterRules& r) { r.hypothesis.divide = DivideRule::cut_reciprocal; });
    list.vary(subject, "divide=low_reciprocal",
              [](RasterRules& r) { r.hypothesis.divide = DivideRule::low_reciprocal; });
}

void vary_window_depth(List& list) {
    constexpr HypothesisSubject subject = HypothesisSubject::window_depth;
    list.vary(subject, "window_z=chip", [](RasterRules& r) { r.hypothesis.window_z = WindowZRule::chip; });
    list.vary(subject, "window_z=exact", [](RasterRules& r) { r.hypothesis.window_z = WindowZRule::exact; });
    list.vary(subject, "window_z=float32", [](RasterRules& r) { r.hypothesis.window_z = WindowZRule::float32; });
    list.vary(subject, "weights=area", [](RasterRules& r) {
        r.hypothesis.weights = WeightRule::area;
        r.hypothesis.reciprocal_bits = 28;
    });
    list.vary(subject, "weights=cut_edges", [](RasterRules& r) {
        r.hypothesis.weights = WeightRule::cut_edges;
        r.hypothesis.reciprocal_bits = 29;
    });
    list.vary(subject, "reciprocal_deficit", &DepthHypothesis::reciprocal_deficit, 0, 4);
    list.vary(subject, "reciprocal_bits", &DepthHypothesis::reciprocal_bits, 24, 30);
    list.vary(subject, "sum_bits", &DepthHypothesis::sum_bits, 24, 29);
    list.vary(subject, "w_slope=first_quad", [](RasterRules& r) { r.hypothesis.w_slope = WSlope::first_quad; });
    list.vary(subject, "w_slope=last_quad", [](RasterRules& r) { r.hypothesis.w_slope = WSlope::last_quad; });
    list.vary(subject, "offset_rule=corners", [](RasterRules& r) { r.offset_rule = OffsetRule::corners; });
    list.vary(subject, "offset_rule=fragments", [](RasterRules& r) { r.offset_rule = OffsetRule::fragments; });
    list.vary(subject, "depth_rounding=floor", [](RasterRules& r) { r.depth_rounding = DepthRounding::floor; });
    list.vary(subject, "depth_rounding=nearest", [](RasterRules& r) { r.depth_rounding = DepthRounding::nearest; });
}

void vary_anchor(List& list) {
    constexpr HypothesisSubject subject = HypothesisSubject::window_depth;
    list.vary(subject, "plane_anchor=first_vertex",
              [](RasterRules& r) { r.hypothesis.plane_anchor = PlaneAnchor::first_vertex; });
    list.vary(subject, "plane_anchor=window_corner",
              [](RasterRules& r) { r.hypothesis.plane_anchor = PlaneAnchor::window_corner; });
}

}  // namespace

std::vector<NamedHypothesis> depth_hypotheses(const RasterRules& rules) {
    List list{rules};
    vary_quotients(list);
    vary_window_depth(list);
    constexpr HypothesisSubject compared = HypothesisSubject::texture_depth;
    list.vary(compared, "quantize_reference=true", [](RasterRules& r) { r.hypothesis.quantize_reference = true; });
    list.vary(compared, "quantize_reference=false", [](RasterRules& r) { r.hypothesis.quantize_reference = false; });
    vary_anchor(list);
    return std::move(list.all);
}

std::vector<NamedHypothesis> interpolation_hypotheses(const RasterRules& rules) {
    List list{rules};
    for (const int n : {12, 13, 14, 15, 16, 24})
        list.vary(HypothesisSubject::color, "vertex_color_bits=" + std::to_string(n),
                  [n](RasterRules& r) { r.interpolation.vertex_color_bits = n; });
    list.vary(HypothesisSubject::color, "perspective_color=edge_products",
              [](RasterRules& r) { r.interpolation.perspective_color = PerspectiveColor::edge_products; });
    list.vary(HypothesisSubject::color, "perspective_color=weight_products",
              [](RasterRules& r) { r.interpolation.perspective_color = PerspectiveColor::weight_products; });
    list.vary(HypothesisSubject::color, "perspective_color=cut_products",
              [](RasterRules& r) { r.interpolation.perspective_color = PerspectiveColor::cut_products; });
    list.vary(HypothesisSubject::coordinates, "perspective_coordinates=exact_plane",
              [](RasterRules& r) { r.interpolation.perspective_coordinates = PerspectiveCoordinates::exact_plane; });
    list.vary(HypothesisSubject::coordinates, "perspective_coordinates=cut_products",
              [](RasterRules& r) { r.interpolation.perspective_coordinates = PerspectiveCoordinates::cut_products; });
    list.vary(HypothesisSubject::coordinates, "texture_coordinates=exact_plane",
              [](RasterRules& r) { r.interpolation.texture_coordinates = CoordinateRule::exact_plane; });
    list.vary(HypothesisSubject::coordinates, "texture_coordinates=cut_weights",
              [](RasterRules& r) { r.interpolation.texture_coordinates = CoordinateRule::cut_weights; });
    return std::move(list.all);
}

}  // namespace strata::rasterizer
