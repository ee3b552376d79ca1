// Tests the hypotheses of both headers against independent lists of their names and of what each can change.
#include <catch2/catch.hpp>
#include <string>
#include <utility>
#include <vector>

#include "rasterizer/rules/hypotheses.h"

namespace {

using namespace strata::rasterizer;
using Named = std::pair<std::string, HypothesisSubject>;

[[nodiscard]] std::vector<Named> names_of(const std::vector<NamedHypothesis>& list) {
    std::vector<Named> names;
    for (std::size_t i = 1; i < list.size(); ++i) names.emplace_back(list[i].name, list[i].subject);
    return names;
}

void add_numbers(std::vector<Named>& names, const std::string& name, HypothesisSubject subject,
                 const std::vector<int>& numbers) {
    for (const int n : numbers) names.emplace_back(name + "=" + std::to_string(n), subject);
}

// The rules that a name represents, derived from the name alone.
[[nodiscard]] RasterRules rules_named(const std::string& name, RasterRules rules) {
    const std::string key = name.substr(0, name.find('=')), value = name.substr(name.find('=') + 1);
    DepthHypothesis& h = rules.hypothesis;
    InterpolationHypothesis& i = rules.interpolation;
    if (key == "interpolant_bits") h.interpolant_bits = value == "double" ? 53 : std::stoi(value);
    if (name == "weights=area") h.weights = WeightRule::area, h.reciprocal_bits = 28;
    if (name == "weights=cut_edges") h.weights = WeightRule::cut_edges, h.reciprocal_bits = 29;
    if (key == "reciprocal_deficit") h.reciprocal_deficit = std::stoi(value);
    if (value == "first_quad") h.w_slope = WSlope::first_quad;
    if (value == "last_quad") h.w_slope = WSlope::last_quad;
    if (value == "corners") rules.offset_rule = OffsetRule::corners;
    if (value == "fragments") rules.offset_rule = OffsetRule::fragments;
    if (name == "perspective_color=cut_products") i.perspective_color = PerspectiveColor::cut_products;
    if (name == "perspective_coordinates=cut_products")
        i.perspective_coordinates = PerspectiveCoordinates::cut_products;
    if (name == "perspective_coordinates=exact_plane") i.perspective_coordinates = PerspectiveCoordinates::exact_plane;
    if (key == "reciprocal_bits") h.reciprocal_bits = std::stoi(value);
    if (key == "sum_bits") h.sum_bits = std::stoi(value);
    if (key == "vertex_color_bits") i.vertex_color_bits = std::stoi(value);
    if (value == "cut_reciprocal") h.divide = DivideRule::cut_reciprocal;
    if (value == "low_reciprocal") h.divide = DivideRule::low_reciprocal;
    if (name == "divide=exact") h.divide = DivideRule::exact;
    if (name == "window_z=chip") h.window_z = WindowZRule::chip;
    if (name == "window_z=exact") h.window_z = WindowZRule::exact;
    if (name == "window_z=float32") h.window_z = WindowZRule::float32;
    if (value == "floor") rules.depth_rounding = DepthRounding::floor;
    if (value == "nearest") rules.depth_rounding = DepthRounding::nearest;
    if (key == "quantize_reference") h.quantize_reference = value == "true";
    if (value == "first_vertex") h.plane_anchor = PlaneAnchor::first_vertex;
    if (value == "window_corner") h.plane_anchor = PlaneAnchor::window_corner;
    if (value == "edge_products") i.perspective_color = PerspectiveColor::edge_products;
    if (value == "weight_products") i.perspective_color = PerspectiveColor::weight_products;
    if (name == "texture_coordinates=exact_plane") i.texture_coordinates = CoordinateRule::exact_plane;
    if (value == "cut_weights") i.texture_coordinates = CoordinateRule::cut_weights;
    return rules;
}

[[nodiscard]] std::string first_misnamed(const std::vector<NamedHypothesis>& list) {
    for (std::size_t i = 1; i < list.size(); ++i)
        if (list[i].rules != rules_named(list[i].name, list[0].rules)) return list[i].name;
    return "";
}

}  // namespace

