// Tests GeForce3's fragment path in a pass: replaced depths, depth textures of the region, and lookups outside of the
// region.
#include "pipeline/region/fragment_path.h"

#include <catch2/catch.hpp>
#include <stdexcept>

#include "pipeline/device/check.h"
#include "pipeline/geforce3/texture_environment.h"
#include "pipeline/vertices/matrix.h"
#include "tests/pipeline/frames.h"
#include "tests/support/random_numbers.h"

namespace {

using namespace strata::testing;
using namespace strata::pipeline;
using strata::rasterizer::Rect;

constexpr int path_width = 16, path_height = 8;
constexpr std::uint32_t last_code = 0xffffff;

// s and t of a unit are the window position with y up, offset by (dx, dy) texels; r and q are given by rows of the clip
// position.
CoordinateUnit screen_aligned(double dx, double dy, const Plane4& r) {
    CoordinateUnit unit{.enabled = true, .gen = eye_position()};
    unit.matrix = product(translation(dx + path_width / 2.0, dy + path_height / 2.0, 0),
                          scaling(path_width / 2.0, path_height / 2.0, 1));
    for (std::size_t c = 0; c < 4; ++c) unit.matrix[c][2] = r[c];
    return unit;
}

// A few layers on every pixel, at window depths k / 64.
FragmentScene layers(std::uint64_t seed) {
    FragmentScene scene{path_width, path_height};
    Random random{seed};
    for (GivenPixel& pixel : scene.pixels)
        for (int i = random_int(random, 0, 4); i-- > 0;)
            pixel.fragments.push_back({static_cast<float>(random_int(random, 0, 63)) / 64.0f, {1, 0.5f, 0.25f, 0.5f}});
    return scene;
}

// r is z of the clip position in [-1, 1], scaled to depth units.
Plane4 depth_row() { return {0, 0, last_code * 0.5, last_code * 0.5}; }

// Scale and offset of the vertex's z in buffer units are rounded to binary32 one after the other.
std::uint32_t stored(float depth) {
    const auto scaled = static_cast<float>((2.0 * depth - 1.0) * (last_code * 0.5));
    return static_cast<std::uint32_t>(static_cast<float>(double{scaled} + last_code * 0.5));
}

FragmentPath compare_with(Target depth, CompareFunc func, std::size_t unit = 3) {
    FragmentPath path;
    path.shader[unit].op = ShaderOp::texture_rectangle;
    path.shader[unit].texture.depth = depth;
    path.shader[unit].texture.compare = {
        .func = func, .mode = DepthTextureMode::intensity, .target = TextureTarget::rectangle};
    path.combiners = peel_combiners(unit);
    return path;
}

PassState peel_state(Target layer, Target depth) {
    PassState state;
    state.alpha = {.enabled = true, .func = CompareFunc::greater, .ref = 0.0f};
    state.depth = {.enabled = true, .func = CompareFunc::less, .write = true};
    state.depth_target = depth;
    state.color[0] = layer;
    return state;
}

// Peels through the state and leaves the second layer's depth in `second`. The comparison keeps what is behind layer
// one.
struct Peel {
    Target first, second;
    explicit Peel(Region& region, std::size_t unit = 3) {
        first = region.make_depth();
        second = region.make_depth();
        const Target texture = region.make_depth();
        region.clear(first, {});
        region.clear(second, {});
        const Target layer = region.make_color();
        FragmentPath path;
        path.combiners = texture_environment({});
        peel(region, path, peel_state(layer, first));
        region.targets().copy_rectangle(first, region.frame().rect(), texture, 0, 0);
        peel(region, compare_with(texture, CompareFunc::lequal, unit), peel_state(layer, second));
        region.publish(layer);
    }
    static void peel(Region& region, const FragmentPath& path, PassState state) {
        FragmentPathProgram program{region, path};
        program.apply(state);
        static_cast<void>(region.draw(state, program));
    }
};

TestFrame frame_of(const FragmentScene& scene, double dx, double dy, std::size_t unit = 3) {
    CoordinateUnits units{};
    units[unit] = screen_aligned(dx, dy, depth_row());
    return TestFrame{draw_list(scene), {}, path_width, path_height, "geforce3", 8, units};
}

}  // namespace

