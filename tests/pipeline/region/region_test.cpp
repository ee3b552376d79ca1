// Tests passes through one region: stencil, samples, alpha test, several targets, clears and copies, and invalid
// passes.
#include "pipeline/region/region.h"

#include <algorithm>
#include <bit>
#include <catch2/catch.hpp>
#include <stdexcept>

#include "pipeline/device/check.h"
#include "pipeline/region/region_shortcuts.h"
#include "tests/pipeline/frames.h"

namespace {

using namespace strata::testing;
using namespace strata::pipeline;

// A frame and a region that covers it.
struct Machine {
    TestFrame test;
    strata::pipeline::RegionStatistics statistics;
    Region region;
    Machine(const FragmentScene& scene, const char* profile)
        : test{scene, profile}, region{test.frame, {test.frame.rect()}, statistics} {}
};

// Pixel p gets counts[p] fragments; the i-th has depth 1/2 and red i.
FragmentScene stacks(const std::vector<int>& counts) {
    FragmentScene scene{8, 4};
    for (std::size_t p = 0; p < counts.size(); ++p)
        for (int i = 0; i < counts[p]; ++i)
            scene.pixels[p].fragments.push_back(
                {0.5f, {static_cast<float>(i), 0, 0, static_cast<float>(i % 4) / 4.0f}});
    return scene;
}

void pass_color(const FragmentBatch& in, const Loads&, Outputs& out) { out.color[0] = in.color; }
void write_nothing(const FragmentBatch&, const Loads&, Outputs&) {}

StencilTest every_fragment(StencilOp op) {
    StencilTest stencil;
    stencil.enabled = true;
    stencil.front = {.func = CompareFunc::always, .fail = op, .depth_fail = op, .pass = op};
    return stencil;
}

std::uint32_t stencil_of(const Region& region, Target target, std::size_t pixel, int sample = 0) {
    return region.storage(target).stencil(sample)[pixel];
}

}  // namespace

TEST_CASE("INCR counts depth complexity up to 255 and saturated pixels are counted once") {
    Machine m{stacks({0, 1, 7, 255, 256, 300, 0, 3}), "geforce8"};
    const Target stencil = m.region.make(Format::s8);
    PassState state;
    state.stencil = every_fragment(StencilOp::incr);
    state.stencil_target = stencil;
    static_cast<void>(m.region.draw(state, write_nothing));
    const std::vector<std::uint32_t> expected{0, 1, 7, 255, 255, 255, 0, 3};
    for (std::size_t p = 0; p < expected.size(); ++p) CHECK(stencil_of(m.region, stencil, p) == expected[p]);
    REQUIRE(m.statistics.diagnostics.size() == 1);
    CHECK(m.statistics.diagnostics[0].fault == Fault::stencil_saturated);
    CHECK(m.statistics.diagnostics[0].pixels == 2);  // the pixels with 256 and with 300 fragments
    CHECK(m.statistics.diagnostics[0].first_x == 4);
    CHECK(m.statistics.diagnostics[0].first_y == 0);
}

TEST_CASE("stencil-routed capture keeps the first k fragments of a pixel in k samples and reports an overflow") {
    constexpr int k = 8;
    const std::vector<int> counts{0, 1, 2, 7, 8, 9, 20};
    Machine m{stacks(counts), "geforce8"};
    const Target color = m.region.make(Format::rgba32f, k), stencil = m.region.make(Format::s8, k);
    m.region.clear(color, {.color = {-1, -1, -1, -1}});
    for (int s = 0; s < k; ++s)  // peeling/reference/algorithms.md 13
        m.region.clear(stencil, {.stencil = static_cast<std::uint8_t>(s + 2)}, static_cast<std::uint8_t>(1u << s));
    PassState state;
    state.color[0] = color;
    state.stencil = every_fragment(StencilOp::decr);
    state.stencil.front.func = CompareFunc::equal;
    state.stencil.front.ref = 2;
    state.stencil_target = stencil;
    static_cast<void>(m.region.draw(state, pass_color));
    for (std::size_t p = 0; p < counts.size(); ++p)
        for (int s = 0; s < k; ++s) {
            INFO(counts[p] << " fragments, sample " << s);
            const float red = std::bit_cast<float>(m.region.storage(color).code(p, 0, s));
            CHECK(red == (s < counts[p] ? static_cast<float>(s) : -1.0f));
            CHECK(stencil_of(m.region, stencil, p, s) == static_cast<std::uint32_t>(std::max(0, s + 2 - counts[p])));
        }
    CHECK(stencil_of(m.region, stencil, 4, k - 1) == 1);  // exactly k: no overflow
    CHECK(stencil_of(m.region, stencil, 5, k - 1) == 0);
}

