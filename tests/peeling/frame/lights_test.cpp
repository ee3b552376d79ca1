// Tests lights in peels against a model in binary64: squares that face along z, each lit by its cosine and distance and
// then composited back to front.
#include <catch2/catch.hpp>
#include <cmath>

#include "rasterizer/base/input_error.h"
#include "tests/peeling/rendering.h"

namespace {

using namespace strata::testing;
using namespace strata::pipeline;
using strata::peeling::RenderOptions;
using strata::peeling::RenderResult;

constexpr int side = 32;

struct Pane {
    double distance;
    Rgba color;
};

const std::vector<Pane> panes{
    {3, {1, 0.5f, 0.25f, 0.5f}}, {1, {0.25f, 1, 0.25f, 0.25f}}, {2, {0.5f, 0.25f, 1, 0.75f}}, {4, {1, 1, 0.5f, 1}}};

// The eye looks along -z and sees x and y from -1 to 1, distances from 0 to 8.
const View along{.view = identity, .projection = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -0.25, 0, 0, 0, -1, 1}};

DrawList lit_list() {
    DrawList list;
    for (const Pane& pane : panes) {
        const auto z = static_cast<float>(-pane.distance);
        const auto number = static_cast<std::uint32_t>(list.meshes.size());
        Mesh mesh;
        mesh.positions = {{-1, -1, z}, {1, -1, z}, {1, 1, z}, {-1, 1, z}};
        mesh.normals.assign(4, {0, 0, 1});
        mesh.indices = {0, 1, 2, 0, 2, 3};
        list.meshes.push_back(mesh);
        list.materials.push_back({.name = "pane",
                                  .front = pane.color,
                                  .back = pane.color,
                                  .alpha_mode = pane.color[3] == 1 ? AlphaMode::opaque : AlphaMode::blend,
                                  .double_sided = true});
        list.instances.push_back({.mesh = number, .material = number});
    }
    return list;
}

// From above at 60 degrees to the normals, and a highlight of a square that the eye at infinity sees.
const std::vector<Light> lamps{
    {.ambient = {0.125f, 0, 0}, .diffuse = {1, 0.5f, 1}, .direction = {0, -0.866025404f, -0.5f}}};
const LightModel glossy{
    .ambient = {0.25f, 0.25f, 0.25f}, .separates_specular = true, .specular = {0.5f, 0.25f, 0}, .shininess = 4};

// What the lamp gives a pane of this colour, with the highlight cos(30 degrees)^4.
double lit(const Rgba& color, std::size_t c) {
    constexpr double ambient[]{0.375, 0.25, 0.25}, diffuse[]{1, 0.5, 1}, specular[]{0.5, 0.25, 0};
    return std::min(1.0, double{color[c]} * (ambient[c] + 0.5 * diffuse[c]) + 0.5625 * specular[c]);
}

std::array<double, 3> composited() {
    std::array<double, 3> sum{};
    for (const double distance : {4.0, 3.0, 2.0, 1.0})
        for (const Pane& pane : panes) {
            if (pane.distance != distance) continue;
            for (std::size_t c = 0; c < 3; ++c)
                sum[c] = double{pane.color[3]} * lit(pane.color, c) + (1 - double{pane.color[3]}) * sum[c];
        }
    return sum;
}

RenderOptions with_lights(const std::vector<Light>& lights, const LightModel& model) {
    RenderOptions options;
    options.width = options.height = side;
    options.threads = 1;
    options.lights = lights;
    options.light_model = model;
    return options;
}

}  // namespace

TEST_CASE("a peel composites lit colours and highlights, in the right order by every algorithm") {
    struct Case {
        const char *profile, *algorithm;
        double tolerance;
    };
    constexpr Case cases[]{{"ideal", "front_to_back", 1e-6},         {"ideal", "dual", 1e-6},
                           {"ideal", "linked_list", 1e-6},           {"geforce8", "dual", 3.0 / 255},
                           {"geforce8", "front_to_back", 3.0 / 255}, {"geforce8", "linked_list", 3.0 / 255},
                           {"direct3d11", "dual", 3.0 / 255}};
    for (const auto& [profile, algorithm, tolerance] : cases) {
        const RenderResult result = render(lit_list(), along, {profile, algorithm}, with_lights(lamps, glossy));
        INFO(profile << ' ' << algorithm);
        if (result.outcome == strata::peeling::Outcome::refused) continue;  // linked_list where there are no atomics
        REQUIRE(result.outcome == strata::peeling::Outcome::done);
        CHECK(result.audit.order_errors == 0u);
        for (int c = 0; c < 3; ++c)
            CHECK(std::fabs(value_in(result.frame.color, side / 2, side / 2, c) -
                            composited()[static_cast<std::size_t>(c)]) <= tolerance);
    }
}

