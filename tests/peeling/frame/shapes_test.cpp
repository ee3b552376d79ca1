// Tests peels of lines and points among triangles: the layers of a pixel are sorted by depth, whatever they belong to.
#include <algorithm>
#include <catch2/catch.hpp>

#include "tests/peeling/rendering.h"
#include "tests/support/random_numbers.h"

namespace {

using namespace strata::testing;
using namespace strata::pipeline;
using strata::peeling::Outcome;
using strata::peeling::RenderOptions;
using strata::peeling::RenderResult;

constexpr int shapes_side = 48;
constexpr std::uint32_t shapes_of_a_kind = 30;  // of each kind

// Positions are in clip space.
void add(DrawList& list, Random& random, Primitive primitive, AlphaMode mode) {
    Mesh mesh;
    mesh.primitive = primitive;
    for (std::uint32_t i = 0; i < 3 * shapes_of_a_kind; ++i) {
        const float x = random_float(random, -1, 1), y = random_float(random, -1, 1), z = random_float(random, -1, 1);
        mesh.positions.push_back({x, y, z});
        Rgba color = random_color(random);
        color[3] = 0.125f + 0.75f * color[3];  // so that no line has alpha below 0 or above 1 beyond its ends
        mesh.colors.push_back(color);
        const std::uint32_t first = i / 3 * 3;
        const bool is_own = primitive == Primitive::triangles || (primitive == Primitive::lines && i % 3 == 2);
        mesh.indices.push_back(is_own ? i : first);
    }
    const auto number = static_cast<std::uint32_t>(list.meshes.size());
    list.meshes.push_back(std::move(mesh));
    list.materials.push_back({.name = "shape", .alpha_mode = mode, .double_sided = true, .unlit = true});
    list.instances.push_back({.mesh = number, .material = number});
}

// Triangles, lines and points, then an opaque line mesh.
DrawList mixed_list() {
    Random random{7};
    DrawList list;
    for (const Primitive primitive : {Primitive::triangles, Primitive::lines, Primitive::points})
        add(list, random, primitive, AlphaMode::blend);
    add(list, random, Primitive::lines, AlphaMode::opaque);
    for (Rgba& color : list.meshes[3].colors) color[3] = 1;
    return list;
}

RenderOptions mixed_options() {
    RenderOptions options;
    options.width = options.height = shapes_side;
    options.threads = 1;
    options.tile_size = 16;
    options.color_format = Format::rgba32f;
    options.raster.line_width_px = 3;
    options.raster.point_size_px = 5;
    options.background = {0, 0, 0, 1};
    return options;
}

// Near to far, what lies behind the opaque surface left out; composited over `behind`.
std::array<double, 3> over(std::vector<CapturedFragment> fragments, std::array<double, 3> behind) {
    std::ranges::stable_sort(fragments, {}, &CapturedFragment::code);
    double through = 1;
    std::array<double, 3> sum{};
    for (const CapturedFragment& f : fragments) {
        for (std::size_t c = 0; c < 3; ++c) sum[c] += through * double{f.color[3]} * double{f.color[c]};
        through *= 1.0 - double{f.color[3]};
    }
    for (std::size_t c = 0; c < 3; ++c) sum[c] += through * behind[c];
    return sum;
}

double value_at(const Image& image, std::size_t pixel, std::size_t c) {
    return double{std::bit_cast<float>(image.codes[4 * pixel + c])};
}

}  // namespace

TEST_CASE("a peel composites lines, points and triangles by depth") {
    const DrawList list = mixed_list();
    DrawList opaque_alone = list;
    opaque_alone.instances.erase(opaque_alone.instances.begin(), opaque_alone.instances.begin() + 3);
    constexpr std::pair<const char*, const char*> shape_machines[]{
        {"ideal", "dual"},        {"ideal", "front_to_back"},  {"ideal", "a_buffer"},
        {"geforce8", "dual"},     {"direct3d11", "dual"},      {"geforce8", "front_to_back"},
        {"ideal", "linked_list"}, {"geforce8", "depth_units"}, {"softpipe", "dual"}};
    for (const auto& [profile, algorithm] : shape_machines) {
        INFO(profile << ' ' << algorithm);
        const RenderOptions options = mixed_options();
        const RenderResult result = render(list, {}, {profile, algorithm}, options);
        REQUIRE(result.outcome == Outcome::done);
        CHECK(result.audit.order_errors.value_or(0) == 0);
        CHECK(result.audit.lost_by_ties == 0);
        CHECK(result.audit.layers_max > 6);
        const Image behind = render(opaque_alone, {}, {profile, algorithm}, options).frame.color;
        strata::peeling::Renderer renderer{list, {}, *find_profile(profile), options};
        const auto fragments = renderer.fragments(*strata::peeling::find_algorithm(algorithm));
        std::array<std::size_t, 3> kinds{};
        std::vector<std::vector<CapturedFragment>> pixels(std::size_t{shapes_side} * shapes_side);
        for (const CapturedFragment& f : fragments.all) {
            if (f.code >= fragments.opaque[f.pixel]) continue;
            pixels[f.pixel].push_back(f);
            ++kinds[f.primitive / shapes_of_a_kind];
        }
        for (const std::size_t kind : kinds) CHECK(kind > 400);
        double worst = 0;

        for (std::size_t p = 0; p < pixels.size(); ++p) {
            const auto expected =
                over(pixels[p], {value_at(behind, p, 0), value_at(behind, p, 1), value_at(behind, p, 2)});
            for (std::size_t c = 0; c < 3; ++c)
                worst = std::max(worst, std::abs(value_at(result.frame.color, p, c) - expected[c]));
        }
        CHECK(worst < 1e-5);
    }
}

