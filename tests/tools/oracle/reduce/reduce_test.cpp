// Tests reduction with renderers whose mistake is known. A reduced scene is minimal if it fails and no longer fails
// without any one of its triangles.
#include "tools/oracle/reduce/reduce.h"

#include <catch2/catch.hpp>
#include <filesystem>

#include "peeling/registry.h"
#include "rasterizer/base/input_error.h"
#include "scenes/camera.h"
#include "tests/support/skip.h"
#include "tools/oracle/emulations/catalogue.h"
#include "tools/oracle/emulations/mistake_renderer.h"
#include "tools/oracle/reduce/cut_scene.h"
#include "tools/oracle/suite/suite_packs.h"

using namespace strata;
using namespace strata::oracle;

namespace {

Golden golden_of(OpenScene&& opened) {
    Golden golden{.scene = std::move(opened.scene), .profile = opened.profile, .options = opened.options};
    golden.scene.own_view = opened.view;
    golden.algorithms = {opened.algorithm};
    return golden;
}

Golden golden_of(const char* suite_scene) { return oracle::golden_of(*find_suite_scene(suite_scene)); }

// Draws with that mistake, or correctly where the scene cannot have it.
std::optional<Picture> mistaken(const Golden& scene, const char* mistake) {
    const MistakeRenderer mistake_renderer{{scene.scene.list, *scene.scene.own_view, scene.profile, scene.options},
                                           *scene.algorithms[0]};
    const auto picture = mistake_renderer.with(*find_mistake(mistake));
    return picture ? picture : mistake_renderer.right();
}

bool differs(const Golden& scene, const Candidate& candidate) {
    return candidate(scene)->targets[0].codes != right_picture(scene).targets[0].codes;
}

bool differs_in(Kind kind, const Golden& scene, const Candidate& candidate) {
    const Comparison found = compare(right_picture(scene), *candidate(scene), {}, background_of(scene));
    return std::ranges::find(found.kind_of, kind) != found.kind_of.end();
}

// Number of its triangles without which the scene still fails in this kind.
int needless(const Golden& scene, const Candidate& candidate, Kind kind) {
    const auto all = triangles_of(scene.scene.list);
    int count = 0;
    for (std::size_t i = 0; all.size() > 1 && i < all.size(); ++i) {
        auto fewer = all;
        fewer.erase(fewer.begin() + static_cast<std::ptrdiff_t>(i));
        Golden tried = scene;
        tried.scene.list = cut(scene.scene.list, fewer);
        count += differs_in(kind, tried, candidate) ? 1 : 0;
    }
    return count;
}

void check_reduction(const Golden& scene, const char* mistake) {
    INFO(mistake);
    const Candidate candidate = [&](const Golden& tried) { return mistaken(tried, mistake); };
    const auto found = reduce(scene, candidate);
    REQUIRE(found);
    CHECK(found->triangles <= 3);
    CHECK(found->scene.options.width * found->scene.options.height <= 4);
    CHECK(found->triangles == triangles_of(found->scene.scene.list).size());
    CHECK(differs(found->scene, candidate));
    CHECK(needless(found->scene, candidate, found->kind) == 0);
}

}  // namespace

TEST_CASE("a failing scene is reduced to at most three triangles and four pixels and each of them is necessary") {
    check_reduction(golden_of("random.front_to_back"), "last_of_equals");
    check_reduction(golden_of("random.front_to_back"), "one_pass_too_few");
    check_reduction(golden_of("showroom.dual"), "culls_front");
    check_reduction(golden_of("showroom.dual"), "texture_upside_down");
    check_reduction(golden_of("showroom.weighted_average"), "average_without_power");
}

TEST_CASE("settings that the failure does not need are reset to their defaults and the others are kept") {
    const Candidate black = [](const Golden& scene) { return mistaken(scene, "background_lost"); };
    const auto found = reduce(golden_of("showroom.dual"), black);
    REQUIRE(found);
    CHECK(found->scene.options.background == pipeline::Rgba{0.2f, 0.3f, 0.5f, 1});
    CHECK(found->scene.scene.list.textures.empty());
    const Candidate flat = [](const Golden& scene) { return mistaken(scene, "premultiplied_twice"); };
    const auto other = reduce(golden_of("showroom.dual"), flat);
    REQUIRE(other);
    CHECK(other->scene.options.background == peeling::RenderOptions{}.background);
    CHECK(std::ranges::find(other->defaults, "the background") != other->defaults.end());
    CHECK_THAT(other->description(), Catch::Contains("1 triangle in a frame of 1x1"));
}