TEST_CASE("a sample mask restricts writes and clears and the query to its samples") {
    Machine m{stacks({0, 0, 3}), "geforce8"};
    const Target color = m.region.make(Format::rgba32f, 4);
    m.region.clear(color, {.color = {5, 5, 5, 5}});
    m.region.clear(color, {.color = {6, 6, 6, 6}}, 0b1000);
    PassState state;
    state.color[0] = color;
    state.sample_mask = 0b0101;
    const DrawCounts drawn = m.region.draw(state, pass_color);
    const std::array<float, 4> expected{2, 5, 2, 6};
    for (int s = 0; s < 4; ++s)
        CHECK(std::bit_cast<float>(m.region.storage(color).code(2, 0, s)) == expected[static_cast<std::size_t>(s)]);
    CHECK(m.region.any(drawn.passed, Idle::no));
    state.sample_mask = 0;
    CHECK_FALSE(m.region.any(m.region.draw(state, pass_color).passed, Idle::no));
}

TEST_CASE("depth and stencil are tested separately for each sample") {
    Machine m{stacks({1}), "geforce8"};
    const Target depth = m.region.make(Format::d32f, 2), color = m.region.make(Format::rgba32f, 2);
    m.region.clear(depth, {.depth = 0.25f}, 0b01);
    m.region.clear(depth, {.depth = 0.75f}, 0b10);
    m.region.clear(color, {.color = {9, 9, 9, 9}});
    PassState state;
    state.depth = {.enabled = true, .func = CompareFunc::less, .write = true};
    state.depth_target = depth;
    state.color[0] = color;
    static_cast<void>(m.region.draw(state, pass_color));
    CHECK(std::bit_cast<float>(m.region.storage(color).code(0, 0, 0)) == 9.0f);
    CHECK(std::bit_cast<float>(m.region.storage(color).code(0, 0, 1)) == 0.0f);
    CHECK(m.region.storage(depth).depth(0)[0] == std::bit_cast<std::uint32_t>(0.25f));
    CHECK(m.region.storage(depth).depth(1)[0] == std::bit_cast<std::uint32_t>(0.5f));
}

TEST_CASE("a depth unit tests each sample separately and has as many samples as the pass") {
    Machine m{stacks({1}), "ideal"};
    const Target unit = m.region.make(Format::d32f, 2), color = m.region.make(Format::rgba32f, 2);
    m.region.clear(unit, {.depth = 0.25f}, 0b01);
    m.region.clear(unit, {.depth = 0.75f}, 0b10);
    m.region.clear(color, {.color = {9, 9, 9, 9}});
    PassState state;
    state.color[0] = color;
    state.depth_unit_count = 1;
    for (const auto& [func, kept] : {std::pair{CompareFunc::less, 1}, {CompareFunc::greater, 0}}) {
        m.region.clear(color, {.color = {9, 9, 9, 9}});
        state.depth_units[0] = {.depth = unit, .func = func};
        static_cast<void>(m.region.draw(state, pass_color));
        for (int s = 0; s < 2; ++s)
            CHECK(std::bit_cast<float>(m.region.storage(color).code(0, 0, s)) == (s == kept ? 0.0f : 9.0f));
    }
    state.depth_units[0].depth = m.region.make(Format::d32f, 1);
    CHECK_THROWS_AS(m.region.draw(state, pass_color), std::logic_error);
    state.depth_units[0].depth = color;
    CHECK_THROWS_AS(m.region.draw(state, pass_color), std::logic_error);
    state.depth_units[0].depth = Target{};
    CHECK_THROWS_AS(m.region.draw(state, pass_color), std::logic_error);
}

TEST_CASE("a target that is read and written in one pass is an error and works only with ordered_rmw") {
    Machine device{stacks({4}), "geforce8"}, ideal{stacks({0, 4, 2}), "ideal"};
    const auto add_red = [](const FragmentBatch& in, const Loads& loads, Outputs& out) {
        out.color[0] = loads.color(0);
        for (std::size_t i = 0; i < static_cast<std::size_t>(in.count); ++i) out.color[0][0][i] += 1.0f;
    };
    const auto loop = [](Region& region, bool ordered) {
        PassState state;
        state.color[0] = region.make(Format::rgba32f);
        state.reads[0] = state.color[0];
        state.ordered_rmw = ordered;
        return state;
    };
    CHECK_THROWS_AS(device.region.draw(loop(device.region, false), add_red), std::logic_error);
    CHECK_THROWS_AS(device.region.full_screen(loop(device.region, false), add_red), std::logic_error);
    CHECK_THROWS_AS(device.region.draw(loop(device.region, true), add_red), Refused);
    const PassState ordered = loop(ideal.region, true);
    static_cast<void>(ideal.region.draw(ordered, add_red));
    CHECK(ideal.region.targets().color(ordered.color[0], 1)[0] == 4.0f);  // four fragments, one after another
    CHECK(ideal.region.targets().color(ordered.color[0], 2)[0] == 2.0f);
}

