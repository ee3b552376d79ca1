// Tests memory that begins at the lower left corner. A projection that flips the scene, drawn from the upper left
// corner by a device with the same rules, must give the same memory; front faces are then clockwise. Its rows in
// reverse order are the picture.
#include <algorithm>
#include <catch2/catch.hpp>

#include "peeling/audit/region_trace.h"
#include "peeling/registry.h"
#include "peeling/truth/truth.h"
#include "tests/peeling/rendering.h"
#include "tests/support/random_triangles.h"

namespace {

using namespace strata::testing;
using namespace strata::pipeline;
using strata::peeling::Algorithm;
using strata::peeling::find_algorithm;
using strata::peeling::FrameFragments;
using strata::peeling::Renderer;
using strata::peeling::RenderOptions;
using strata::peeling::RenderResult;
using strata::rasterizer::FrontFace;
using strata::rasterizer::TieRule;

constexpr int width = 37, height = 23;

// The same memory, drawn from below, and flipped from above.
struct Both {
    TriangleScene scene;
    DeviceProfile below, above;
    RenderOptions options{}, turned_options{};
    View turned{};
};

Both both(const char* profile, std::uint64_t seed) {
    Both all{.scene = random_triangles(seed, 30), .below = *find_profile(profile), .above = *find_profile(profile)};
    all.below.origin = Origin::lower_left;
    all.turned = all.scene.view;
    for (int column = 0; column < 4; ++column) all.turned.projection[column][1] = -all.turned.projection[column][1];
    all.options.width = width;
    all.options.height = height;
    all.options.keep_layers = true;
    all.options.tile_size = 8;
    all.turned_options = all.options;
    all.turned_options.raster.front_face = FrontFace::clockwise;
    return all;
}

// The rows in reverse order.
Image turned_over(const Image& image) {
    Image result = image;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            for (int c = 0; c < image.channels(); ++c)
                result.codes[result.index(x, y, c)] = image.codes[image.index(x, image.height - 1 - y, c)];
    return result;
}

}  // namespace

TEST_CASE("a picture from the lower left corner is memory with its rows reversed and so are depths and layers") {
    for (const char* profile : {"geforce3", "geforce8", "llvmpipe", "softpipe"})
        for (const char* name : {"front_to_back", "unsorted", "shadow_map_depth_replace", "dual", "depth_units"}) {
            const Algorithm& algorithm = *find_algorithm(name);
            Both all = both(profile, 7);
            all.options.keep_layers = all.turned_options.keep_layers = algorithm.makes_layers;
            Renderer below{all.scene.list, all.scene.view, all.below, all.options};
            Renderer above{all.scene.list, all.turned, all.above, all.turned_options};
            const RenderResult shown = below.render(algorithm), memory = above.render(algorithm);
            INFO(profile << ' ' << name);
            REQUIRE(shown.refusal.has_value() == memory.refusal.has_value());
            if (shown.refusal) continue;
            CHECK(shown.frame.color == turned_over(memory.frame.color));
            CHECK(shown.frame.color != memory.frame.color);
            CHECK(shown.frame.depth == turned_over(memory.frame.depth));
            REQUIRE(shown.frame.layers.size() == memory.frame.layers.size());
            for (std::size_t i = 0; i < shown.frame.layers.size(); ++i) {
                CHECK(shown.frame.layers[i].color == turned_over(memory.frame.layers[i].color));
                CHECK(shown.frame.layers[i].depth == turned_over(memory.frame.layers[i].depth));
            }
            CHECK(below.depth_pass().frame.depth == turned_over(above.depth_pass().frame.depth));
        }
}

TEST_CASE("a scissor counts from the picture's upper left corner for any origin and keeps the pixels outside of it") {
    Both all = both("geforce8", 7);
    all.options.raster.scissor = strata::rasterizer::Rect{3, 2, 20, 11};
    all.turned_options.raster.scissor = strata::rasterizer::Rect{3, height - 11, 20, height - 2};
    const Algorithm& algorithm = *find_algorithm("dual");
    Renderer below{all.scene.list, all.scene.view, all.below, all.options};
    Renderer above{all.scene.list, all.turned, all.above, all.turned_options};
    const Image shown = below.render(algorithm).frame.color;
    CHECK(shown == turned_over(above.render(algorithm).frame.color));
    int drawn = 0, strays = 0;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const bool is_inside = x >= 3 && x < 20 && y >= 2 && y < 11;
            const bool is_drawn = shown.codes[shown.index(x, y, 0)] + shown.codes[shown.index(x, y, 1)] > 0;
            (is_inside ? drawn : strays) += is_drawn ? 1 : 0;
        }
    CHECK(drawn > 50);
    CHECK(strays == 0);
}

