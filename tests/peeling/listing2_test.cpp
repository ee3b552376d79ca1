// Tests Everitt 2001, Listing 2, entered as printed, matrix for matrix, with its slips corrected
// (peeling/reference/errata.md 1): the depths that its state stores and compares, against the depth paths of the
// peeling algorithms.
#include <algorithm>
#include <catch2/catch.hpp>
#include <map>

#include "peeling/programs/layer_quads.h"
#include "pipeline/geforce3/texture_environment.h"
#include "pipeline/region/executor.h"
#include "pipeline/region/fragment_path.h"
#include "pipeline/vertices/matrix.h"
#include "rasterizer/values/depth_quotient.h"
#include "tests/peeling/rendering.h"
#include "tests/support/random_triangles.h"

namespace {

using namespace strata::testing;
using namespace strata::pipeline;
using strata::rasterizer::DepthPath;

constexpr int frame_width = 48, frame_height = 32;

// glMatrixMode(GL_TEXTURE) and the calls after it.
struct TextureMatrix {
    Matrix m = identity;
    TextureMatrix& translate(double x, double y, double z) { return multiply(translation(x, y, z)); }
    TextureMatrix& scale(double x, double y, double z) { return multiply(scaling(x, y, z)); }
    TextureMatrix& multiply(const Matrix& by) {
        m = product(m, by);
        return *this;
    }
};

// `depth_units`: 2^n - 1 of the depth buffer, the driver's factor for rows that hold a depth.
CoordinateUnit unit(const TextureMatrix& texture, double depth_units, bool addresses_texels) {
    CoordinateUnit u{.enabled = true, .gen = eye_position(), .matrix = texture.m};
    u.depth_units = {addresses_texels ? 1 : depth_units, addresses_texels ? 1 : depth_units, depth_units};
    return u;
}

CoordinateUnits listing_2(const Matrix& projection, double depth_units) {
    CoordinateUnits units{};
    units[0].enabled = true;
    units[1] = unit(TextureMatrix{}.translate(0, 0, 0.5).scale(0, 0, 0.5).multiply(projection), depth_units, false);
    Matrix m(0.0);  // row r gets what was q
    m[3][2] = 1;
    units[2] = unit(TextureMatrix{}.multiply(m).multiply(projection), 1, false);
    units[3] = unit(TextureMatrix{}
                        .scale(frame_width, frame_height, 1)
                        .translate(0.5, 0.5, 0.5)
                        .scale(0.5, 0.5, 0.5)
                        .multiply(projection),
                    depth_units, true);
    return units;
}

HiloTexture simple_1x1_uhilo() {
    HiloTexture texture;
    texture.texels = {{0, 0}};
    return texture;
}
const HiloTexture uhilo = simple_1x1_uhilo();

// Stages 0 to 2; with a map, stage 3 compares with it: LEQUAL_R is R <= D.
FragmentPath stages(Target map) {
    FragmentPath path;
    path.shader[0] = {.op = ShaderOp::texture_2d, .texture = {.hilo = &uhilo}};
    path.shader[1] = {.op = ShaderOp::dot_product, .previous = 0, .texture = {}};
    path.shader[2] = {.op = ShaderOp::dot_product_depth_replace, .previous = 0, .texture = {}};
    path.combiners = texture_environment({});
    if (!map.exists()) return path;
    path.shader[3].op = ShaderOp::texture_rectangle;
    path.shader[3].texture.depth = map;
    path.shader[3].texture.compare = {
        .func = CompareFunc::lequal, .mode = DepthTextureMode::luminance, .target = TextureTarget::rectangle};
    path.combiners = peel_combiners(3);
    return path;
}

// With the coordinates that the depth path uses; rasterizer/reference/attributes.md 3.3 states how many codes differ
// with the chip's own.
const DeviceProfile& device_of_paths() {
    static const DeviceProfile device = [] {
        DeviceProfile geforce3 = *find_profile("geforce3");
        geforce3.raster.interpolation.perspective_coordinates = strata::rasterizer::PerspectiveCoordinates::exact_plane;
        return geforce3;
    }();
    return device;
}

struct Scene {
    TriangleScene triangles;
    strata::rasterizer::RasterState raster;
    PreparedDraw list;
    Frame frame;
    Scene(std::uint64_t seed, int count, DepthFormat format, const DeviceProfile& device = device_of_paths())
        : triangles{random_triangles(seed, count)} {
        triangles.list.instances.resize(2);  // only the transparent ones: plain and textured
        triangles.list.instances[1].model = {0.8, 0.1, 0, 0, -0.2, 0.9, 0.1, 0, 0, 0.1, 1.1, 0, 0.05, 0.02, -0.3, 1};
        raster.viewport = {0, 0, frame_width, frame_height};
        raster.depth_format = format;
        const CoordinateUnits units = listing_2(triangles.view.projection, strata::rasterizer::max_code(format));
        list = prepare(triangles.list, triangles.view, raster, device,
                       {.depth_quotient = true, .tile_size = 16, .threads = 1, .units = units});
        frame.profile = &device;
        frame.transparent = &list;
        frame.depth = {DepthPath::window_z, format};
    }
};

using Codes = std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t>;  // by pixel and primitive

// The codes that a pass would store if no surface hid another.
template <class Program>
Codes codes_of(const Frame& frame, PassState state, Program&& program) {
    RegionStatistics statistics;
    Region region{frame, {frame.rect()}, statistics};
    state.needs.code = true;
    Codes codes;
    static_cast<void>(region.draw(state, [&](const FragmentBatch& in, const Loads& loads, Outputs& out) {
        program(in, loads, out);
        for (std::size_t i = 0; i < static_cast<std::size_t>(in.count); ++i)
            if (out.alive[i] != 0)
                codes[{in.pixel[i], in.primitive[i]}] = (out.replaces_depth ? out.depth : in.code)[i];
    }));
    return codes;
}

// Peels only with Listing 2's state.
void peel(Region& region) {
    strata::peeling::SavedLayers layers;
    Target map;
    for (int pass = 0; pass < 20; ++pass) {
        const Target color = region.make_color(), depth = region.make_depth();
        region.clear(color, {});
        region.clear(depth, {});
        PassState state;
        state.alpha = {.enabled = true, .func = CompareFunc::greater, .ref = 0};
        state.depth = {.enabled = true, .func = CompareFunc::less, .write = true};
        state.depth_target = depth;
        state.color[0] = color;
        FragmentPathProgram program{region, stages(map)};
        program.apply(state);
        region.begin_iteration();
        const DrawCounts drawn = region.draw(state, program);
        layers.color.push_back(color);
        layers.depth.push_back(map = region.make_depth());
        region.targets().copy_rectangle(depth, region.frame().rect(), map, 0, 0);
        if (!region.any(drawn.passed, Idle::no)) break;
    }
    publish_quads(region, layers);
}

// What Listing 2's state stores, and the pixels where its stage 3 would read or compare something else.
struct Listed {
    Codes codes;
    std::size_t fragments = 0, other_pixel = 0, other_r = 0;
};
Listed listed(const Scene& scene) {
    RegionStatistics statistics;
    Region region{scene.frame, {scene.frame.rect()}, statistics};
    PassState state;
    FragmentPathProgram listing{region, stages({})};
    listing.apply(state);
    state.needs.units |= 0xf000;  // unit 3, which no stage uses yet
    Listed found;
    found.codes = codes_of(scene.frame, state, [&](const FragmentBatch& in, const Loads& loads, Outputs& out) {
        listing(in, loads, out);
        for (std::size_t i = 0; i < static_cast<std::size_t>(in.count); ++i) {
            const auto over_q = [&](std::size_t c) {
                return strata::rasterizer::divide(in.unit[3][c][i], in.unit[3][3][i],
                                                  scene.frame.profile->raster.hypothesis.divide);
            };
            if (out.alive[i] == 0) continue;
            ++found.fragments;
            found.other_pixel +=
                static_cast<int>(over_q(0)) != in.x[i] || static_cast<int>(over_q(1)) != frame_height - 1 - in.y[i];
            found.other_r += static_cast<std::uint32_t>(over_q(2)) != out.depth[i];
        }
    });
    return found;
}

// The codes that path depth_replace stores.
Codes replaced_codes(const Scene& scene) {
    Frame replaced = scene.frame;
    replaced.depth.path = DepthPath::depth_replace;
    return codes_of(replaced, {}, [](const FragmentBatch&, const Loads&, Outputs&) {});
}

}  // namespace

