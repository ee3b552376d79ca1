// What passes leave out because it changes nothing: the program of a quad over a saved layer, targets for which a batch is neutral,
// the old contents of a buffer that is handed over. Model: literal execution, which leaves nothing out.
#include <catch2/catch.hpp>
#include <functional>
#include <limits>

#include "tests/pipeline/region/both_ways.h"
#include "tests/support/random_numbers.h"

namespace {

using namespace strata::testing;
using namespace strata::pipeline;

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN();

// One fragment or none at a pixel, some of them beyond an opaque surface, alpha 0 among them.
const FragmentScene& sparse_scene() {
    static const FragmentScene scene = [] {
        FragmentScene made{32, 24};
        Random random{2063};
        for (std::size_t p = 0; p < made.pixels.size(); ++p) {
            Rgba color = random_color(random);
            color[3] = static_cast<float>(random_int(random, 0, 4)) / 4.0f;
            if (random_int(random, 0, 3) == 0) made.pixels[p].fragments.push_back({0.5f, color});
            if (p % 5 == 0) made.pixels[p].opaque = GivenFragment{p % 2 == 0 ? 0.25f : 0.75f, {0, 1, 0, 1}};
        }
        return made;
    }();
    return scene;
}

// Values that a blend with zeros changes, and others: one of them a tile, in every second pixel's channel of this number.
void put_odd_values(Region& region, Target target, std::size_t channel) {
    PassState state;
    state.color[0] = target;
    static_cast<void>(region.full_screen(state, [=](const FragmentBatch& in, const Loads&, Outputs& out) {
        constexpr std::array values{0.5f,     -0.0f,    0.0f,      not_a_number, infinity, 0x1p-140f,
                                    0x1p-20f, 0x1p-16f, -0x1p-25f, 1.0f,         -3.0f,    -infinity};
        for (std::size_t i = 0; i < static_cast<std::size_t>(in.count); ++i)
            for (std::size_t c = 0; c < 4; ++c) {
                const std::size_t number = in.x[i] / 8 + std::size_t{4} * (in.y[i] / 8);
                out.color[0][c][i] = c == channel && (in.x[i] + in.y[i]) % 2 == 0 ? values[number] : 0.25f;
            }
    }));
}

struct Quad {
    const char* profile;
    Format format;
    Blend blend;
    void (*change)(PassState&, Region&) = [](PassState&, Region&) {};
    std::size_t odd_channel = 0;
};

// Draws the layer and blends it; `visited` += the pixels that the quad's program sees.
void draw_quad(Region& region, const Quad& quad, std::uint64_t& visited) {
    const Target color = region.make(quad.format), layer = region.make(quad.format), depth = region.make_depth();
    put_odd_values(region, color, quad.odd_channel);
    region.clear(layer, {.color = {0, 0, 0, 0}});
    region.copy(region.opaque_depth(), depth);
    PassState nearest;
    nearest.depth = {.enabled = true, .func = CompareFunc::less, .write = true};
    nearest.depth_target = depth;
    nearest.color[0] = layer;
    static_cast<void>(
        region.draw(nearest, [](const FragmentBatch& in, const Loads&, Outputs& out) { out.color[0] = in.color; }));
    PassState state;
    state.color[0] = color;
    state.blend[0] = quad.blend;
    state.reads = {layer, depth};
    state.textures[0] = region.opaque_depth();
    state.layer = {layer, depth, region.opaque_depth()};
    quad.change(state, region);
    static_cast<void>(region.full_screen(state, [&](const FragmentBatch& in, const Loads& own, Outputs& out) {
        visited += static_cast<std::uint64_t>(in.count);
        out.color[0] = own.color(0);
        out.color[1] = own.color(0);
    }));
    region.publish(region.opaque_color());
}

struct Outcome {
    std::string difference;
    std::uint64_t literal = 0, tiled = 0;  // pixels visited
};

Outcome outcome_of(const Quad& quad, Effects effects = Effects::needed, const Instruments& instruments = {}) {
    TestFrame test{sparse_scene(), quad.profile};
    test.frame.replay = {std::uint64_t{1} << 20, {}};
    test.frame.effects = effects;
    Outcome found;
    const auto body = [&](std::uint64_t& visited) { return [&](Region& region) { draw_quad(region, quad, visited); }; };
    const WhatIsLeft literal = run_one_way(test.frame, body(found.literal), Execution::literal, {});
    const WhatIsLeft tiled = run_one_way(test.frame, body(found.tiled), Execution::replay, instruments);
    found.difference = difference_of(literal, tiled);
    return found;
}

}  // namespace

