// Tests every exact algorithm on every short sequence of fragments, and on long random ones, against the scalar models
// of tests/support/composite_model.h.
#include <catch2/catch.hpp>

#include "tests/peeling/expectations.h"
#include "tests/peeling/rendering.h"
#include "tests/peeling/sequences/short_sequences.h"
#include "tests/support/composite_model.h"
#include "tests/support/random_numbers.h"

namespace {

using namespace strata::testing;
using strata::peeling::RenderResult;
namespace pipeline = strata::pipeline;

constexpr Rgba background{0.25f, 0.5f, 0.8f, 1};

// `count` pixels of up to `longest` fragments; depths k / 64 with ties, including k = 0 and k = 64 (invisible). Every
// other pixel has an opaque surface at one of these depths.
FragmentScene random_sequences(std::uint64_t seed, std::size_t count, int longest) {
    FragmentScene scene{32, 16};
    Random random{seed};
    const auto random_depth = [&] { return static_cast<float>(random_int(random, 0, 64)) / 64.0f; };
    for (std::size_t p = 0; p < count; ++p) {
        const int length = random_int(random, 0, longest);
        for (int i = 0; i < length; ++i) scene.pixels[p].fragments.push_back({random_depth(), random_color(random)});
        if (p % 2 == 1) scene.pixels[p].opaque = GivenFragment{random_depth(), random_color(random)};
    }
    return scene;
}

struct Statistics {
    std::size_t layers_max = 0, fragments_max = 0, lost = 0, pixels_with_ties = 0;
};

Statistics statistics(const FragmentScene& scene) {
    Statistics s;
    for (const GivenPixel& pixel : scene.pixels) {
        const auto fragments = visible(pixel);
        const std::size_t layers = groups_of(fragments).size();
        s.layers_max = std::max(s.layers_max, layers);
        s.fragments_max = std::max(s.fragments_max, fragments.size());
        s.lost += fragments.size() - layers;
        s.pixels_with_ties += layers < fragments.size() ? 1 : 0;
    }
    return s;
}

// The colour behind the transparent fragments as the target stores it. A surface at depth 1 fails LESS against the
// clear value.
Rgba behind(const GivenPixel& pixel, const TargetModel& target) {
    const bool opaque = pixel.opaque && pixel.opaque->depth < 1.0f;
    Rgba color = opaque ? pixel.opaque->color : background;
    for (float& c : strata::components(color)) c = target.stored(c);
    return color;
}

Rgba model(const std::string& algorithm, const TargetModel& target, const DepthGroups& groups,
           const Rgba& behind_them) {
    if (algorithm == "depth_units" || algorithm.starts_with("shadow_map"))
        return depth_units_model(target, groups, behind_them);
    if (algorithm == "front_to_back") return front_to_back_model(target, groups, behind_them);
    if (algorithm == "dual") return dual_model(target, groups, behind_them);
    if (algorithm == "dual_independent") return dual_independent_model(target, groups, behind_them);
    Rgba oracle{0, 0, 0, 1};
    const auto exact = exact_composite(groups, behind_them);
    for (std::size_t c = 0; c < 3; ++c) oracle[c] = target.stored(static_cast<float>(exact[c]));
    return oracle;
}

// The scene after an alpha test GREATER 0: on 8-bit targets, alphas below half a code are 0.
FragmentScene without_alpha_zero(FragmentScene scene, Format format) {
    const float least = format == Format::rgba8 ? 0.5f / 255.0f : 0x1p-149f;
    for (GivenPixel& pixel : scene.pixels)
        std::erase_if(pixel.fragments, [&](const GivenFragment& f) { return f.color[3] < least; });
    return scene;
}

// The scene with colours as fragments get them: geforce3 keeps the 14 leading bits of a vertex colour.
FragmentScene as_interpolated(FragmentScene scene, const Machine& machine) {
    if (machine.profile != "geforce3") return scene;
    const auto cut = [](Rgba& color) {
        for (float& c : strata::components(color)) {
            int exponent = 0;
            const float mantissa = std::frexp(c, &exponent);
            c = std::ldexp(std::trunc(std::ldexp(mantissa, 14)), exponent - 14);
        }
    };
    for (GivenPixel& pixel : scene.pixels) {
        for (GivenFragment& f : pixel.fragments) cut(f.color);
        if (pixel.opaque) cut(pixel.opaque->color);
    }
    return scene;
}

void check_image(const FragmentScene& scene, const Machine& machine, const RenderResult& result) {
    const TargetModel target{result.frame.color.format};
    const Differences wrong = differences(result.frame.color, [&](std::size_t p) {
        const Rgba color =
            model(machine.algorithm, target, groups_of(visible(scene.pixels[p])), behind(scene.pixels[p], target));
        return std::array{target.code(color[0]), target.code(color[1]), target.code(color[2]), target.code(1.0f)};
    });
    INFO(wrong.first);
    CHECK(wrong.pixels == 0);
}

// Compares with the same composite in binary64, without the target's rounding, where no tie changes the picture.
void check_accuracy(const FragmentScene& scene, const RenderResult& result) {
    const TargetModel target{result.frame.color.format};
    double worst = 0;
    for (std::size_t p = 0; p < scene.pixels.size(); ++p) {
        const auto fragments = visible(scene.pixels[p]);
        const DepthGroups groups = groups_of(fragments);
        if (groups.size() < fragments.size()) continue;
        const auto truth = exact_composite(groups, behind(scene.pixels[p], target));
        for (std::size_t c = 0; c < 3; ++c)
            worst = std::max(worst,
                             std::fabs(double{std::bit_cast<float>(result.frame.color.codes[4 * p + c])} - truth[c]));
    }
    CHECK(worst <= 1.0 / 255.0);
    CHECK(result.audit.max_difference_without_ties <= 1.0);
}

void check_scene(const FragmentScene& given, const Machine& machine, strata::peeling::RenderOptions options) {
    INFO(machine.algorithm << " on " << machine.profile);
    options.background = background;
    const RenderResult result = render(given, machine, options);
    REQUIRE(result.outcome == strata::peeling::Outcome::done);
    const bool tests_alpha = machine.algorithm.starts_with("shadow_map");
    const FragmentScene arriving = as_interpolated(given, machine);
    const FragmentScene scene = tests_alpha ? without_alpha_zero(arriving, result.frame.color.format) : arriving;
    const Statistics expected = statistics(scene);
    CHECK(result.audit.order_errors == 0u);
    CHECK(result.audit.lost_by_ties == (expected_of(machine.algorithm).loses_ties ? expected.lost : 0));
    CHECK(result.audit.ties.pixels == expected.pixels_with_ties);
    CHECK(result.audit.layers_max == static_cast<int>(expected.layers_max));
    CHECK(result.audit.fragments_max == static_cast<int>(expected.fragments_max));
    CHECK(result.frame.passes.geometry == expected_of(machine.algorithm).passes(static_cast<int>(expected.layers_max)));
    check_image(scene, machine, result);
    if (machine.profile == "ideal") check_accuracy(scene, result);
}

// Every combination that pipeline/reference/devices.md 10 allows.
std::vector<Machine> machines() {
    std::vector<Machine> all{{"geforce3", "depth_units"},
                             {"geforce3", "shadow_map"},
                             {"geforce3", "shadow_map_depth_replace"},
                             {"geforce8", "shadow_map"},
                             {"ideal", "shadow_map_depth_replace"}};
    for (const char* profile : {"geforce8", "geforce8_dx101", "ideal"})
        for (const char* algorithm : {"depth_units", "front_to_back", "dual", "dual_independent", "a_buffer"})
            if (std::string{profile} != "geforce8" || std::string{algorithm} != "dual_independent")
                all.push_back({profile, algorithm});
    return all;
}

}  // namespace