// The quotient instead of the power of 4 is within 0.07 of it (light_registers_test), of at most 0.5.
TEST_CASE("geforce3 peels what its lighting unit gives") {
    const RenderResult result = render(lit_list(), along, {"geforce3", "depth_units"}, with_lights(lamps, glossy));
    REQUIRE(result.outcome == strata::peeling::Outcome::done);
    CHECK(result.audit.order_errors == 0u);
    for (int c = 0; c < 3; ++c)
        CHECK(std::fabs(value_in(result.frame.color, side / 2, side / 2, c) -
                        composited()[static_cast<std::size_t>(c)]) <= 0.035 + 5.0 / 255);
}

TEST_CASE("a lit frame has the same bits in every execution, with every effect, on one thread or two") {
    constexpr std::pair<const char*, const char*> cases[]{
        {"geforce3", "unsorted"},         {"geforce8", "dual"},          {"geforce8", "weighted_average"},
        {"ideal", "weighted_blended"},    {"ideal", "weighted_average"}, {"ideal", "dual"},
        {"llvmpipe", "weighted_blended"}, {"llvmpipe", "dual"}};
    for (const auto& [profile, algorithm] : cases) {
        INFO(profile << ' ' << algorithm);
        CHECK(is_alike_in_every_way(lit_list(), along, {profile, algorithm}, with_lights(lamps, glossy)));
    }
}

TEST_CASE("lights of the list are those of a frame that asks for none of its own, and none is the light at the eye") {
    DrawList list = lit_list();
    const auto drawn = [&](const std::optional<std::vector<Light>>& lights) {
        RenderOptions options = with_lights({}, glossy);
        options.lights = lights;
        return render(list, along, {"geforce8", "dual"}, options).frame.color.codes;
    };
    const auto at_eye = drawn(std::nullopt), by_lamp = drawn(lamps);
    CHECK(at_eye == drawn(std::vector<Light>{}));
    CHECK(at_eye != by_lamp);
    list.lights = lamps;
    CHECK(drawn(std::nullopt) == by_lamp);
    CHECK(drawn(std::vector<Light>{}) == at_eye);
}

TEST_CASE("lights change nothing of unlit surfaces, and of those without normals") {
    for (const bool is_unlit : {true, false}) {
        DrawList list = lit_list();
        for (Material& material : list.materials) material.unlit = is_unlit;
        for (Mesh& mesh : list.meshes)
            if (!is_unlit) mesh.normals.clear();
        for (const char* profile : {"geforce8", "geforce3"})
            CHECK(render(list, along, {profile, "unsorted"}, with_lights(lamps, glossy)).frame.color.codes ==
                  render(list, along, {profile, "unsorted"}, with_lights({}, {})).frame.color.codes);
    }
}

TEST_CASE("lights that cannot be are refused with their place, whether of the options or of the list") {
    const auto message = [](const std::vector<Light>& lights, const LightModel& model, bool is_of_list) {
        DrawList list = lit_list();
        RenderOptions options = with_lights(lights, model);
        if (is_of_list) list.lights = std::exchange(options.lights, std::nullopt).value();
        try {
            static_cast<void>(render(list, along, {"geforce8", "dual"}, options));
        } catch (const strata::InputError& e) {
            return std::string{e.what()};
        }
        return std::string{};
    };
    CHECK(message({Light{}, {.direction = {0, 0, 0}}}, {}, false) ==
          "render options: lights[1].direction: expected a finite direction that is not 0,0,0, found 0,0,0");
    CHECK(message(std::vector<Light>(9), {}, false) == "render options: lights: expected at most 8, found 9");
    CHECK(message(std::vector<Light>(9), {}, true) == "draw list: lights: expected at most 8, found 9");
    CHECK(message({{.type = LightType::spot, .cutoff = 90.5f}}, {}, true) ==
          "draw list: lights[0].cutoff: expected an angle above 0 and of at most 90 degrees, found 90.5");
    CHECK(message({{.type = LightType::spot, .exponent = -1}}, {}, false) ==
          "render options: lights[0].exponent: expected a number from 0 to 128, found -1");
    CHECK(message({{.type = LightType::point, .attenuation = {0, 0, 0}}}, {}, false) ==
          "render options: lights[0].attenuation: expected three numbers of at least 0, not all 0, found 0,0,0");
    CHECK(message({{.type = LightType::point, .range = 0}}, {}, false) ==
          "render options: lights[0].range: expected a distance above 0, found 0");
    CHECK(message({{.diffuse = {1, -1, 0}}}, {}, false) ==
          "render options: lights[0].diffuse: expected three numbers from 0 to 1e9, found 1,-1,0");
    CHECK(message({}, {.shininess = 129}, false) ==
          "render options: light_model.shininess: expected a number from 0 to 128, found 129");
}