TEST_CASE(
    "a quad over a layer leaves and counts what it does at every pixel, whatever the target holds, without its program",
    "[slow]") {
    for (const char* profile : {"ideal", "geforce8_dx101", "llvmpipe"})
        for (const Format format : {Format::rgba8, Format::rgba16f, Format::rgba32f})
            for (Blend blend : {blend_mode::under, blend_mode::over})
                for (const std::uint8_t mask : {0xf, 0x7}) {
                    blend.write_mask = mask;
                    for (std::size_t channel = 0; channel < 4; ++channel) {
                        Quad quad{profile, format, blend};
                        quad.odd_channel = channel;
                        const Outcome found = outcome_of(quad);
                        INFO(profile << ", format " << static_cast<int>(format) << ", mask " << int{mask}
                                     << ", channel " << channel);
                        CHECK(found.difference.empty());
                        CHECK(found.tiled == 0);
                    }
                }
}

TEST_CASE("a quad that does more than blend a layer, or is measured, visits every pixel") {
    using Change = void (*)(PassState&, Region&);
    const std::vector<Change> changes{
        [](PassState& s, Region&) { s.blend[0] = blend_mode::max; },
        [](PassState& s, Region&) { s.blend[0].enabled = false; },
        [](PassState& s, Region&) { s.layer = {}; },
        [](PassState& s, Region&) { s.alpha = {.enabled = true, .func = CompareFunc::lequal, .ref = 0.5f}; },
        [](PassState& s, Region& r) {
            s.color[1] = r.make(r.storage(s.color[0]).format());
            s.blend[1] = s.blend[0];
        },
        [](PassState& s, Region& r) {
            s.stencil = {.enabled = true, .front = {.func = CompareFunc::always, .pass = StencilOp::incr}, .back = {}};
            s.stencil_target = r.make(Format::s8);
        }};
    for (std::size_t number = 0; number < changes.size(); ++number) {
        const Outcome found = outcome_of({"ideal", Format::rgba32f, blend_mode::under, changes[number]});
        INFO("change " << number);
        CHECK(found.difference.empty());
        CHECK(found.tiled == found.literal);
    }
    const Quad quad{"ideal", Format::rgba32f, blend_mode::under};
    for (const Outcome& found : {outcome_of(quad, Effects::all), outcome_of(quad, {}, {.once_more = Effect::loads})}) {
        CHECK(found.difference.empty());
        CHECK(found.tiled == found.literal);
    }
}

namespace {

// The ends of every column into (-z, z), and a sum of colours; `neutral` is what the program says of every batch.
Body ends_with(unsigned neutral, bool has_selection) {
    return [=](Region& region) {
        PassState state;
        state.color = {region.make(Format::rg32f), region.make(Format::rgba8)};
        region.clear(state.color[0], {.color = {-1, -1, 0, 0}});
        state.blend = {blend_mode::max, blend_mode::max};
        state.reads[0] = region.opaque_depth();
        if (has_selection)
            state.selection = {.keeps = Keeps::ends, .outside = Outside::nothing_new, .before = region.opaque_depth()};
        static_cast<void>(region.draw(state, [=](const FragmentBatch& in, const Loads& own, Outputs& out) {
            for (std::size_t i = 0; i < static_cast<std::size_t>(in.count); ++i) {
                const bool is_visible = in.shader_z[i] < std::bit_cast<float>(own.depth(0)[i]);
                out.color[0][0][i] = is_visible ? -in.shader_z[i] : -1.0f;
                out.color[0][1][i] = is_visible ? in.shader_z[i] : -1.0f;
                for (std::size_t c = 0; c < 4; ++c) out.color[1][c][i] = 0.0f;
            }
            out.neutral = neutral;
        }));
        region.publish(region.opaque_color());
    };
}

std::string difference_with(const Body& body, const Instruments& instruments = {}) {
    TestFrame test{sparse_scene(), "ideal"};
    test.frame.key = DepthKey::shader_z;
    test.frame.replay = {std::uint64_t{1} << 20, {}};
    return difference_of(run_one_way(test.frame, body, Execution::literal, {}),
                         run_one_way(test.frame, body, Execution::replay, instruments));
}

}  // namespace

