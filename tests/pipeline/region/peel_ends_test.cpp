// Tests peels from both ends whose passes continue from range to range, and peels that do not: another range, another
// surface, another clear, a repeated pass. The reference is literal execution, which visits every fragment.
#include <bit>
#include <catch2/catch.hpp>

#include "tests/pipeline/region/both_ways.h"
#include "tests/pipeline/region/put_pixel.h"
#include "tests/pipeline/region/random_walk.h"

// A separate namespace: bodies of several tests have the same short names, and a unity build joins their files.
namespace strata::testing::peel_ends {
namespace {

using namespace pipeline;

// Up to eleven depths per pixel in random order, with ties and some opaque surfaces at a layer's depth; some empty
// pixels. `rare` depths are 0 or denormal.
FragmentScene any_depths(Random& random, bool has_rare) {
    FragmentScene made{16, 16};
    for (auto& pixel : made.pixels) {
        for (int n = random_int(random, 0, 11); n-- > 0;) {
            const bool is_rare = has_rare && random_int(random, 0, 9) == 0;
            const float depth = static_cast<float>(random_int(random, 1, 15)) / 16.0f;
            pixel.fragments.push_back({is_rare ? (depth < 0.5f ? 0.0f : 1e-40f) : depth, random_color(random)});
        }
        if (random_int(random, 0, 3) == 0)
            pixel.opaque = GivenFragment{static_cast<float>(random_int(random, 4, 32)) / 32.0f, {0, 1, 0, 1}};
    }
    return made;
}

// How one pass of a peel differs from the regular one.
enum class Step {
    next,           // regular
    again,          // the range of the previous pass
    first,          // the complete range
    other_range,    // another range at one pixel
    other_surface,  // another surface at one pixel
    other_clear,    // another clear value of the target
    other_outside,  // another behaviour of fragments outside
    other_depths    // another value of the fragments in between
};

class Peel {
  public:
    Peel(Region& region, const Walk<Step>& walk) : region_{region}, walk_{walk}, random_{walk.seed} {
        region_.clear(ends_, {.color = {0, 0, 0, 0}});
        region_.copy(region_.opaque_depth(), surface_);
    }

    void run() {
        for (const Step step : walk_.steps) take(step);
        region_.publish(ends_);
    }

  private:
    void take(Step step) {
        const int x = random_int(random_, 0, 15), y = random_int(random_, 0, 15);
        const float near = static_cast<float>(random_int(random_, -1, 12)) / 16.0f;
        const float far = static_cast<float>(random_int(random_, 2, 17)) / 16.0f;
        if (step == Step::first) region_.clear(range_, {.color = {1, 1, 0, 0}});  // range from -1 to 1
        if (step == Step::other_range) {
            PassState state;
            state.color[0] = range_;
            // near end, far end or both
            state.blend[0].write_mask = static_cast<std::uint8_t>(random_int(random_, 1, 3));
            put_pixel(region_, state, x, y, [=](Outputs& out, std::size_t i) {
                out.color[0][0][i] = -near;
                out.color[0][1][i] = far;
            });
        }
        if (step == Step::other_surface) put_depth(region_, surface_, x, y, std::max(far, 0.0f));
        const bool is_other = step == Step::other_clear;
        region_.clear(next_, {.color = {is_other ? -0.5f : -1.0f, is_other ? 0.25f : -1.0f, 0, 0}});
        if (step == Step::other_outside) outside_ = outside_ == Outside::dies ? Outside::writes_alike : Outside::dies;
        draw(step == Step::other_depths ? 0.5f : 1.0f);
        if (step != Step::again) std::swap(range_, next_);
    }

    // The near end writes its colour; every other fragment that is not discarded writes a value that increases from
    // pass to pass.
    void draw(float scale) {
        PassState state;
        state.color = {next_, ends_};
        state.blend = {blend_mode::max, blend_mode::max};
        state.reads = {range_, surface_};
        state.needs.code = false;
        state.selection = {
            .keeps = KeptFragments::ends, .outside = outside_, .far = {KeyBound::beyond(surface_)}, .range = range_};
        const bool discards = outside_ == Outside::dies;
        const float others = static_cast<float>(++passes_) / 32.0f;
        static_cast<void>(region_.draw(state, [=](const FragmentBatch& in, const Loads& loads, Outputs& out) {
            for (std::size_t i = 0; i < static_cast<std::size_t>(in.count); ++i) {
                const float z = in.shader_z[i], near = -loads.color(0)[0][i], far = loads.color(0)[1][i];
                const bool is_inside = z < std::bit_cast<float>(loads.depth(1)[i]) && z >= near && z <= far;
                const bool is_near = is_inside && z == near, is_between = is_inside && z != near && z != far;
                const float left = scale * z;
                out.color[0][0][i] = is_between ? -left : -1.0f;
                out.color[0][1][i] = is_between ? left : -1.0f;
                for (std::size_t c = 0; c < 4; ++c) out.color[1][c][i] = is_near ? in.color[c][i] : others;
                if (!is_inside && discards) out.discard(static_cast<int>(i));
            }
        }));
    }

    Region& region_;
    const Walk<Step>& walk_;
    Random random_;
    Target range_ = region_.make(Format::rg32f), next_ = region_.make(Format::rg32f);
    Target ends_ = region_.make(Format::rgba32f), surface_ = region_.make_depth();
    int passes_ = 0;
    Outside outside_ = walk_.seed % 2 == 0 ? Outside::dies : Outside::writes_alike;
};

std::string difference_of_walk(const Walk<Step>& walk, const FragmentScene& scene) {
    TestFrame test{scene, walk.seed % 4 == 0 ? "softpipe" : "ideal"};
    test.frame.depth.format = DepthFormat::d32f;
    test.frame.key = DepthKey::shader_z;
    test.frame.replay = {std::uint64_t{1} << 20, {}};
    const Body body = [&](Region& region) { Peel{region, walk}.run(); };
    const RunResult literal = run_one_way(test.frame, body, Execution::literal, {});
    REQUIRE(literal.refusal.empty());
    const std::string checked =
        difference_of(literal, run_one_way(test.frame, body, Execution::replay, {.check_selections = true}));
    return checked + difference_of(literal, run_one_way(test.frame, body, Execution::replay, {}));
}

}  // namespace

TEST_CASE("a peel from both ends gives the same result as visiting every fragment for any ranges") {
    Random random{2091};
    for (int round = 0; round < 250; ++round) {
        const FragmentScene scene = any_depths(random, round % 4 == 0);
        const Walk<Step> walk = random_walk(random, 12, Step::other_depths);
        INFO("round " << round);
        REQUIRE(difference_of_walk(walk, scene) == "");
    }
}

}  // namespace strata::testing::peel_ends
