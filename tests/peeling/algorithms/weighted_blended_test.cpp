// Tests both forms of weighted_blended against equations 6 to 10 of McGuire and Bavoil 2013 in binary64, and the
// distance from the eye against the projection. peeling/reference/algorithms.md 18.
#include <bit>
#include <catch2/catch.hpp>
#include <cmath>
#include <optional>
#include <random>

#include "peeling/programs/fixed_passes/weighted.h"
#include "peeling/raster_state.h"
#include "tests/peeling/expectations.h"
#include "tests/peeling/rendering.h"

namespace {

using namespace strata::testing;
using strata::peeling::RenderOptions;
using strata::peeling::RenderResult;
using strata::peeling::Weight;
using strata::pipeline::Fault;
using strata::pipeline::Format;
using strata::pipeline::Image;
using strata::pipeline::Rgba;
using strata::pipeline::View;

const ExpectedRow expected_weighted_blended{{.algorithm = "weighted_blended",
                                             .devices = Devices::independent_blending,
                                             .passes = [](int) { return 1; },
                                             .targets = {"sums", "revealage", "result"},
                                             .render_targets = 2}};
const ExpectedRow expected_weighted_blended_shared{{.algorithm = "weighted_blended_shared",
                                                    .devices = Devices::programmable,
                                                    .passes = [](int) { return 1; },
                                                    .targets = {"sums", "weights", "result"},
                                                    .render_targets = 2}};

constexpr double eye_scale = 512;  // parallel projection: window depths 0 to 1 are from 512 in front of the eye to 512
                                   // behind it

View deep_view() {
    View view;
    view.view[2][2] = eye_scale;
    view.projection[2][2] = 1 / eye_scale;
    return view;
}

// The weight by its definition; `depth` is the exact window depth.
double weight_of(Weight weight, double depth, double a) {
    const double z = std::abs(2 * depth - 1) * eye_scale;
    switch (weight) {
        case Weight::eq7: return a * std::clamp(10 / (1e-5 + std::pow(z / 5, 2) + std::pow(z / 200, 6)), 0.01, 3000.0);
        case Weight::eq8: return a * std::clamp(10 / (1e-5 + std::pow(z / 10, 3) + std::pow(z / 200, 6)), 0.01, 3000.0);
        case Weight::eq9: return a * std::clamp(0.03 / (1e-5 + std::pow(z / 200, 4)), 0.01, 3000.0);
        case Weight::eq10: return a * std::max(0.01, 3000 * std::pow(1 - depth, 3));
        case Weight::constant: return 1;
    }
    return 0;
}

struct BlendedPixel {
    std::array<double, 3> color{};
    int fragments = 0;
};

// A weight that no equation has, and its steps, each of few roundings.
strata::peeling::WeightFormula falling_formula() {
    using enum strata::peeling::WeightTerm;
    return {.text = "alpha*exp(-2*z)+distance/512",
            .steps = {{alpha},
                      {number, -2},
                      {depth},
                      {product},
                      {exponential},
                      {product},
                      {distance},
                      {number, 512},
                      {quotient},
                      {sum}}};
}
double falling_weight(double depth, double a) { return a * std::exp(-2 * depth) + std::abs(2 * depth - 1); }

BlendedPixel blended_model(const GivenPixel& pixel, const Rgba& background,
                           const strata::peeling::AlgorithmOptions& options) {
    std::array<double, 3> sum{};
    double weights = 0, through = 1;
    BlendedPixel real;
    for (const GivenFragment& f : visible(pixel)) {
        const double a = f.color[3], w = options.weight_formula ? falling_weight(double{f.depth}, a)
                                                                : weight_of(options.weight, f.depth, a);
        for (std::size_t c = 0; c < 3; ++c) sum[c] += f.color[static_cast<int>(c)] * a * w;
        weights += a * w;
        through *= 1 - a;
        ++real.fragments;
    }
    const Rgba behind = pixel.opaque ? pixel.opaque->color : background;
    for (std::size_t c = 0; c < 3; ++c) {
        const double b = behind[static_cast<int>(c)];
        real.color[c] = weights > 0 ? sum[c] / weights * (1 - through) + b * through : b;
    }
    return real;
}

// The greatest error of colours in [0, 1]. A weight has at most 20 roundings to binary32, including those of its
// constants, and its colour 2 more, in numerator and denominator; the quad has 5. Each of n stores into the two sums
// and the revealage rounds by `stored`.
double allowed_error(int n, double stored) { return (44.0 + 5.0) * 0x1p-24 + (3.0 * n + 3.0) * stored; }

// Up to 7 fragments per pixel, at depths from 0 to where the weight is the least one; some are behind an opaque
// surface.
FragmentScene weighted_pixels(unsigned seed) {
    std::mt19937 random{seed};
    constexpr float depths[]{0, 0.125f, 0.498046875f, 0.50390625f, 0.75f, 0.875f, 0.998046875f};
    const auto eighth = [&](unsigned least) { return static_cast<float>(least + random() % (9 - least)) / 8.0f; };
    FragmentScene scene{16, 16};
    for (GivenPixel& pixel : scene.pixels) {
        for (auto left = random() % 8; left > 0; --left)
            pixel.fragments.push_back({depths[random() % 7], {eighth(1), eighth(1), eighth(1), eighth(4)}});
        if (random() % 4 == 0) pixel.opaque = GivenFragment{0.8125f, {eighth(1), eighth(1), eighth(1), 1}};
    }
    return scene;
}

double stored_value(const Image& image, Format format, std::size_t pixel, std::size_t channel) {
    const std::uint32_t code = image.codes[4 * pixel + channel];
    return format == Format::rgba8 ? code / 255.0 : static_cast<double>(std::bit_cast<float>(code));
}

// A description of the first pixel whose difference from the model exceeds the roundings; empty if there is none.
std::string off_the_model(const FragmentScene& scene, const RenderResult& result, const RenderOptions& options,
                          Format format) {
    for (std::size_t p = 0; p < scene.pixels.size(); ++p) {
        const BlendedPixel real = blended_model(scene.pixels[p], options.background, options.algorithm);
        // Halves round by 2^-11, binary32 by 2^-24; an 8-bit picture by half a code once more.
        const double limit = format == Format::rgba8 ? allowed_error(real.fragments, 0x1p-11) + 0.5 / 255 + 1e-9
                                                     : allowed_error(real.fragments, 0x1p-24);
        for (std::size_t c = 0; c < 3; ++c) {
            const double found = stored_value(result.frame.color, format, p, c);
            if (std::abs(found - real.color[c]) <= limit) continue;
            std::ostringstream text;
            text << "pixel " << p << " channel " << c << ": found " << found << ", expected " << real.color[c];
            return text.str();
        }
    }
    return "";
}

RenderOptions options_over_blue(const FragmentScene& scene, Format format) {
    RenderOptions options = options_for(scene);
    options.color_format = format;
    options.background = {0.25f, 0.5f, 1, 1};
    return options;
}

}  // namespace