TEST_CASE(
    "a target for which a batch is neutral keeps its bits and counts its bytes, and a promise that does not hold is "
    "found") {
    CHECK(difference_with(ends_with(2, true)).empty());
    CHECK(difference_with(ends_with(2, true), {.check_selections = true}).empty());
    CHECK(difference_with(ends_with(1, true)) == "codes");
    CHECK(difference_with(ends_with(1, true), {.check_selections = true}).find("what it leaves in a target") !=
          std::string::npos);
    CHECK(difference_with(ends_with(3, false)).empty());  // without a selection nobody listens
}

namespace {

// Columns of up to eight fragments at few depths: ties, 0 and denormals among them.
const FragmentScene& deep_scene() {
    static const FragmentScene scene = [] {
        FragmentScene made{32, 24};
        Random random{2064};
        constexpr std::array depths{0.0f, 0x1p-140f, 0x1p-127f, 0x1p-126f, 0.25f, 0.5f, 0.625f, 0.75f, 0.875f, 1.0f};
        for (auto& pixel : made.pixels) {
            for (int n = random_int(random, 0, 8); n-- > 0;)
                pixel.fragments.push_back(
                    {depths[static_cast<std::size_t>(random_int(random, 0, 9))], random_color(random)});
            if (random_int(random, 0, 4) == 0) pixel.opaque = GivenFragment{0.75f, {0, 1, 0, 1}};
        }
        return made;
    }();
    return scene;
}

std::string difference_in_depth(DepthKey key, const Body& body, bool checks, const char* profile = "ideal") {
    TestFrame test{deep_scene(), profile};
    test.frame.key = key;
    test.frame.replay = {std::uint64_t{1} << 20, {}};
    return difference_of(run_one_way(test.frame, body, Execution::literal, {}),
                         run_one_way(test.frame, body, Execution::replay, {.check_selections = checks}));
}

// As ends_with, of a range that another target holds, so that all else is what lies between; `far` is what is written of a depth.
Body inner_ends(const std::function<float(float)>& far, float cleared, Format format = Format::rg32f) {
    return [=](Region& region) {
        const Target range = region.make(Format::rg32f), next = region.make(format);
        region.clear(range, {.color = {0, 1, 0, 0}});
        PassState state;
        state.color[0] = next;
        state.blend[0] = blend_mode::max;
        state.reads = {range, region.opaque_depth()};
        state.selection = {.keeps = Keeps::ends, .before = region.opaque_depth(), .range = range, .keys_suffice = true};
        for (int pass = 0; pass < 3; ++pass) {
            region.clear(state.color[0], {.color = {cleared, cleared, 0, 0}});
            static_cast<void>(region.draw(state, [&](const FragmentBatch& in, const Loads& own, Outputs& out) {
                for (std::size_t i = 0; i < static_cast<std::size_t>(in.count); ++i) {
                    const float z = in.shader_z[i], near = -own.color(0)[0][i], last = own.color(0)[1][i];
                    const bool is_inside = z < std::bit_cast<float>(own.depth(1)[i]) && z >= near && z <= last;
                    if (!is_inside) out.discard(static_cast<int>(i));
                    const bool is_inner = pass == 0 || (z != near && z != last);
                    out.color[0][0][i] = is_inner ? -z : -1.0f;
                    out.color[0][1][i] = is_inner ? far(z) : -1.0f;
                    out.color[0][2][i] = out.color[0][3][i] = 0.0f;
                }
            }));
            std::swap(state.reads[0], state.color[0]);
            state.selection.range = state.reads[0];
            if (format != Format::rg32f) break;
        }
        region.publish(region.opaque_color());
    };
}

// The nearest depth alone, behind what the pass before has found; `color`: the program has one, too.
Body nearest_depths(bool has_color) {
    return [=](Region& region) {
        const Target found = region.make_depth(), peeled = region.make_depth(), color = region.make_color();
        region.clear(peeled, {.depth = 0.0f});
        PassState state;
        state.depth = {.enabled = true, .func = CompareFunc::less, .write = true};
        state.depth_target = found;
        if (has_color) state.color[0] = color;
        state.reads[0] = peeled;
        state.selection = {.keeps = Keeps::nearest, .behind = peeled, .keys_suffice = true};
        for (int pass = 0; pass < 3; ++pass) {
            region.copy(region.opaque_depth(), found);
            static_cast<void>(region.draw(state, [](const FragmentBatch& in, const Loads& own, Outputs& out) {
                out.color[0] = in.color;
                for (std::size_t i = 0; i < static_cast<std::size_t>(in.count); ++i)
                    if (in.code[i] <= own.depth(0)[i]) out.discard(static_cast<int>(i));
            }));
            region.copy(found, peeled);
        }
        region.publish(has_color ? color : region.opaque_color());
    };
}

}  // namespace