TEST_CASE("a correct candidate leaves nothing to reduce and one that draws nothing or another size is an error") {
    const Golden scene = golden_of("random.dual");
    CHECK_FALSE(reduce(scene, [](const Golden& s) { return std::optional{right_picture(s)}; }));
    CHECK_THROWS_AS(reduce(scene, [](const Golden&) { return std::optional<Picture>{}; }), InputError);
    CHECK_THROWS_AS(reduce(scene,
                           [](const Golden& s) {
                               Golden larger = s;
                               larger.options.width += 1;
                               return std::optional{right_picture(larger)};
                           }),
                    InputError);
}

TEST_CASE("scenes that the candidate cannot draw are not kept and are counted") {
    const Golden scene = golden_of("random.front_to_back");
    const auto found = reduce(scene, [&](const Golden& tried) {
        const bool is_too_small = triangles_of(tried.scene.list).size() < 10;
        return is_too_small ? std::nullopt : mistaken(tried, "premultiplied_twice");
    });
    REQUIRE(found);
    CHECK(found->triangles == 10);
    CHECK(found->undrawn > 0);
    CHECK_THAT(found->description(), Catch::Contains(" drew nothing"));
}

TEST_CASE("a reduction keeps the kind of the failure even if another kind would be smaller") {
    const Golden scene = golden_of("showroom.front_to_back");
    // Most differing pixels are background; where something is drawn, red and blue are swapped.
    const Candidate both = [](const Golden& tried) {
        const auto lost = mistaken(tried, "background_lost"), swapped = mistaken(tried, "red_for_blue");
        const Picture right = right_picture(tried);
        Picture picture = *swapped;
        const int blue = 128;  // 0.5, the blue of the suite's background
        for (std::size_t i = 0; i < picture.targets[0].pixels(); ++i) {
            const auto first = static_cast<std::ptrdiff_t>(4 * i);
            if (right.targets[0].codes[4 * i] == 51 && right.targets[0].codes[4 * i + 2] == blue)
                std::copy_n(lost->targets[0].codes.begin() + first, 4, picture.targets[0].codes.begin() + first);
        }
        return std::optional{picture};
    };
    const auto found = reduce(scene, both);
    REQUIRE(found);
    const Comparison whole = compare(right_picture(scene), *both(scene), {}, {0.2, 0.3, 0.5, 1});
    const auto most = std::ranges::max_element(whole.kinds, {}, &KindReport::pixels);
    CHECK(found->kind == most->kind);
    CHECK(differs_in(most->kind, found->scene, both));
}

TEST_CASE("differences within a tolerance are no failure and a budget of pixels applies to the whole scene only") {
    const Golden scene = golden_of("random.front_to_back");
    const auto with_noise = [](std::optional<Picture> picture) {
        for (std::size_t i = 0; i < picture->targets[0].codes.size(); i += 4) picture->targets[0].codes[i] ^= 1;
        return picture;
    };
    const Candidate noise = [&](const Golden& tried) { return with_noise(right_picture(tried)); };
    const Candidate mistake = [&](const Golden& tried) { return with_noise(mistaken(tried, "one_pass_too_few")); };
    ReduceRules rules;
    rules.tolerances.color_codes = 1;
    CHECK(reduce(scene, noise));
    CHECK_FALSE(reduce(scene, noise, {}, rules));
    const auto found = reduce(scene, mistake, {}, rules);
    REQUIRE(found);
    CHECK(found->scene.options.width * found->scene.options.height <= 4);
    CHECK(std::ranges::max(found->comparison.distance_of) > 1);

    const std::uint64_t beyond = static_cast<std::uint64_t>(std::ranges::count(
        compare(right_picture(scene), *mistake(scene), rules.tolerances, background_of(scene)).is_beyond, true));
    rules.tolerances.pixels.pixels = beyond;
    CHECK_FALSE(reduce(scene, mistake, {}, rules));
    rules.tolerances.pixels.pixels = beyond - 1;
    const auto paid = reduce(scene, mistake, {}, rules);
    REQUIRE(paid);
    CHECK(paid->scene.options.width * paid->scene.options.height <= 4);
}