TEST_CASE("the hypotheses of depth are those listed in this order with the values that each can change") {
    std::vector<Named> expected;
    add_numbers(expected, "interpolant_bits", HypothesisSubject::texture_depth, {16, 17, 18, 19, 20, 21, 22, 23});
    expected.emplace_back("interpolant_bits=double", HypothesisSubject::texture_depth);
    expected.emplace_back("divide=cut_reciprocal", HypothesisSubject::texture_depth);
    expected.emplace_back("divide=low_reciprocal", HypothesisSubject::texture_depth);
    expected.emplace_back("window_z=exact", HypothesisSubject::window_depth);
    expected.emplace_back("window_z=float32", HypothesisSubject::window_depth);
    expected.emplace_back("weights=area", HypothesisSubject::window_depth);
    add_numbers(expected, "reciprocal_deficit", HypothesisSubject::window_depth, {0, 1, 3, 4});
    add_numbers(expected, "reciprocal_bits", HypothesisSubject::window_depth, {24, 25, 26, 27, 28, 30});
    add_numbers(expected, "sum_bits", HypothesisSubject::window_depth, {24, 25, 26, 27, 28});
    expected.emplace_back("w_slope=last_quad", HypothesisSubject::window_depth);
    expected.emplace_back("offset_rule=fragments", HypothesisSubject::window_depth);
    expected.emplace_back("depth_rounding=floor", HypothesisSubject::window_depth);
    expected.emplace_back("quantize_reference=false", HypothesisSubject::texture_depth);
    expected.emplace_back("plane_anchor=window_corner", HypothesisSubject::window_depth);
    const auto list = depth_hypotheses({});
    CHECK(names_of(list) == expected);
    CHECK(list[0].name == "as given");
    CHECK(first_misnamed(list).empty());
}

TEST_CASE("where the given rules have another value the list has the default instead") {
    RasterRules given{.depth_rounding = DepthRounding::floor, .offset_rule = OffsetRule::fragments};
    given.hypothesis = {.interpolant_bits = full_double,
                        .divide = DivideRule::low_reciprocal,
                        .window_z = WindowZRule::float32,
                        .weights = WeightRule::area,
                        .reciprocal_bits = 24,
                        .reciprocal_deficit = 4,
                        .sum_bits = 24,
                        .quantize_reference = false,
                        .w_slope = WSlope::last_quad,
                        .plane_anchor = PlaneAnchor::window_corner};
    std::vector<Named> expected;
    add_numbers(expected, "interpolant_bits", HypothesisSubject::texture_depth, {16, 17, 18, 19, 20, 21, 22, 23, 24});
    expected.emplace_back("divide=exact", HypothesisSubject::texture_depth);
    expected.emplace_back("divide=cut_reciprocal", HypothesisSubject::texture_depth);
    expected.emplace_back("window_z=chip", HypothesisSubject::window_depth);
    expected.emplace_back("window_z=exact", HypothesisSubject::window_depth);
    expected.emplace_back("weights=area", HypothesisSubject::window_depth);  // with 28 bits
    expected.emplace_back("weights=cut_edges", HypothesisSubject::window_depth);
    add_numbers(expected, "reciprocal_deficit", HypothesisSubject::window_depth, {0, 1, 2, 3});
    add_numbers(expected, "reciprocal_bits", HypothesisSubject::window_depth, {25, 26, 27, 28, 29, 30});
    add_numbers(expected, "sum_bits", HypothesisSubject::window_depth, {25, 26, 27, 28, 29});
    expected.emplace_back("w_slope=first_quad", HypothesisSubject::window_depth);
    expected.emplace_back("offset_rule=corners", HypothesisSubject::window_depth);
    expected.emplace_back("depth_rounding=nearest", HypothesisSubject::window_depth);
    expected.emplace_back("quantize_reference=true", HypothesisSubject::texture_depth);
    expected.emplace_back("plane_anchor=first_vertex", HypothesisSubject::window_depth);
    const auto list = depth_hypotheses(given);
    CHECK(names_of(list) == expected);
    CHECK(list[0].rules == given);
    CHECK(first_misnamed(list).empty());
}

TEST_CASE("the hypotheses of interpolation are those listed in this order for colours and for coordinates") {
    std::vector<Named> expected;
    add_numbers(expected, "vertex_color_bits", HypothesisSubject::color, {12, 13, 14, 15, 16});
    expected.emplace_back("perspective_color=weight_products", HypothesisSubject::color);
    expected.emplace_back("perspective_color=cut_products", HypothesisSubject::color);
    expected.emplace_back("perspective_coordinates=cut_products", HypothesisSubject::coordinates);
    expected.emplace_back("texture_coordinates=cut_weights", HypothesisSubject::coordinates);
    CHECK(names_of(interpolation_hypotheses({})) == expected);
    CHECK(first_misnamed(interpolation_hypotheses({})).empty());
    RasterRules chip;
    chip.interpolation = {14, PerspectiveColor::weight_products, CoordinateRule::cut_weights,
                          PerspectiveCoordinates::cut_products};
    expected.clear();
    add_numbers(expected, "vertex_color_bits", HypothesisSubject::color, {12, 13, 15, 16, 24});
    expected.emplace_back("perspective_color=edge_products", HypothesisSubject::color);
    expected.emplace_back("perspective_color=cut_products", HypothesisSubject::color);
    expected.emplace_back("perspective_coordinates=exact_plane", HypothesisSubject::coordinates);
    expected.emplace_back("texture_coordinates=exact_plane", HypothesisSubject::coordinates);
    CHECK(names_of(interpolation_hypotheses(chip)) == expected);
    CHECK(first_misnamed(interpolation_hypotheses(chip)).empty());
}