TEST_CASE(
    "what follows from keys is what the program would have left, and where it does not follow, the program is run") {
    const auto depth = [](float z) { return z; };
    for (const float cleared : {-1.0f, 0.5f, 2.0f, -0.0f, not_a_number}) {
        for (const char* profile : {"ideal", "geforce8_dx101"})
            for (const bool checks : {false, true}) {
                INFO("cleared to " << cleared << ", " << profile << ", checked: " << checks);
                CHECK(difference_in_depth(DepthKey::shader_z, inner_ends(depth, cleared), checks, profile).empty());
            }
    }
    CHECK(difference_in_depth(DepthKey::shader_z, inner_ends(depth, -1.0f, Format::rgba32f), true).empty());
    const auto negated = [](float z) { return -z; };
    CHECK(
        difference_in_depth(DepthKey::shader_z, inner_ends(negated, -1.0f), true).find("what it leaves in a target") !=
        std::string::npos);
    for (const bool has_color : {false, true})
        for (const bool checks : {false, true}) {
            INFO("colour: " << has_color << ", checked: " << checks);
            CHECK(difference_in_depth(DepthKey::stored_code, nearest_depths(has_color), checks).empty());
        }
}

TEST_CASE("a buffer that is handed over is a copy, counted as one, and what it held is not looked at") {
    CHECK(difference_with([](Region& region) {
              const Target from = region.make(Format::rgba32f), to = region.make(Format::rgba32f);
              put_odd_values(region, from, 1);
              region.copy_and_leave(from, to);
              region.clear(from, {.color = {0.5f, 0.25f, 0, 1}});
              region.publish(region.opaque_color());
          }).empty());
    // Literal execution copies, so that whoever looks at its steps sees the buffer as the machine has it.
    TestFrame test{sparse_scene(), "ideal"};
    static_cast<void>(run_one_way(test.frame,
                                  [](Region& region) {
                                      const Target from = region.make(Format::rgba32f),
                                                   to = region.make(Format::rgba32f);
                                      put_odd_values(region, from, 1);
                                      region.copy_and_leave(from, to);
                                      CHECK(region.image(from) == region.image(to));
                                      region.publish(region.opaque_color());
                                  },
                                  Execution::literal, {}));
}