TEST_CASE(
    "a screen-aligned depth texture of any unit peels so that the second pass keeps what is behind the first layer") {
    const std::size_t unit = GENERATE(as<std::size_t>{}, 0, 1, 2, 3);
    const FragmentScene scene = layers(341);
    TestFrame test = frame_of(scene, 0, 0, unit);
    RegionStatistics statistics;
    Region region{test.frame, {test.frame.rect()}, statistics};
    const Peel peel{region, unit};
    std::size_t wrong = 0, second_layers = 0;
    for (std::size_t p = 0; p < scene.pixels.size(); ++p) {
        std::vector<std::uint32_t> codes{last_code, last_code};
        for (const GivenFragment& f : scene.pixels[p].fragments) codes.push_back(stored(f.depth));
        std::sort(codes.begin(), codes.end());
        codes.erase(std::unique(codes.begin(), codes.end()), codes.end());
        const std::uint32_t second = codes.size() > 1 ? codes[1] : last_code;
        wrong +=
            region.storage(peel.first).depth(0)[p] != codes[0] || region.storage(peel.second).depth(0)[p] != second;
        second_layers += second != last_code;
    }
    CHECK(wrong == 0);
    CHECK(second_layers > 30);
}

TEST_CASE(
    "a lookup outside of its region runs the frame literally and one inside does not and both have the same bits") {
    const FragmentScene scene = layers(342);
    for (const double shift : {0.0, 3.0, 9.0}) {
        TestFrame test = frame_of(scene, shift, 0);
        const Body body = [](Region& region) { Peel{region}; };
        const FrameResult literal = run(test.frame, body, Execution::literal, 1);
        // Coordinates are not recorded, whether or not the frame declares that its passes use them.
        const Replay unsaid{1 << 20, {.shader_z = false, .code = true, .color = true}};
        Replay said = unsaid;
        said.needs.units = 0xf000;
        for (const Replay& replay : {Replay{}, unsaid, said}) {
            test.frame.replay = replay;
            const FrameResult found = run(test.frame, body, Execution::replay, 2);
            CHECK(found.color == literal.color);
            CHECK(found.passes == literal.passes);
            CHECK(found.work.regions == (shift == 0 ? 2u : 1u));
        }
    }
}

TEST_CASE("a frame that declares that it needs all of its pixels runs literally") {
    TestFrame test = frame_of(layers(343), 0, 0);
    test.frame.needs_frame = true;
    const Body body = [](Region& region) { Peel{region}; };
    CHECK(run(test.frame, body, Execution::replay, 1).work.regions == 1);
}

TEST_CASE("a replaced depth is used by depth test and buffer and a rejected fragment leaves nothing") {
    FragmentScene scene{path_width, path_height};
    for (GivenPixel& pixel : scene.pixels) pixel.fragments.push_back({0.05f, {1, 1, 1, 1}});
    CoordinateUnits units{};
    for (const std::size_t u : {0u, 1u, 2u}) units[u] = {.enabled = true, .gen = eye_position()};
    units[1].matrix = Matrix(0.0);  // r1 = 2^20 (x + 1/2) of the clip position, negative on the left quarter
    units[1].matrix[0][2] = 0x1p20;
    units[1].matrix[3][2] = 0x1p19;
    units[2].matrix = Matrix(0.0);  // r2 = w
    units[2].matrix[3][2] = 1;
    TestFrame test{draw_list(scene), {}, path_width, path_height, "geforce3", 8, units};
    HiloTexture zero;
    zero.texels = {{0, 0}};
    FragmentPath path;
    path.shader[0] = {.op = ShaderOp::texture_2d, .texture = {.hilo = &zero}};
    path.shader[1] = {.op = ShaderOp::dot_product, .previous = 0, .texture = {}};
    path.shader[2] = {.op = ShaderOp::dot_product_depth_replace, .previous = 0, .texture = {}};
    path.combiners = texture_environment({});
    for (const auto& [near, far] : {std::pair{0.0f, 1.0f}, std::pair{0.0f, 0.0625f}, std::pair{0.03125f, 1.0f}}) {
        PreparedDraw in_range = *test.frame.transparent;
        in_range.geometry.state.depth_near = near;
        in_range.geometry.state.depth_far = far;
        Frame frame = test.frame;
        frame.transparent = &in_range;
        RegionStatistics statistics;
        Region region{frame, {frame.rect()}, statistics};
        const Target depth = region.make_depth(), layer = region.make_color();
        region.clear(depth, {});
        region.clear(layer, {});
        PassState state = peel_state(layer, depth);
        FragmentPathProgram program{region, path};
        program.apply(state);
        CHECK(state.replaces_depth);
        static_cast<void>(region.draw(state, program));
        std::size_t wrong = 0, drawn = 0;
        for (int y = 0; y < path_height; ++y)
            for (int x = 0; x < path_width; ++x) {
                const auto p = static_cast<std::size_t>(y * path_width + x);
                const double clip_x = (x + 0.5) / (path_width / 2.0) - 1.0, expected = 0x1p20 * clip_x + 0x1p19;
                const bool kept = expected >= near * double{last_code} && expected <= far * double{last_code};
                wrong += region.storage(depth).depth(0)[p] != (kept ? static_cast<std::uint32_t>(expected) : last_code);
                wrong += region.storage(layer).code(p, 0, 0) != (kept ? 255u : 0u);
                drawn += kept;
            }
        INFO("depth range " << near << " to " << far);
        CHECK(wrong == 0);
        CHECK(drawn == (near > 0 ? 8u : far < 1 ? 8u : 12u) * path_height);
    }
}

