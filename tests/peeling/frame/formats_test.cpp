// Tests pictures, fronts and backs in different formats, against composite_model.h with a separate model per target;
// and, for every algorithm, against the picture in binary32 rounded by hand.
#include <catch2/catch.hpp>
#include <limits>
#include <optional>

#include "peeling/registry.h"
#include "peeling/truth/truth.h"
#include "tests/peeling/rendering.h"
#include "tests/support/composite_model.h"
#include "tests/support/random_numbers.h"

namespace strata::testing::formats_model {

namespace {

using namespace pipeline;
using peeling::Algorithm;
using peeling::algorithms;
using peeling::RenderOptions;
using peeling::RenderResult;

constexpr Rgba behind_all{0.25f, 0.5f, 0.8f, 1};
constexpr std::array formats{Format::rgba8, Format::rgba16f, Format::rgba32f};

// Up to seven fragments per pixel in random order, with ties; every other pixel has an opaque surface.
FragmentScene random_stacks() {
    FragmentScene scene{16, 8};
    Random random{17};
    const auto depth = [&] { return static_cast<float>(random_int(random, 0, 32)) / 32.0f; };
    for (std::size_t p = 0; p < scene.pixels.size(); ++p) {
        for (std::size_t i = 0; i < p % 8; ++i) scene.pixels[p].fragments.push_back({depth(), random_color(random)});
        if (p % 2 == 1) scene.pixels[p].opaque = GivenFragment{depth(), random_color(random)};
    }
    return scene;
}

RenderOptions with_formats(const FragmentScene& scene, Format color, Format picture) {
    RenderOptions options = options_for(scene);
    options.background = behind_all;
    options.color_format = color;
    options.result_format = picture;
    options.audit = false;
    return options;
}

Rgba expected(const std::string& algorithm, const PeelTargets& targets, const GivenPixel& pixel) {
    Rgba behind = pixel.opaque && pixel.opaque->depth < 1.0f ? pixel.opaque->color : behind_all;
    for (float& c : components(behind)) c = targets.back.stored(c);
    const DepthGroups groups = groups_of(visible(pixel));
    if (algorithm == "dual") return dual_model(targets, groups, behind);
    if (algorithm == "dual_independent") return dual_independent_model(targets, groups, behind);
    if (algorithm == "front_to_back") return front_to_back_model(targets, groups, behind);
    return depth_units_model(targets, groups, behind);
}

void check(const FragmentScene& scene, const std::string& algorithm, const RenderOptions& options) {
    const PeelTargets targets{*options.color_format, options.back_format.value_or(*options.color_format),
                              *options.result_format};
    for (const Running& running : all_ways_of_running) {
        RenderOptions run = options;
        running.apply(run);
        const RenderResult result = render(scene, {"geforce8_dx101", algorithm}, run);
        REQUIRE_FALSE(result.refusal);
        REQUIRE(result.frame.color.format == *options.result_format);
        const Differences wrong = differences(result.frame.color, [&](std::size_t p) {
            const Rgba color = expected(algorithm, targets, scene.pixels[p]);
            const TargetModel& picture = targets.picture;
            return std::array{picture.code(color[0]), picture.code(color[1]), picture.code(color[2]),
                              picture.code(1.0f)};
        });
        INFO(wrong.first);
        CHECK(wrong.pixels == 0);
    }
}

// Codes of a binary32 picture stored in another format; weighted_sum can be negative.
Image stored(const Image& wide, Format format) {
    Image image{format, wide.width, wide.height};
    const TargetModel target{format};
    for (std::size_t i = 0; i < wide.codes.size(); ++i) {
        const auto value = std::bit_cast<float>(wide.codes[i]);
        const std::uint32_t sign = format == Format::rgba16f && value < 0 ? 0x8000u : 0u;
        image.codes[i] = sign | target.code(target.stored(sign == 0 ? value : -value));
    }
    return image;
}

}  // namespace

TEST_CASE("every target is rounded in its own format and the last quad rounds once") {
    const FragmentScene scene = random_stacks();
    for (const Format color : formats)
        for (const Format picture : formats) {
            INFO("colours " << static_cast<int>(color) << ", picture " << static_cast<int>(picture));
            for (const char* algorithm : {"depth_units", "front_to_back", "dual"})
                check(scene, algorithm, with_formats(scene, color, picture));
            for (const Format back : formats) {
                INFO("back " << static_cast<int>(back));
                RenderOptions options = with_formats(scene, color, picture);
                options.back_format = back;
                check(scene, "dual", options);
                check(scene, "dual_independent", options);
            }
        }
}

TEST_CASE("every algorithm's picture is the binary32 picture stored once more for any format of its accumulators") {
    const FragmentScene scene = random_stacks();
    for (const Algorithm& algorithm : algorithms())
        for (const Format color : formats)
            for (const Format picture : formats) {
                const auto drawn = [&](Format format) {
                    return render(scene, {"ideal", algorithm.name}, with_formats(scene, color, format)).frame.color;
                };
                INFO(algorithm.name << ", colours " << static_cast<int>(color) << ", picture "
                                    << static_cast<int>(picture));
                CHECK(drawn(picture) == stored(drawn(Format::rgba32f), picture));
                RenderOptions plain = with_formats(scene, color, color);
                plain.result_format.reset();
                CHECK(drawn(color) == render(scene, {"ideal", algorithm.name}, plain).frame.color);
            }
}

// Sums of these values depend on which zeros and infinities are added, and in which order.
TEST_CASE("colours whose binary32 sums depend on order leave the same bits in every execution") {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    constexpr std::array rare{-0.0f, 0.0f, 1.0f, -0.5f, 2.0f, 3000.0f, 0x1p-140f, infinity, -infinity};
    FragmentScene scene = random_stacks();
    Random random{23};
    const auto one_of = [&] { return rare[static_cast<std::size_t>(random_int(random, 0, std::ssize(rare) - 1))]; };
    for (GivenPixel& pixel : scene.pixels)
        for (GivenFragment& fragment : pixel.fragments)
            for (float& c : components(fragment.color)) c = one_of();
    for (const Algorithm& algorithm : algorithms())
        for (const Format format : {Format::rgba16f, Format::rgba32f}) {
            std::optional<Image> literal;
            for (const Running& running : all_ways_of_running) {
                RenderOptions options = with_formats(scene, format, format);
                running.apply(options);
                const Image image = render(scene, {"ideal", algorithm.name}, options).frame.color;
                INFO(algorithm.name << ", format " << static_cast<int>(format));
                if (!literal) literal = image;
                CHECK(image == *literal);
            }
        }
}

TEST_CASE("a separate back format is rejected where nothing is composited from behind") {
    const FragmentScene scene = random_stacks();
    RenderOptions options = options_for(scene);
    options.back_format = Format::rgba16f;
    const RenderResult result = render(scene, {"geforce8", "front_to_back"}, options);
    REQUIRE(result.refusal);
    CHECK(result.refusal->feature == "separate back format, because it composites from one end only");
    CHECK(result.refusal->algorithm == "front_to_back");
    CHECK_FALSE(render(scene, {"geforce8", "dual"}, options).refusal);
    options.back_format.reset();
    options.result_format = Format::rgba16f;
    CHECK(render(scene, {"geforce3", "depth_units"}, options).refusal);
    CHECK_FALSE(render(scene, {"geforce8", "front_to_back"}, options).refusal);
}

TEST_CASE("the chain to the truth begins at a picture in a format other than that of its colours") {
    const FragmentScene scene = random_stacks();
    const RenderOptions options = with_formats(scene, Format::rgba16f, Format::rgba8);
    const auto list = draw_list(scene);
    const DeviceProfile& profile = *find_profile("geforce8");
    const auto machine = peeling::real_image(render(scene, {"geforce8", "depth_units"}, options).frame.color);
    CHECK(peeling::render_chain({list, {}, profile, options}, peeling::device_chain) == machine);
}

}  // namespace strata::testing::formats_model