TEST_CASE("a depth target that is tested and loaded is a feedback loop only while it is written") {
    Machine m{stacks({2}), "geforce8"};
    PassState state;
    state.depth_target = m.region.make_depth();
    state.reads[0] = state.depth_target;
    state.depth = {.enabled = true, .func = CompareFunc::lequal, .write = true};
    CHECK_THROWS_AS(m.region.draw(state, write_nothing), std::logic_error);
    state.depth.write = false;
    CHECK_NOTHROW(m.region.draw(state, write_nothing));
}

TEST_CASE("invalid passes throw logic_error and not Refused") {
    Machine m{stacks({2}), "geforce8"};
    const Target color = m.region.make(Format::rgba8), depth = m.region.make(Format::d24),
                 stencil = m.region.make(Format::s8);
    PassState tests_nothing;
    tests_nothing.depth.enabled = true;
    CHECK_THROWS_AS(m.region.draw(tests_nothing, write_nothing), std::logic_error);
    PassState wrong_kind;
    wrong_kind.color[0] = stencil;
    CHECK_THROWS_AS(m.region.draw(wrong_kind, write_nothing), std::logic_error);
    PassState unequal_samples;
    unequal_samples.color = {color, m.region.make(Format::rgba8, 4)};
    CHECK_THROWS_AS(m.region.draw(unequal_samples, write_nothing), std::logic_error);
    PassState other_codes;  // the frame's depth codes are binary32
    other_codes.depth = {.enabled = true};
    other_codes.depth_target = depth;
    CHECK_THROWS_AS(m.region.draw(other_codes, write_nothing), std::logic_error);
    CHECK_THROWS_AS(m.region.make(Format::rgba8, 16), Refused);
}

TEST_CASE("the alpha test rejects by the program's alpha before depth and stencil") {
    Machine m{stacks({9}), "geforce8"};  // alphas 0, 1/4, 1/2, 3/4, 0, ...
    PassState state;
    state.alpha = {.enabled = true, .func = CompareFunc::greater, .ref = 0.25f};
    state.color[0] = m.region.make(Format::rgba32f);
    state.stencil = every_fragment(StencilOp::incr);
    state.stencil_target = m.region.make(Format::s8);
    static_cast<void>(m.region.draw(state, pass_color));
    CHECK(stencil_of(m.region, state.stencil_target, 0) == 4);
    CHECK(m.region.targets().color(state.color[0], 0)[0] == 7.0f);
    const Counters& counted = m.statistics.counters;
    CHECK(counted.fragments_rasterized == 9);
    CHECK(counted.alpha_killed == 5);
    CHECK(counted.blended == 4);
}

TEST_CASE("without a colour target the alpha test compares 8-bit codes as on an 8-bit target") {
    // 0.25 and 0.2515 have the code 64.
    for (const float ref : {0.2485f, 0.25f, 0.2515f})
        for (const CompareFunc func : {CompareFunc::equal, CompareFunc::gequal, CompareFunc::greater}) {
            Machine m{stacks({9}), "geforce8"};  // alphas 0, 1/4, 1/2, 3/4, 0, ...
            PassState state;
            state.alpha = {.enabled = true, .func = func, .ref = ref};
            state.stencil = every_fragment(StencilOp::incr);
            state.stencil_target = m.region.make(Format::s8);
            static_cast<void>(m.region.draw(state, pass_color));
            const std::uint32_t code = ref < 0.249f ? 63 : 64;  // 255 ref, rounded to nearest
            std::uint32_t living = 0;
            for (const std::uint32_t alpha : {0u, 64u, 128u, 191u, 0u, 64u, 128u, 191u, 0u})
                living += func == CompareFunc::equal    ? alpha == code
                          : func == CompareFunc::gequal ? alpha >= code
                                                        : alpha > code;
            INFO("ref " << ref);
            CHECK(stencil_of(m.region, state.stencil_target, 0) == living);
            CHECK(m.statistics.counters.alpha_killed == 9 - living);
        }
}

