// scenes/gltf/lights.cpp - checks and converts the lights of a file: KHR_lights_punctual.
//
// Rule     A light stands at its node's origin and shines along -z of the node, whose scale does not matter. The colour
//          in the frame's colour space times intensity / pi is diffuse and specular colour: what a diffuse surface
//          reflects of lux or candela. Points and spots: attenuation 0, 0, 1, and range as in the file, without the
//          extension's fading. Spots: cutoff the outer angle, and the exponent with which as much light is in the cone
//          as between the file's two angles, at most 128. Lights of hidden nodes are off.
// Source   glTF, KHR_lights_punctual; scenes/reference/scenes.md 10.8.
// Tests    tests/scenes/gltf/gltf_lights_test.cpp
#include <algorithm>
#include <cmath>
#include <limits>

#include "scenes/gltf/check.h"
#include "scenes/gltf/material.h"
#include "scenes/gltf/nodes.h"
#include "scenes/numbers/elementary.h"

namespace strata::scenes {

namespace {

constexpr const char* extension = "KHR_lights_punctual";
constexpr double usual_outer = pi / 4;

std::optional<JsonAt> extension_of(const JsonAt& owner) {
    const auto extensions = owner.find("extensions");
    return extensions ? extensions->find(extension) : std::nullopt;
}

double number_or(const JsonAt& owner, const char* key, double otherwise) {
    const auto value = owner.find(key);
    return value ? value->number() : otherwise;
}

void check_number(const JsonAt& owner, const char* key, const char* expected, bool (*is_right)(double)) {
    const auto value = owner.find(key);
    if (value && !is_right(value->number())) value->fail("VALUE_NOT_IN_RANGE", expected);
}

void check_spot(const JsonAt& spot) {
    const double inner = number_or(spot, "innerConeAngle", 0), outer = number_or(spot, "outerConeAngle", usual_outer);
    if (!(outer > 0 && outer <= pi / 2))
        spot.member("outerConeAngle").fail("VALUE_NOT_IN_RANGE", "an angle above 0 and of at most pi / 2");
    if (!(inner >= 0 && inner < outer))
        (spot.has("innerConeAngle") ? spot.member("innerConeAngle") : spot.member("outerConeAngle"))
            .fail("VALUE_NOT_IN_RANGE", "an inner angle from 0 to below the outer one");
}

void check_light(const JsonAt& light) {
    const JsonAt type = light.member("type");
    const std::string kind = type.string();
    if (kind != "directional" && kind != "point" && kind != "spot")
        type.fail("VALUE_NOT_IN_LIST", "directional, point or spot");
    if (const auto color = light.find("color")) {
        color->numbers(3);
        for (const JsonAt& channel : color->elements())
            if (!(channel.number() >= 0 && channel.number() <= 1))
                channel.fail("VALUE_NOT_IN_RANGE", "a number from 0 to 1");
    }
    check_number(light, "intensity", "an intensity from 0 to 1e9", [](double v) { return v >= 0 && v <= 1e9; });
    check_number(light, "range", "a distance above 0", [](double v) { return v > 0; });
    if (kind == "spot") check_spot(light.member("spot").object());
}

// Of all directions of the cone by the file: 1 to the inner angle, then the square of a ramp of cosines.
double flux_of_ramp(double inner, double outer) { return (1 - inner) + (inner - outer) / 3; }
// The same of a power of the cosine.
double flux_of_power(double exponent, double outer) { return (1 - pow(outer, exponent + 1)) / (exponent + 1); }

// By halving the interval; the flux falls with the exponent.
float exponent_of(double inner, double outer) {
    const double wanted = flux_of_ramp(inner, outer);
    double low = 0, high = 128;
    for (int step = 0; step < 40; ++step) {
        const double middle = (low + high) / 2;
        (flux_of_power(middle, outer) > wanted ? low : high) = middle;
    }
    return static_cast<float>((low + high) / 2);
}

Vec3 as_floats(const Vec3d& v) { return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)}; }

void set_cone(pipeline::Light& light, const JsonAt& spot) {
    const double inner = number_or(spot, "innerConeAngle", 0), outer = number_or(spot, "outerConeAngle", usual_outer);
    light.cutoff = std::clamp(static_cast<float>(outer * 180 / pi), std::numeric_limits<float>::min(), 90.0f);
    light.exponent = exponent_of(cos(inner), std::max(cos(outer), 0.0));
}

}  // namespace

void check_lights(const JsonAt& root, Faults& faults) {
    const auto lights = extension_of(root);
    if (lights) faults.collect_each(*lights, "lights", check_light);
    const std::size_t count = lights ? lights->size("lights") : 0;
    faults.collect_each(root, "nodes", [&](const JsonAt& node) {
        if (const auto its = extension_of(node)) (void)its->member("light").index(count);
    });
}

std::optional<std::size_t> light_of(const JsonAt& node) {
    const auto its = extension_of(node);
    return its ? std::optional{its->member("light").json().get<std::size_t>()} : std::nullopt;
}

pipeline::Light to_light(const JsonAt& root, std::size_t number, const PlacedNode& placed, const FileLocation& location,
                         pipeline::ColorSpace space) {
    using pipeline::LightType;
    const JsonAt light = extension_of(root)->elements("lights")[number];
    const std::string kind = light.member("type").string();
    pipeline::Light made{.type = kind == "directional" ? LightType::directional
                                 : kind == "point"     ? LightType::point
                                                       : LightType::spot};
    pipeline::Rgba color{1, 1, 1, 1};
    if (const auto given = light.find("color"))
        for (std::size_t c = 0; c < 3; ++c) color[c] = static_cast<float>(given->elements()[c].number());
    color = frame_color(color, space);
    const double factor = number_or(light, "intensity", 1) / pi;
    for (std::size_t c = 0; c < 3; ++c)
        made.diffuse[c] = made.specular[c] = static_cast<float>(double{color[c]} * factor);
    const Vec3d z = column(placed.world, 2);
    const double largest = std::max({std::abs(z.x), std::abs(z.y), std::abs(z.z)});
    if (made.type != LightType::point && !(largest > 0))
        location.fail("VALUE_NOT_IN_RANGE", "a light whose node has a z axis", "an axis of length 0");
    if (largest > 0) made.direction = as_floats({-z.x / largest, -z.y / largest, -z.z / largest});
    made.position = as_floats(column(placed.world, 3));
    if (made.type == LightType::directional) return made;
    for (const float coordinate : components(made.position))
        if (!std::isfinite(coordinate))
            location.fail("VALUE_NOT_IN_RANGE", "a light at a place that binary32 has", "a larger coordinate");
    made.attenuation = {0, 0, 1};
    if (light.has("range"))
        made.range = std::max(static_cast<float>(light.member("range").number()), std::numeric_limits<float>::min());
    if (made.type == LightType::spot) set_cone(made, light.member("spot"));
    return made;
}

}  // namespace strata::scenes
