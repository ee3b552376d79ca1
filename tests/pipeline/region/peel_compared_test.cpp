// Tests peels by a compared depth that is rounded differently from the stored one, so that fragments may be behind
// themselves: passes that continue from the previous one, and passes with another bound, surface, target or program.
// The reference is literal execution, which visits every fragment.
#include <catch2/catch.hpp>

#include "tests/pipeline/region/both_ways.h"
#include "tests/pipeline/region/put_pixel.h"
#include "tests/pipeline/region/random_walk.h"

// A separate namespace: bodies of several tests have the same short names, and a unity build joins their files.
namespace strata::testing::peel_compared {
namespace {

using namespace pipeline;

// Up to six layers per pixel in random order, one code apart or equal, half of them behind their own code; some opaque
// surfaces at a layer's depth; some empty pixels.
FragmentScene any_layers(Random& random) {
    FragmentScene made{16, 16};
    for (auto& pixel : made.pixels) {
        for (int n = random_int(random, 0, 6); n-- > 0;) {
            const float depth = static_cast<float>(random_int(random, 0, 15)) / 16.0f;
            // In steps of half a code of D24: a code is 2^-24.
            const float part = static_cast<float>(random_int(random, -3, 3)) * 0x1p-25f;
            pixel.fragments.push_back({std::max(depth + part, 0.0f), random_color(random)});
        }
        if (random_int(random, 0, 3) == 0)
            pixel.opaque =
                GivenFragment{static_cast<float>(std::max(random_int(random, -4, 32), 0)) / 32.0f, {0, 1, 0, 1}};
    }
    return made;
}

// How one pass of a peel differs from the regular one.
enum class Step {
    next,           // regular
    again,          // the bound of the previous pass
    first,          // no bound
    other_bound,    // another bound at one pixel
    other_surface,  // another surface at one pixel
    other_clear,    // another clear colour
    other_format,   // another colour format
    by_alpha,       // fragments outside end by the alpha test, or not
    other_compare,  // another epsilon
    two_targets,    // a second target like the first
    masked,         // without alpha
    between,        // after a pass that keeps something else
    part,           // only part of the list
    other_colors
};

class Peel {
  public:
    Peel(Region& region, const Walk<Step>& walk) : region_{region}, walk_{walk}, random_{walk.seed} {}

    void run() {
        for (const Step step : walk_.steps) take(step);
        region_.publish(sum_);
    }

  private:
    void take(Step step) {
        const int x = random_int(random_, 0, 15), y = random_int(random_, 0, 15);
        const float depth = static_cast<float>(random_int(random_, 0, 17)) / 16.0f;
        if (step == Step::other_bound) put_depth(region_, peeled_, x, y, std::min(depth, 1.0f));
        region_.copy(region_.opaque_depth(), nearest_);
        if (step == Step::other_surface) put_depth(region_, nearest_, x, y, std::min(depth, 1.0f));
        if (step == Step::other_format) std::swap(color_, other_color_);
        if (step == Step::by_alpha) by_alpha_ = !by_alpha_;
        if (step == Step::other_compare) compare_.epsilon.absolute = compare_.epsilon.absolute == 0 ? 0x1p-24 : 0;
        if (step == Step::between) keep_others();
        region_.clear(color_, {.color = {step == Step::other_clear ? 0.5f : 0.0f, 0, 0, 0}});
        draw(step);
        add();
        if (step != Step::again) std::swap(peeled_, nearest_);
    }

    void draw(Step step) {
        const bool is_first = step == Step::first;
        PassState state;
        state.alpha = {.enabled = by_alpha_, .func = CompareFunc::greater, .ref = 0.0f};
        state.depth = {.enabled = true, .func = CompareFunc::less, .write = true};
        state.depth_target = nearest_;
        state.color[0] = color_;
        if (step == Step::two_targets) state.color[1] = second_;
        if (step == Step::masked) state.blend[0].write_mask = state.blend[1].write_mask = 0x7;
        state.reads[0] = peeled_;
        state.needs.reference = true;
        const PrimitiveRange part{100, 700};
        if (step == Step::part) state.primitives = {&part, 1};
        state.selection = {.keeps = KeptFragments::nearest,
                           .near = KeyBound::beyond(is_first ? Target{} : peeled_),
                           .compared = compare_};
        const float scale = step == Step::other_colors ? 0.5f : 1.0f;
        static_cast<void>(region_.draw(state, [=, this](const FragmentBatch& in, const Loads& loads, Outputs& out) {
            for (std::size_t c = 0; c < 4; ++c)
                for (std::size_t i = 0; i < static_cast<std::size_t>(in.count); ++i)
                    out.color[0][c][i] = out.color[1][c][i] = (c < 3 ? scale : 1.0f) * in.color[c][i];
            for (std::size_t i = 0; i < static_cast<std::size_t>(in.count) && !is_first; ++i) {
                if (compare_.is_behind(in.reference_code[i], in.reference_z[i], loads.depth(0)[i])) continue;
                if (!by_alpha_)
                    out.discard(static_cast<int>(i));
                else
                    out.color[0][3][i] = 0.0f;
            }
        }));
    }