TEST_CASE("all 19531 sequences of up to six fragments on five depths give the result of the listing's arithmetic",
          "[slow]") {
    const FragmentScene scene = all_short_sequences(20240601, short_depths);
    // geforce8_dx101 differs from geforce8 only in the algorithms that it can run: dual_independent is the additional
    // one.
    for (const Machine& machine : machines())
        if (machine.profile != "geforce8_dx101" || machine.algorithm == "dual_independent")
            check_scene(scene, machine, options_for(scene));
}

TEST_CASE("long random sequences with and without an opaque surface give the result of the listing's arithmetic",
          "[slow]") {
    const FragmentScene scene = random_sequences(20240602, 400, 64);
    for (const Machine& machine : machines()) check_scene(scene, machine, options_for(scene));
}

TEST_CASE("half-float and binary32 targets of a device round every blend as in the listing's arithmetic") {
    const FragmentScene scene = random_sequences(20240603, 400, 12);
    for (const char* algorithm : {"depth_units", "front_to_back", "dual", "dual_independent"})
        for (const Format format : {Format::rgba16f, Format::rgba32f}) {
            auto options = options_for(scene);
            options.color_format = format;
            options.background = background;
            const RenderResult result = render(scene, {"geforce8_dx101", algorithm}, options);
            const TargetModel target{format};
            const Differences wrong = differences(result.frame.color, [&](std::size_t p) {
                const Rgba color =
                    model(algorithm, target, groups_of(visible(scene.pixels[p])), behind(scene.pixels[p], target));
                return std::array{target.code(color[0]), target.code(color[1]), target.code(color[2]),
                                  target.code(1.0f)};
            });
            INFO(algorithm << " into " << pipeline::info(format).name << ", " << wrong.first);
            CHECK(wrong.pixels == 0);
        }
}

TEST_CASE("the depth image holds the nearest visible depth or the opaque surface's or 1") {
    const FragmentScene scene = random_sequences(20240604, 400, 12);
    for (const Machine& machine :
         {Machine{"geforce8", "dual"}, {"geforce8", "front_to_back"}, {"ideal", "depth_units"}}) {
        const RenderResult result = render(scene, machine);
        std::size_t wrong = 0;
        for (std::size_t p = 0; p < scene.pixels.size(); ++p) {
            float nearest = scene.pixels[p].opaque ? scene.pixels[p].opaque->depth : 1.0f;
            for (const GivenFragment& f : visible(scene.pixels[p])) nearest = std::min(nearest, f.depth);
            wrong += result.frame.depth.codes[p] != std::bit_cast<std::uint32_t>(nearest) ? 1 : 0;
        }
        CHECK(wrong == 0);
    }
}