TEST_CASE("several targets of one pass have separate outputs and formats and blend states") {
    Machine m{stacks({0, 3}), "geforce8_dx101"};
    PassState state;
    state.color = {m.region.make(Format::rgba8), m.region.make(Format::rg32f), m.region.make(Format::r16f)};
    state.blend = {blend_mode::replace, blend_mode::max, blend_mode::sum};
    state.blend[0].write_mask = 0b0101;
    m.region.clear(state.color[0], {.color = {1, 1, 1, 1}});
    m.region.clear(state.color[1], {.color = {-8, -8, 0, 0}});
    static_cast<void>(m.region.draw(state, [](const FragmentBatch& in, const Loads&, Outputs& out) {
        for (std::size_t i = 0; i < static_cast<std::size_t>(in.count); ++i) {
            const float number = in.color[0][i];
            for (std::size_t c = 0; c < 4; ++c) {
                out.color[0][c][i] = 0.2f;
                out.color[1][c][i] = c == 0 ? -number : number;
                out.color[2][c][i] = 0.5f;
            }
        }
    }));
    const auto code = [&](std::size_t k, int c) { return m.region.storage(state.color[k]).code(1, c, 0); };
    CHECK(std::array{code(0, 0), code(0, 1), code(0, 2), code(0, 3)} == std::array{51u, 255u, 51u, 255u});
    CHECK(std::bit_cast<float>(code(1, 0)) == 0.0f);  // max of -0, -1, -2
    CHECK(std::bit_cast<float>(code(1, 1)) == 2.0f);
    CHECK(code(2, 0) == 0x3e00u);  // 1.5 as a half
}

TEST_CASE("a pass draws only the named primitives in order and an empty range draws nothing") {
    Machine m{stacks({4}), "geforce8"};  // primitives 0 to 3, reds 0 to 3
    const auto drawn_reds = [&](std::vector<PrimitiveRange> ranges) {
        std::vector<float> reds;
        PassState state;
        state.primitives = ranges;
        static_cast<void>(m.region.draw(state, [&](const FragmentBatch& in, const Loads&, Outputs&) {
            for (std::size_t i = 0; i < static_cast<std::size_t>(in.count); ++i) reds.push_back(in.color[0][i]);
        }));
        return reds;
    };
    CHECK(drawn_reds({}) == std::vector<float>{0, 1, 2, 3});
    CHECK(drawn_reds({{1, 3}}) == std::vector<float>{1, 2});
    CHECK(drawn_reds({{0, 1}, {3, 9}}) == std::vector<float>{0, 3});
    CHECK(drawn_reds({{2, 2}}).empty());
}

TEST_CASE("a stencil count that saturates in a routing pass is not a fault") {
    Machine m{stacks({300}), "geforce8"};
    PassState state;
    state.stencil = every_fragment(StencilOp::incr);
    state.stencil_target = m.region.make(Format::s8);
    state.selection.keeps = KeptFragments::submitted;
    static_cast<void>(m.region.draw(state, write_nothing));
    CHECK(stencil_of(m.region, state.stencil_target, 0) == 255);
    CHECK(m.statistics.diagnostics.empty());
}

TEST_CASE("a limit is reached when fewer passes are left than an iteration needs") {
    TestFrame test{stacks({1}), "geforce8"};
    test.frame.max_passes = 3;
    RegionStatistics statistics;
    Region region{test.frame, {test.frame.rect()}, statistics};
    CHECK_FALSE(region.limit_reached(3));
    CHECK(region.limit_reached(4));
    static_cast<void>(region.draw({}, write_nothing));
    CHECK_FALSE(region.limit_reached(2));
    CHECK(region.limit_reached(3));
}

TEST_CASE("a channel that a read target lacks is 0 and alpha is 1") {
    Machine m{stacks({1, 1, 0, 1}), "geforce8"};
    const Target one = m.region.make(Format::r32f), out = m.region.make(Format::rgba32f);
    m.region.clear(one, {.color = {0.375f, 0, 0, 0}});
    m.region.clear(out, {});
    PassState state;
    state.reads[0] = one;
    state.color[0] = out;
    static_cast<void>(m.region.draw(
        state, [](const FragmentBatch&, const Loads& loads, Outputs& o) { o.color[0] = loads.color(0); }));
    for (const std::uint32_t p : {0u, 1u, 3u}) CHECK(m.region.targets().color(out, p) == Rgba{0.375f, 0, 0, 1});
}