TEST_CASE("NV2A's peel keeps the order of lines and points, too") {
    RenderOptions options = mixed_options();
    options.color_format.reset();
    const RenderResult result = render(mixed_list(), {}, {"geforce3", "depth_units"}, options);
    REQUIRE(result.outcome == Outcome::done);
    CHECK(result.audit.order_errors == 0u);
    CHECK(result.audit.max_difference < 6.0);
}

TEST_CASE("lines and points have the same bits in every execution, with tiles of every size, on one thread or two") {
    const DrawList list = mixed_list();
    constexpr std::pair<const char*, const char*> shape_machines[]{{"geforce3", "depth_units"},
                                                                   {"geforce8", "dual"},
                                                                   {"ideal", "front_to_back"},
                                                                   {"ideal", "linked_list"},
                                                                   {"softpipe", "front_to_back"}};
    for (const auto& [profile, algorithm] : shape_machines) {
        std::optional<Image> first;
        for (const Running& running : all_ways_of_running)
            for (const int tile : {8, 64}) {
                RenderOptions options = mixed_options();
                options.color_format.reset();
                running.apply(options);
                options.tile_size = tile;
                options.threads = tile == 8 ? 1 : 2;
                const RenderResult result = render(list, {}, {profile, algorithm}, options);
                REQUIRE(result.outcome == Outcome::done);
                if (first) CHECK(result.frame.color.codes == first->codes);
                if (!first) first = result.frame.color;
            }
    }
}

TEST_CASE("lines and points are refused by devices without a rule for them or for their samples") {
    const auto refused = [](const char* profile, int samples) {
        RenderOptions options = mixed_options();
        options.color_format.reset();
        options.sampling.samples = samples;
        const RenderResult result = render(mixed_list(), {}, {profile, "unsorted"}, options);
        return result.refusal ? result.refusal->feature : std::string{};
    };
    CHECK(refused("llvmpipe", 1) == "");
    CHECK(refused("softpipe", 1) == "");
    CHECK(refused("swiftshader", 1) == "known rule for lines");
    CHECK(refused("geforce8", 4) == "");
    CHECK(refused("llvmpipe", 4) == "multisampling of lines and points");
    CHECK(refused("geforce3", 2) == "multisampling of lines and points");
    CHECK(refused("geforce8", 1) == "");
    RenderOptions by_plane = mixed_options();
    by_plane.color_format.reset();
    by_plane.depth_path = rasterizer::DepthPath::float32_plane;
    for (const char* algorithm : {"unsorted", "dual", "depth_units"}) {
        const RenderResult result = render(mixed_list(), {}, {"ideal", algorithm}, by_plane);
        REQUIRE(result.refusal);
        CHECK(result.refusal->feature == "float32_plane for lines and points, which have no area");
    }
}

TEST_CASE("lines and points of several samples are sorted at each sample and every algorithm that is exact agrees") {
    const DrawList list = mixed_list();
    for (const char* profile : {"geforce8", "ideal", "direct3d11"}) {
        std::optional<Image> first;
        for (const char* algorithm : {"a_buffer", "front_to_back", "dual"}) {
            RenderOptions options = mixed_options();
            options.sampling.samples = 4;
            const RenderResult result = render(list, {}, {profile, algorithm}, options);
            INFO(profile << ", " << algorithm);
            REQUIRE(result.outcome == Outcome::done);
            CHECK(result.audit.order_errors == 0);
            CHECK(result.audit.max_difference < 1e-3);
            if (first) CHECK(result.frame.depth.codes == first->codes);
            if (!first) first = result.frame.depth;
        }
    }
    RenderOptions by_pixel = mixed_options();
    by_pixel.sampling.samples = 4;
    by_pixel.raster.interpolation = strata::rasterizer::Interpolation::centre;
    const RenderResult refused = render(list, {}, {"geforce8", "dual"}, by_pixel);
    REQUIRE(refused.refusal);
    CHECK(refused.refusal->feature == "lines and points whose values are those of a pixel of several samples");
}
