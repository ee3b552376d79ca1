// Tests KHR_lights_punctual: every property against values worked out by hand, the cone against the integral of its
// light by small steps, and the files that are refused.
#include <catch2/catch.hpp>
#include <cmath>

#include "rasterizer/base/input_error.h"
#include "scenes/far_places.h"
#include "tests/scenes/gltf/gltf_file.h"
#include "tests/scenes/scenes_support.h"

namespace {

using namespace strata::scenes::test;
using strata::Vec3;
using strata::pipeline::Light;
using strata::pipeline::LightType;

constexpr const char* extension = "KHR_lights_punctual";
constexpr float pi = 3.14159265f;

// A file that requires the extension, with a triangle and a node for each light.
GltfFile lit(const std::vector<Json>& lights, const Json& node = Json::object()) {
    GltfFile file;
    file.show({{"attributes", {{"POSITION", file.positions({0, 0, 0, 1, 0, 0, 0, 1, 0})}}}});
    file.json["extensionsUsed"] = file.json["extensionsRequired"] = Json::array({extension});
    file.json["extensions"][extension]["lights"] = lights;
    for (std::size_t i = 0; i < lights.size(); ++i) {
        Json shown = node;
        shown["extensions"][extension]["light"] = i;
        file.show_node(shown);
    }
    return file;
}

void check_near(const Vec3& found, const Vec3& expected) {
    for (std::size_t c = 0; c < 3; ++c) CHECK(found[c] == Approx(expected[c]).epsilon(1e-6).margin(1e-6));
}

std::string refusal_of(const GltfFile& file) {
    try {
        static_cast<void>(file.load());
    } catch (const strata::InputError& e) {
        return e.what();
    }
    return "";
}

// The share of light in the cone, by a million steps of the cosine.
double share(double cosine_of_cutoff, double (*at)(double cosine, double inner, double outer), double inner) {
    double sum = 0;
    constexpr int steps = 100000;
    for (int i = 0; i < steps; ++i) sum += at(1 - (i + 0.5) / steps * (1 - cosine_of_cutoff), inner, cosine_of_cutoff);
    return sum / steps;
}

}  // namespace

TEST_CASE("lights have the places and directions of their nodes, and lux and candela over pi as colours") {
    const double half = 0.7071067811865476;
    // A quarter turn about x: -z becomes y. The scale does not count.
    const auto file = lit({{{"type", "directional"}, {"intensity", 6}, {"color", {1, 0.5, 0}}},
                           {{"type", "point"}, {"range", 7}},
                           {{"type", "spot"}, {"spot", {{"outerConeAngle", 0.5}}}, {"intensity", 2}}},
                          {{"translation", {1, 2, 3}}, {"rotation", {half, 0, 0, half}}, {"scale", {2, 2, 2}}});
    const auto scene = file.load({.color_space = strata::pipeline::ColorSpace::linear});
    CHECK(scene.warnings.empty());
    REQUIRE(scene.list.lights.size() == 3);
    const Light &sun = scene.list.lights[0], &bulb = scene.list.lights[1], &lamp = scene.list.lights[2];
    CHECK(sun.type == LightType::directional);
    check_near(sun.direction, {0, 1, 0});
    check_near(sun.diffuse, {6 / pi, 3 / pi, 0});
    CHECK(sun.specular == sun.diffuse);
    CHECK(sun.ambient == Vec3{0, 0, 0});
    CHECK(bulb.type == LightType::point);
    check_near(bulb.position, {1, 2, 3});
    check_near(bulb.diffuse, {1 / pi, 1 / pi, 1 / pi});
    CHECK(bulb.attenuation == Vec3{0, 0, 1});
    CHECK(bulb.range == 7);
    CHECK(lamp.type == LightType::spot);
    check_near(lamp.direction, {0, 1, 0});
    check_near(lamp.diffuse, {2 / pi, 2 / pi, 2 / pi});
    CHECK(std::isinf(lamp.range));
    CHECK(lamp.cutoff == Approx(0.5 * 180 / double{pi}));
}

TEST_CASE("a light's colour is in the frame's space as a material's is") {
    const auto file = lit({{{"type", "directional"}, {"intensity", 3}, {"color", {1, 0.5, 0}}}});
    // 0.5 encoded as sRGB: 1.055 x 0.5^(1 / 2.4) - 0.055.
    check_near(file.load().list.lights.at(0).diffuse, {3 / pi, 3 / pi * 0.73535698f, 0});
}