TEST_CASE("pixels that are named from the lower left corner are those of the picture") {
    const Both all = both("geforce8", 3);
    Renderer below{all.scene.list, all.scene.view, all.below, all.options};
    Renderer above{all.scene.list, all.turned, all.above, all.turned_options};
    const Algorithm& algorithm = *find_algorithm("front_to_back");
    const auto in_picture = [](std::uint32_t pixel) { return (height - 1 - pixel / width) * width + pixel % width; };
    const FrameFragments shown = below.fragments(algorithm), memory = above.fragments(algorithm);
    REQUIRE(shown.all.size() == memory.all.size());
    REQUIRE(!shown.all.empty());
    for (std::size_t i = 0; i < shown.all.size(); ++i) {
        CHECK(shown.all[i].pixel == in_picture(memory.all[i].pixel));
        CHECK(shown.all[i].primitive == memory.all[i].primitive);
        CHECK(shown.all[i].code == memory.all[i].code);
    }
    for (std::uint32_t p = 0; p < width * height; ++p) CHECK(shown.opaque[in_picture(p)] == memory.opaque[p]);

    const RenderResult seen = below.render(algorithm), held = above.render(algorithm);
    CHECK(seen.audit.ties.pixels > 0);
    CHECK(seen.audit.ties.first_y == height - 1 - held.audit.ties.first_y);
    REQUIRE(!seen.frame.diagnostics.empty());
    for (std::size_t i = 0; i < seen.frame.diagnostics.size(); ++i) {
        const Diagnostic &a = seen.frame.diagnostics[i], &b = held.frame.diagnostics[i];
        CHECK(a.first_x == b.first_x);
        CHECK(a.first_y == (b.first_y < 0 ? b.first_y : height - 1 - b.first_y));
    }

    // Each composited fragment belongs to the picture's pixel.
    std::vector<strata::peeling::RegionTrace> traces;
    static_cast<void>(below.render_traced(algorithm, traces));
    std::uint64_t entries = 0, strays = 0;
    for (const auto& trace : traces)
        for (const auto& entry : trace.entries) {
            const auto across = static_cast<std::uint32_t>(trace.rect.width());
            const std::uint32_t x = static_cast<std::uint32_t>(trace.rect.x0) + entry.pixel % across;
            const std::uint32_t y = static_cast<std::uint32_t>(trace.rect.y0) + entry.pixel / across;
            ++entries;
            strays += std::ranges::none_of(
                shown.all, [&](const CapturedFragment& f) { return f.pixel == y * width + x && f.code == entry.key; });
        }
    CHECK(entries > 0);
    CHECK(strays == 0);
}

TEST_CASE("the chain to the truth begins at the machine's picture also from the lower left corner") {
    Both all = both("geforce8", 11);
    all.options.keep_layers = false;
    Renderer below{all.scene.list, all.scene.view, all.below, all.options};
    const auto machine = strata::peeling::real_image(below.render(*find_algorithm("depth_units")).frame.color);
    CHECK(strata::peeling::render_chain({all.scene.list, all.scene.view, all.below, all.options},
                                        strata::peeling::device_chain) == machine);
}

TEST_CASE("a device that draws from another corner keeps its ties on the same sides of the picture") {
    const auto ties = [](TieRule rule) {
        DeviceProfile profile;
        profile.raster.tie_rule = rule;
        const DeviceProfile other = with_origin(profile, Origin::lower_left);
        CHECK(other.origin == Origin::lower_left);
        CHECK(with_origin(profile, Origin::upper_left) == profile);
        CHECK(with_origin(other, Origin::upper_left) == profile);
        return other.raster.tie_rule;
    };
    CHECK(ties(TieRule::top_left) == TieRule::bottom_left);
    CHECK(ties(TieRule::bottom_left) == TieRule::top_left);
    CHECK(ties(TieRule::top_right) == TieRule::bottom_right);
    CHECK(ties(TieRule::bottom_right) == TieRule::top_right);
}

TEST_CASE("rules along clip space's y draw the same picture from either corner") {
    const Both all = both("swiftshader", 5);
    DeviceProfile upper = all.below;
    upper.origin = Origin::upper_left;
    CHECK(with_origin(upper, Origin::lower_left) == all.below);
    Renderer above{all.scene.list, all.scene.view, upper, all.options};
    Renderer below{all.scene.list, all.scene.view, all.below, all.options};
    const Algorithm& algorithm = *find_algorithm("front_to_back");
    CHECK(below.render(algorithm).frame.color == above.render(algorithm).frame.color);
    CHECK(below.render(algorithm).frame.depth == above.render(algorithm).frame.depth);
}