TEST_CASE("texture shaders are rejected by name where the device has none") {
    TestFrame test{layers(344), "geforce8"};
    RegionStatistics statistics;
    Region region{test.frame, {test.frame.rect()}, statistics};
    CHECK_THROWS_WITH(FragmentPathProgram(region, {}),
                      "profile geforce8 has no texture shaders (NV_texture_shader); use geforce3 or ideal");
}

TEST_CASE("a depth texture that is written by its own pass is a feedback loop") {
    TestFrame test = frame_of(layers(345), 0, 0);
    RegionStatistics statistics;
    Region region{test.frame, {test.frame.rect()}, statistics};
    const Target depth = region.make_depth();
    PassState state = peel_state(region.make_color(), depth);
    FragmentPathProgram program{region, compare_with(depth, CompareFunc::lequal)};
    program.apply(state);
    CHECK_THROWS_AS(region.draw(state, program), std::logic_error);
    // A stage that is off reads nothing, whatever texture is set.
    FragmentPath off = compare_with(depth, CompareFunc::lequal);
    off.shader[3].op = ShaderOp::none;
    off.combiners = texture_environment({});
    FragmentPathProgram blind{region, off};
    blind.apply(state);
    CHECK_FALSE(state.replaces_depth);
    CHECK_NOTHROW(region.draw(state, blind));
}

TEST_CASE("a copied rectangle is moved and its bytes counted and it stays within its region or needs the whole frame") {
    const FragmentScene scene = layers(346);
    TestFrame test = frame_of(scene, 0, 0);
    RegionStatistics statistics;
    Region region{test.frame, {test.frame.rect()}, statistics};
    const Target from = region.make_depth(), to = region.make_depth();
    region.clear(from, {});
    region.clear(to, {.depth = 0.0f});
    PassState state = peel_state(region.make_color(), from);
    FragmentPath path;
    path.combiners = texture_environment({});
    Peel::peel(region, path, state);
    const RegionStatistics before = statistics;
    const Rect part{2, 1, 14, 7};
    region.targets().copy_rectangle(from, part, to, 3, -2);
    std::size_t wrong = 0;
    std::uint64_t pixels = 0;
    for (int y = 0; y < path_height; ++y)
        for (int x = 0; x < path_width; ++x) {
            const int sx = x - 3, sy = y + 2;
            const bool written = sx >= part.x0 && sx < part.x1 && sy >= part.y0 && sy < part.y1;
            const auto at = [](int column, int row) { return static_cast<std::size_t>(row * path_width + column); };
            const std::uint32_t expected = written ? region.storage(from).depth(0)[at(sx, sy)] : 0u;
            wrong += region.storage(to).depth(0)[at(x, y)] != expected;
            pixels += written;
        }
    CHECK(wrong == 0);
    CHECK(statistics.counters.bytes_read - before.counters.bytes_read == 4 * pixels);
    CHECK(statistics.counters.bytes_written - before.counters.bytes_written == 4 * pixels);
    CHECK(statistics.loops[0].passes.copies - before.loops[0].passes.copies == 1);

    RegionStatistics tile_statistics;
    Region tile{test.frame, {{0, 0, 8, 8}, 0, Extent::tile}, tile_statistics};
    const Target a = tile.make_depth(), b = tile.make_depth();
    CHECK_NOTHROW(tile.targets().copy_rectangle(a, test.frame.rect(), b, 0, 0));
    CHECK_THROWS_AS(tile.targets().copy_rectangle(a, test.frame.rect(), b, -1, 0), NeedsFrame);
}

TEST_CASE("combiners have the primary colour even if the pass did not request colours") {
    const FragmentScene scene = layers(342);
    TestFrame test = frame_of(scene, 0, 0);
    RegionStatistics statistics;
    Region region{test.frame, {test.frame.rect()}, statistics};
    FragmentPath path;
    path.combiners = texture_environment({});
    PassState state;
    state.needs.color = false;
    FragmentPathProgram{region, path}.apply(state);
    CHECK(state.needs.color);
}