TEST_CASE(
    "weighted_blended averages colours by each of its weights and by a formula over the background in both forms and "
    "every "
    "execution") {
    const FragmentScene scene = weighted_pixels(1);
    for (const char* algorithm : {"weighted_blended", "weighted_blended_shared"})
        for (const std::optional<Weight> weight : std::initializer_list<std::optional<Weight>>{
                 Weight::eq7, Weight::eq8, Weight::eq9, Weight::eq10, Weight::constant, std::nullopt})
            for (const Format format : {Format::rgba32f, Format::rgba8}) {
                const char* profile = format == Format::rgba8 ? "geforce8_dx101" : "ideal";
                std::optional<Image> first;
                for (const Running& running : all_ways_of_running) {
                    INFO(algorithm << " on " << profile << ", weight " << (weight ? static_cast<int>(*weight) : -1));
                    RenderOptions options = options_over_blue(scene, format);
                    if (weight) options.algorithm.weight = *weight;
                    if (!weight) options.algorithm.weight_formula = falling_formula();
                    running.apply(options);
                    const RenderResult result = render(draw_list(scene), deep_view(), {profile, algorithm}, options);
                    REQUIRE_FALSE(result.refusal);
                    CHECK(result.frame.passes.geometry == 1);
                    CHECK(off_the_model(scene, result, options, format) == "");
                    if (!first) first = result.frame.color;
                    CHECK(result.frame.color == *first);
                }
            }
}