TEST_CASE("Listing 2's state replaces depth by the bits of depth path depth_replace and compares the same bits") {
    for (const DepthFormat format : {DepthFormat::d16, DepthFormat::d24}) {
        const Scene scene{401, 60, format};
        const Listed found = listed(scene);
        CHECK(found.fragments > 5000);
        CHECK(found.codes == replaced_codes(scene));
        CHECK(found.other_pixel == 0);  // s/q and t/q are always in the fragment's own pixel
        CHECK(found.other_r == 0);      // R is the stored depth
    }
}

// rasterizer/reference/attributes.md 3.3: Everitt's method requires that both quotients come from the same coordinates,
// whichever these are.
TEST_CASE(
    "by the chip's own coordinates Listing 2 stores other codes than path depth_replace but compares those it stored") {
    for (const DepthFormat format : {DepthFormat::d16, DepthFormat::d24}) {
        const Scene scene{401, 60, format, *find_profile("geforce3")};
        const Listed found = listed(scene);
        const Codes by_path = replaced_codes(scene);
        std::size_t other = 0;
        std::uint32_t largest = 0;
        for (const auto& [place, code] : found.codes) {
            const auto same = by_path.find(place);
            if (same == by_path.end() || same->second == code) continue;
            ++other;
            largest = std::max(largest, std::max(code, same->second) - std::min(code, same->second));
        }
        CHECK(found.fragments > 5000);
        CHECK(found.other_r == 0);
        CHECK(found.other_pixel == 0);
        CHECK(other > 0);
        CHECK(largest <= (format == DepthFormat::d16 ? 1u : 8u));
    }
}

TEST_CASE("a peel by Listing 2's state alone is bit-identical to shadow_map_depth_replace in every execution") {
    Scene scene{402, 24, DepthFormat::d24};
    strata::peeling::RenderOptions options;
    options.width = frame_width;
    options.height = frame_height;
    options.threads = 1;
    const auto expected =
        render(scene.triangles.list, scene.triangles.view, {"geforce3", "shadow_map_depth_replace"}, options);
    REQUIRE(expected.outcome == strata::peeling::Outcome::done);
    CHECK(expected.frame.passes.geometry > 5);
    for (const Execution execution : {Execution::literal, Execution::replay}) {
        const FrameResult found = run(scene.frame, peel, execution, 2);
        CHECK(found.color == expected.frame.color);
        CHECK(found.passes.geometry == expected.frame.passes.geometry);
        CHECK(found.work.regions == (execution == Execution::literal ? 1u : 6u));  // no lookup was outside of its tile
    }
}