TEST_CASE("a failure that needs whole frames is reduced by a scissor and pixels outside of it do not count") {
    const Golden scene = golden_of("random.front_to_back");
    const int width = scene.options.width, height = scene.options.height;
    // Wrong only in frames of that width, and clears to another colour outside of the scissor.
    const Candidate candidate = [&](const Golden& tried) {
        auto picture = tried.options.width == width ? mistaken(tried, "one_pass_too_few") : right_picture(tried);
        const rasterizer::Rect kept = tried.options.raster.scissor.value_or(rasterizer::Rect{0, 0, width, height});
        for (int y = 0; y < tried.options.height; ++y)
            for (int x = 0; x < tried.options.width; ++x)
                if (tried.options.raster.scissor && (x < kept.x0 || x >= kept.x1 || y < kept.y0 || y >= kept.y1))
                    picture->targets[0].codes[4 * static_cast<std::size_t>(y * tried.options.width + x)] = 200;
        return picture;
    };
    const auto cut = reduce(scene, candidate);
    REQUIRE(cut);
    CHECK(cut->scene.options.width == width);
    ReduceRules rules;
    rules.frame = FrameExtent::whole;
    const auto found = reduce(scene, candidate, {}, rules);
    REQUIRE(found);
    CHECK(found->scene.options.width == width);
    CHECK(found->scene.options.height == height);
    CHECK(found->scene.scene.own_view->projection == scene.scene.own_view->projection);
    CHECK(found->window.area() <= 4);
    CHECK(found->scene.options.raster.scissor == found->window);
    CHECK(found->triangles <= 3);
    CHECK_THAT(found->description(), Catch::Contains(" pixels of a frame of "));
    const auto first = std::ranges::find(found->comparison.kinds, found->kind, &KindReport::kind);
    CHECK_THAT(found->description(),
               Catch::Contains("the first at " + std::to_string(found->window.x0 + first->first_x) + "," +
                               std::to_string(found->window.y0 + first->first_y)));
}

TEST_CASE("the view of a cropped window shows the same pixels as the whole window") {
    Golden scene = golden_of("showroom.front_to_back");
    const Picture whole = right_picture(scene);
    const rasterizer::Rect part{16, 32, 48, 64};
    scene.scene.own_view = through(*scene.scene.own_view, 64, 64, part);
    scene.options.width = part.width();
    scene.options.height = part.height();
    const Picture seen = right_picture(scene);
    int wrong = 0;
    for (int y = part.y0; y < part.y1; ++y)
        for (int x = part.x0; x < part.x1; ++x)
            for (int c = 0; c < 4; ++c)
                wrong += whole.targets[0].codes[static_cast<std::size_t>((y * 64 + x) * 4 + c)] !=
                         seen.targets[0].codes[static_cast<std::size_t>(((y - part.y0) * 32 + x - part.x0) * 4 + c)];
    CHECK(wrong == 0);  // powers of two, so no product rounds
}

TEST_CASE("a reduced scene keeps only the named triangles with what they refer to") {
    const pipeline::DrawList list = scenes::load_scene("showroom", {}).list;
    const auto all = triangles_of(list);
    const auto glass = std::ranges::find_if(all, [&](const TriangleName& t) {
        return list.meshes[list.instances[t.instance].mesh].name == "stained glass";
    });
    const TriangleName kept[] = {all[0], *glass};
    const pipeline::DrawList cut_list = cut(list, kept);
    REQUIRE(cut_list.instances.size() == 2);
    CHECK(cut_list.meshes[0].positions.size() == 3);
    CHECK(cut_list.materials[1] == [&] {
        pipeline::Material material = list.materials[list.instances[glass->instance].material];
        material.texture = 0;
        return material;
    }());
    CHECK(cut_list.textures == list.textures);
    CHECK(cut(list, all).instances.size() == list.instances.size());
}

TEST_CASE("lines of a reduced scene stay lines") {
    const pipeline::DrawList list = scenes::load_scene("wireframe", {}).list;
    const auto all = triangles_of(list);
    REQUIRE(all.back().instance == 2);
    const TriangleName ends[] = {all.front(), all.back()};
    const pipeline::DrawList reduced = cut(list, ends);
    REQUIRE(reduced.meshes.size() == 2);
    CHECK(reduced.meshes[0].primitive == pipeline::Primitive::triangles);
    CHECK(reduced.meshes[1].primitive == pipeline::Primitive::lines);
}

TEST_CASE("three failures of a model of 200000 triangles are reduced to at most three triangles and four pixels",
          "[slow]") {
    const std::string model = std::string(STRATA_MODELS_DIR) + "/dragon.glb";
    if (!std::filesystem::exists(model)) {
        strata::test::skip(model + " is not there");
        return;
    }
    OpenScene opened{.scene = scenes::load_scene(model, {}),
                     .view = {},
                     .profile = *pipeline::find_profile("geforce8"),
                     .options = {}};
    opened.options.width = opened.options.height = 256;
    opened.options.alpha = 0.5f;
    opened.view = scenes::orbit_view(opened.scene.bounds, 30, 20, 1);
    opened.algorithm = peeling::find_algorithm("front_to_back");
    const Golden dragon = golden_of(std::move(opened));
    for (const char* mistake : {"one_pass_too_few", "depth_16", "under_without_transmittance"})
        check_reduction(dragon, mistake);
}

TEST_CASE("a cut scene keeps the lights of its file") {
    Golden golden = golden_of("showroom.dual");
    golden.scene.list.lights = {{.direction = {0, -1, 0}}};
    auto few = triangles_of(golden.scene.list);
    few.resize(1);
    CHECK(cut(golden.scene.list, few).lights == golden.scene.list.lights);
}