TEST_CASE("a program computes the distance from the eye from window depth and uniforms of the projection") {
    View view;
    const double near = 0.5, far = 300;
    view.projection = strata::pipeline::Matrix(0.0);
    view.projection[0][0] = view.projection[1][1] = 1;
    view.projection[2][3] = -1;
    for (const bool is_half : {true, false}) {
        strata::rasterizer::RasterState state;
        state.depth_near = 0.25f;
        state.clip_depth =
            is_half ? strata::rasterizer::ClipDepth::minus_one_to_one : strata::rasterizer::ClipDepth::zero_to_one;
        view.projection[2][2] = is_half ? -(far + near) / (far - near) : -far / (far - near);
        view.projection[3][2] = (is_half ? -2 : -1) * far * near / (far - near);
        const auto eye = strata::peeling::eye_distance(view, state);
        for (double distance = near; distance <= far; distance *= 1.25) {
            const double clip = -view.projection[2][2] * distance + view.projection[3][2], ndc = clip / distance;
            const double window = is_half ? 0.25 + 0.75 * (ndc + 1) / 2 : 0.25 + 0.75 * ndc;
            const double found = strata::peeling::distance_at(eye, static_cast<float>(window));
            // Half a unit in the last place of the depth, converted to distance; the uniforms and the quotient have
            // errors of the same size.
            const double slope = distance * distance / (near * 0.75);
            CHECK(std::abs(found - distance) <= slope * 4 * 0x1p-24 + distance * 8 * 0x1p-24);
        }
    }
}

TEST_CASE("weighted_blended does not depend on the submission order and under reversed depth 1 is near") {
    FragmentScene scene{2, 1};
    const GivenFragment near{0.125f, {1, 0.5f, 0.25f, 0.5f}}, far{0.875f, {0.25f, 0.5f, 1, 0.25f}};
    scene.pixels[0].fragments = {near, far};
    scene.pixels[1].fragments = {far, near};
    RenderOptions options = options_over_blue(scene, Format::rgba32f);
    const Image image = render(scene, {"ideal", "weighted_blended"}, options).frame.color;
    for (std::size_t c = 0; c < 4; ++c) CHECK(image.codes[c] == image.codes[4 + c]);
    for (GivenPixel& pixel : scene.pixels)
        for (GivenFragment& f : pixel.fragments) f.depth = 1 - f.depth;
    options.raster.depth_order = strata::rasterizer::DepthOrder::greater;
    CHECK(render(scene, {"ideal", "weighted_blended"}, options).frame.color == image);
}

TEST_CASE("weighted_blended is exact where all fragments of a pixel have one colour for any alphas") {
    FragmentScene scene{1, 1};
    for (int i = 1; i <= 6; ++i)
        scene.pixels[0].fragments.push_back(
            {static_cast<float>(i) / 8.0f, {0.75f, 0.5f, 0.25f, static_cast<float>(i) / 8.0f}});
    for (const char* algorithm : {"weighted_blended", "weighted_blended_shared"})
        CHECK(render(scene, {"ideal", algorithm}).audit.max_difference < 1e-4);
}

TEST_CASE("weighted sums that exceed half precision are reported with their pixels") {
    FragmentScene scene{2, 2};  // 21 weights of 3000 are below 65504, 22 are above
    scene.pixels[1].fragments.assign(21, {0, {1, 1, 1, 1}});
    scene.pixels[2].fragments.assign(22, {0, {1, 1, 1, 1}});
    for (const char* algorithm : {"weighted_blended", "weighted_blended_shared"}) {
        const RenderResult half = render(scene, {"geforce8_dx101", algorithm}, options_over_blue(scene, Format::rgba8));
        REQUIRE(diagnosed(half, Fault::half_saturated) == 1);
        for (const auto& d : half.frame.diagnostics)
            if (d.fault == Fault::half_saturated) {
                CHECK(d.first_x == 0);
                CHECK(d.first_y == 1);
            }
        const RenderResult single = render(scene, {"ideal", algorithm}, options_over_blue(scene, Format::rgba32f));
        CHECK_FALSE(has_diagnostic(single, Fault::half_saturated));
    }
}