TEST_CASE("a copy keeps every bit including NaN payloads and is counted") {
    Machine m{FragmentScene{2, 1}, "geforce8"};
    const Target from = m.region.make(Format::rgba32f), to = m.region.make(Format::rgba32f);
    strata::pipeline::RegionShortcuts{m.region}.store_pixel(
        from, 1, {std::bit_cast<float>(0x7fc12345u), std::bit_cast<float>(0xff800001u), -0.0f, 0x1p-149f});
    m.region.copy(from, to);
    CHECK(m.region.targets().image(to) == m.region.targets().image(from));
    CHECK(m.region.targets().image(to).codes[4] == 0x7fc12345u);
    CHECK(m.region.targets().image(to).codes[5] == 0xff800001u);
    CHECK(m.statistics.loops[0].passes.copies == 1);
}

TEST_CASE("a program reads an 8-bit code as the profile converts it by a quotient or a binary32 product with 1/255") {
    for (const char* profile : {"geforce8", "llvmpipe"}) {
        Machine m{FragmentScene{16, 16}, profile};
        const Target codes = m.region.make(Format::rgba8), values = m.region.make(Format::rgba32f);
        for (std::uint32_t k = 0; k < 256; ++k) {
            const float value = static_cast<float>(k) / 255.0f;
            strata::pipeline::RegionShortcuts{m.region}.store_pixel(codes, k, {value, value, value, value});
        }
        PassState state;
        state.color[0] = values;
        state.reads = {codes};
        static_cast<void>(m.region.full_screen(
            state, [](const FragmentBatch&, const Loads& loads, Outputs& out) { out.color[0] = loads.color(0); }));
        const auto found = m.region.targets().image(values).codes;
        // A binary32 times a code has at most 32 bits: binary64 represents the product exactly, and the cast rounds it
        // once.
        int wrong = 0, unlike_quotient = 0;
        for (std::uint32_t k = 0; k < 256; ++k) {
            const float quotient = static_cast<float>(k) / 255.0f;
            const auto product = static_cast<float>(static_cast<double>(k) * double{1.0f / 255.0f});
            const float expected = profile == std::string_view{"llvmpipe"} ? product : quotient;
            for (std::size_t c = 0; c < 4; ++c)
                wrong += found[4 * k + c] == std::bit_cast<std::uint32_t>(expected) ? 0 : 1;
            wrong += m.region.targets().color(codes, k) == Rgba{expected, expected, expected, expected} ? 0 : 1;
            unlike_quotient += product == quotient ? 0 : 1;
        }
        CHECK(wrong == 0);
        CHECK(unlike_quotient == 126);
    }
}

TEST_CASE("an observer gets each batch after shading then program then tests then writes") {
    std::vector<Stage> stages;
    const Observer observer{.stage = [&](const Region&, const StageEvent& event) { stages.push_back(event.stage); }};
    const TestFrame test{stacks({1, 2}), "geforce8", 8};
    RegionStatistics statistics;
    Region region{test.frame, {test.frame.rect()}, statistics, {.observer = &observer}};
    PassState state;
    state.color[0] = region.make_color();
    stages.clear();
    static_cast<void>(region.draw(state, pass_color));
    const std::size_t batches = static_cast<std::size_t>(std::ranges::count(stages, Stage::shaded));
    CHECK(batches > 0);
    for (const Stage each : {Stage::program, Stage::written})
        CHECK(static_cast<std::size_t>(std::ranges::count(stages, each)) == batches);
    CHECK(stages.front() == Stage::shaded);
    REQUIRE(stages.size() > 1);
    CHECK(stages[1] == Stage::program);
    stages.clear();
    static_cast<void>(region.full_screen(state, write_nothing));
    REQUIRE(!stages.empty());
    CHECK(stages.front() == Stage::program);
}

TEST_CASE("opaque geometry is drawn before the algorithm and not counted") {
    FragmentScene scene{2, 1};
    scene.pixels[1].opaque = GivenFragment{0.25f, {1, 0, 1, 0}};
    Machine m{scene, "geforce8"};
    CHECK(m.region.storage(m.region.opaque_depth()).depth(0)[0] == std::bit_cast<std::uint32_t>(1.0f));
    CHECK(m.region.storage(m.region.opaque_depth()).depth(0)[1] == std::bit_cast<std::uint32_t>(0.25f));
    CHECK(m.region.targets().color(m.region.opaque_color(), 1) == Rgba{1, 0, 1, 1});  // alphaMode OPAQUE ignores alpha
    CHECK(m.statistics.counters == Counters{});
}