TEST_CASE("a spot has as much light in its cone as the file's ramp of cosines") {
    const auto ramp = [](double c, double inner, double outer) {
        const double t = std::clamp((c - outer) / (inner - outer), 0.0, 1.0);
        return t * t;
    };
    for (const auto& [inner, outer] : {std::pair{0.0, 0.785}, std::pair{0.2, 0.6}, std::pair{0.7, 1.5}}) {
        const auto light = lit({{{"type", "spot"}, {"spot", {{"innerConeAngle", inner}, {"outerConeAngle", outer}}}}})
                               .load()
                               .list.lights.at(0);
        const double wanted = share(std::cos(outer), ramp, std::cos(inner));
        const double exponent = double{light.exponent};
        const double found = (1 - std::pow(std::cos(outer), exponent + 1)) / (exponent + 1) / (1 - std::cos(outer));
        INFO(inner << " to " << outer << ": exponent " << exponent);
        CHECK(found == Approx(wanted).epsilon(1e-4));
    }
    // As hard an edge as a cone without a ramp, and as narrow a one as exponents go.
    const auto exponent_of = [](double inner, double outer) {
        return lit({{{"type", "spot"}, {"spot", {{"innerConeAngle", inner}, {"outerConeAngle", outer}}}}})
            .load()
            .list.lights.at(0)
            .exponent;
    };
    CHECK(exponent_of(0.4999999, 0.5) < 1e-3f);
    CHECK(exponent_of(0, 0.01) == Approx(128));
}

TEST_CASE("lights of hidden nodes are off, and so are those after the eighth") {
    auto file = lit({{{"type", "point"}}, {{"type", "point"}}});
    file.json["nodes"][1]["extensions"]["KHR_node_visibility"]["visible"] = false;
    CHECK(file.load().list.lights.size() == 1);
    const auto many = lit(std::vector<Json>(10, {{"type", "point"}})).load();
    CHECK(many.list.lights.size() == 8);
    REQUIRE(many.warnings.size() == 1);
    CHECK(many.warnings[0] ==
          "/nodes/9 (and 1 more): more than 8 lights, which is what the fixed function has: it is off");
}

TEST_CASE("lights move with a scene that is moved to the origin") {
    auto scene = lit({{{"type", "point"}}}, {{"translation", {3, 0, 0}}}).load();
    strata::scenes::recentre(scene);
    check_near(scene.list.lights.at(0).position, {2.5f, -0.5f, 0});
}

TEST_CASE("lights that the extension does not allow are refused with their place") {
    const auto with = [](Json light) { return refusal_of(lit({std::move(light)})); };
    const std::string at = "/extensions/KHR_lights_punctual/lights/0/";
    const auto has = [](const std::string& text, const std::string& part) {
        INFO(text);
        CHECK(text.find(part) != std::string::npos);
    };
    has(with({{"type", "sun"}}), at + "type: expected directional, point or spot, found");
    has(with({{"intensity", 1}}), "UNDEFINED_PROPERTY");
    has(with({{"type", "point"}, {"intensity", -1}}), at + "intensity: expected an intensity from 0 to 1e9, found -1");
    has(with({{"type", "point"}, {"range", 0}}), at + "range: expected a distance above 0, found 0");
    has(with({{"type", "point"}, {"color", {1, 2, 0}}}), at + "color/1: expected a number from 0 to 1, found 2");
    has(with({{"type", "spot"}}), "UNDEFINED_PROPERTY");
    has(with({{"type", "spot"}, {"spot", {{"outerConeAngle", 2}}}}),
        at + "spot/outerConeAngle: expected an angle above 0 and of at most pi / 2, found 2");
    has(with({{"type", "spot"}, {"spot", {{"innerConeAngle", 1}}}}),
        at + "spot/innerConeAngle: expected an inner angle from 0 to below the outer one, found 1");
    has(refusal_of(lit({{{"type", "point"}}}, {{"translation", {1e39, 0, 0}}})),
        "/nodes/1: expected a light at a place that binary32 has, found a larger coordinate");
    CHECK(with({{"type", "point"}, {"range", 1e-50}}).empty());
    CHECK(with({{"type", "spot"}, {"spot", {{"outerConeAngle", 1e-50}}}}).empty());
    auto file = lit({{{"type", "point"}}});
    file.json["nodes"][1]["extensions"][extension]["light"] = 1;
    has(refusal_of(file), "/nodes/1/extensions/KHR_lights_punctual/light: expected");
}