    // A pass by the frame's own codes at one depth.
    void keep_others() {
        PassState state;
        state.color[0] = sum_;
        state.blend[0] = blend_mode::over;
        state.reads[0] = peeled_;
        state.selection = {
            .keeps = KeptFragments::interval, .near = KeyBound::at(peeled_), .far = {KeyBound::at(peeled_)}};
        static_cast<void>(region_.draw(state, [](const FragmentBatch& in, const Loads& loads, Outputs& out) {
            out.color[0] = in.color;
            for (std::size_t i = 0; i < static_cast<std::size_t>(in.count); ++i)
                if (in.code[i] != loads.depth(0)[i]) out.discard(static_cast<int>(i));
        }));
    }

    // Adds the pass's colours to the sum, so that none is lost.
    void add() {
        PassState state;
        state.color[0] = sum_;
        state.blend[0] = blend_mode::over;
        state.reads[0] = color_;
        static_cast<void>(region_.full_screen(
            state, [](const FragmentBatch&, const Loads& loads, Outputs& out) { out.color[0] = loads.color(0); }));
    }

    Region& region_;
    const Walk<Step>& walk_;
    Random random_;
    Target color_ = region_.make(walk_.seed % 2 == 0 ? Format::rgba8 : Format::rgba16f);
    Target other_color_ = region_.make(Format::rgba32f), second_ = region_.make(Format::rgba8);
    Target sum_ = region_.make(Format::rgba32f);
    Target peeled_ = region_.make_depth(), nearest_ = region_.make_depth();
    DepthCompare compare_ = region_.frame().depth_compare();
    bool by_alpha_ = walk_.seed % 3 != 0;
};

// Runs `walk` by tiles.
struct Compared {
    explicit Compared(const FragmentScene& scene, const char* profile = "ideal", bool quantizes = false)
        : test{scene, profile} {
        test.frame.depth.format = DepthFormat::d24;
        test.frame.quantize_reference = quantizes;
        if (quantizes) test.frame.epsilon.ulps = 1;
        test.frame.replay = {std::uint64_t{1} << 20, {.reference = true}};
    }
    [[nodiscard]] RunResult run(const Walk<Step>& walk, Execution execution,
                                const Instruments& instruments = {}) const {
        const Body body = [&](Region& region) { Peel{region, walk}.run(); };
        return run_one_way(test.frame, body, execution, instruments);
    }
    TestFrame test;
};

}  // namespace

TEST_CASE("a peel whose fragments are behind themselves gives the same result as visiting every fragment") {
    Random random{2211};
    for (int round = 0; round < 300; ++round) {
        const Compared peel{any_layers(random), round % 4 == 0 ? "softpipe" : "ideal", round % 5 == 0};
        const Walk<Step> walk = random_walk(random, 16, Step::other_colors);
        INFO("round " << round);
        const RunResult literal = peel.run(walk, Execution::literal);
        REQUIRE(literal.refusal.empty());
        REQUIRE(difference_of(literal, peel.run(walk, Execution::replay, {.check_selections = true})) == "");
        REQUIRE(difference_of(literal, peel.run(walk, Execution::replay)) == "");
    }
}

TEST_CASE("the result of a region's only pass is not reused for another region with the same bounds") {
    Random random{2213};
    FragmentScene scene = any_layers(random);
    for (auto& pixel : scene.pixels) pixel.opaque.reset();
    const Compared peel{scene};
    const Walk<Step> walk{{Step::next}, 2};
    CHECK(difference_of(peel.run(walk, Execution::literal), peel.run(walk, Execution::replay)) == "");
}

}  // namespace strata::testing::peel_compared
