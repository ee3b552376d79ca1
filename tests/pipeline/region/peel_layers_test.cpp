// Tests peels whose passes continue from layer to layer, and peels that do not: another bound, another surface, another
// range, a repeated pass. The reference is literal execution, which visits every fragment.
#include <bit>
#include <catch2/catch.hpp>

#include "tests/pipeline/region/both_ways.h"
#include "tests/pipeline/region/put_pixel.h"
#include "tests/support/random_numbers.h"

// A separate namespace: bodies of several tests have the same short names, and a unity build joins their files.
namespace strata::testing::peel_layers {
namespace {

using namespace pipeline;

// Up to nine layers per pixel in random order, with ties and some opaque surfaces at a layer's depth; some empty
// pixels.
FragmentScene any_layers(Random& random) {
    FragmentScene made{16, 16};
    for (auto& pixel : made.pixels) {
        for (int n = random_int(random, 0, 9); n-- > 0;)
            pixel.fragments.push_back({static_cast<float>(random_int(random, 0, 11)) / 16.0f, random_color(random)});
        if (random_int(random, 0, 3) == 0)
            pixel.opaque = GivenFragment{static_cast<float>(random_int(random, 4, 20)) / 32.0f, {0, 1, 0, 1}};
    }
    return made;
}

// How one pass of a peel, or the quad before it, differs from the regular one.
enum class Step {
    next,           // regular
    again,          // the bound of the previous pass
    first,          // no bound
    other_bound,    // another bound at one pixel
    other_surface,  // another surface at one pixel
    cleared,        // a surface of one depth everywhere
    counted,        // with a stencil as well
    range,          // another range of keys
    part,           // only part of the list
    at,             // composites the layer that was found last
    at_other        // the same at a depth that differs at one pixel
};

struct Walk {
    std::vector<Step> steps;
    std::uint64_t seed;
};

Walk random_walk(Random& random) {
    Walk walk{{Step::first}, random()};
    const int disturbed = random_int(random, 0, 3);  // frequency of irregular passes
    for (int n = random_int(random, 2, 14); n-- > 0;) {
        const bool is_plain = random_int(random, 0, 3) >= disturbed;
        const int any = random_int(random, 0, static_cast<int>(Step::at_other));
        walk.steps.push_back(is_plain ? (random_int(random, 0, 2) == 0 ? Step::at : Step::next)
                                      : static_cast<Step>(any));
    }
    return walk;
}

class Peel {
  public:
    Peel(Region& region, const Walk& walk) : region_{region}, walk_{walk}, random_{walk.seed} {
        region_.clear(peeled_, {.depth = 0.25f});
    }

    void run() {
        for (const Step step : walk_.steps) take(step);
        region_.publish(color_);
    }

  private:
    void take(Step step) {
        const int x = random_int(random_, 0, 15), y = random_int(random_, 0, 15);
        const float depth = static_cast<float>(random_int(random_, -2, 17)) / 16.0f;
        if (step == Step::at || step == Step::at_other) {
            if (step == Step::at_other) put_depth(region_, peeled_, x, y, depth);
            return composite();
        }
        if (step == Step::other_bound) put_depth(region_, peeled_, x, y, depth);
        if (step == Step::cleared)
            region_.clear(nearest_, {.depth = depth});
        else
            region_.copy(region_.opaque_depth(), nearest_);
        if (step == Step::other_surface) put_depth(region_, nearest_, x, y, depth);
        if (step == Step::range) {
            least_ = code_of(region_, static_cast<float>(random_int(random_, 0, 6)) / 16.0f);
            most_ = random_int(random_, 0, 1) == 0
                        ? ~0u
                        : code_of(region_, static_cast<float>(random_int(random_, 5, 12)) / 16.0f);
        }
        if (step == Step::part) {
            const auto first = static_cast<std::uint32_t>(random_int(random_, 0, 300));
            part_ = {first, first + static_cast<std::uint32_t>(random_int(random_, 100, 900))};
        }
        const bool begins = step == Step::first || (step == Step::part && random_int(random_, 0, 1) == 0);
        draw(begins, step == Step::counted);
        if (step != Step::again) std::swap(peeled_, nearest_);
    }

    [[nodiscard]] std::span<const PrimitiveRange> part() const {
        return part_.first < part_.last ? std::span{&part_, 1} : std::span<const PrimitiveRange>{};
    }

    void draw(bool is_first, bool is_counted) {
        PassState state;
        state.stencil = {.enabled = is_counted,
                         .front = {.func = CompareFunc::always, .ref = 0, .pass = StencilOp::incr},
                         .back = {}};
        if (is_counted) state.stencil_target = updates_;
        state.depth = {.enabled = true, .func = CompareFunc::less, .write = true};
        state.depth_target = nearest_;
        state.color[0] = color_;
        state.reads[0] = peeled_;
        state.primitives = part();
        state.selection = {.keeps = KeptFragments::nearest, .least = least_, .most = most_};
        if (!is_first) state.selection.near = KeyBound::beyond(peeled_);
        static_cast<void>(region_.draw(state, [=, this](const FragmentBatch& in, const Loads& loads, Outputs& out) {
            out.color[0] = in.color;
            for (std::size_t i = 0; i < static_cast<std::size_t>(in.count); ++i) {
                const bool is_inside = in.code[i] >= least_ && in.code[i] <= most_;
                if (!is_inside || (!is_first && in.code[i] <= loads.depth(0)[i])) out.discard(static_cast<int>(i));
            }
        }));
    }

    void composite() {
        PassState state;
        state.color[0] = color_;
        state.blend[0] = blend_mode::over;
        state.reads[0] = peeled_;
        state.primitives = part();
        state.selection = {
            .keeps = KeptFragments::interval, .near = KeyBound::at(peeled_), .far = {KeyBound::at(peeled_)}};
        static_cast<void>(region_.draw(state, [](const FragmentBatch& in, const Loads& loads, Outputs& out) {
            out.color[0] = in.color;
            for (std::size_t i = 0; i < static_cast<std::size_t>(in.count); ++i)
                if (in.code[i] != loads.depth(0)[i]) out.discard(static_cast<int>(i));
        }));
    }

    Region& region_;
    const Walk& walk_;
    Random random_;
    Target color_ = region_.make(Format::rgba32f), peeled_ = region_.make_depth(), nearest_ = region_.make_depth();
    Target updates_ = region_.make(Format::s8);
    std::uint32_t least_ = 0, most_ = ~0u;
    PrimitiveRange part_{};
};

std::string difference_of_walk(const Walk& walk, const FragmentScene& scene, DepthFormat format, std::uint64_t bytes) {
    TestFrame test{scene, walk.seed % 4 == 0 ? "softpipe" : "ideal"};
    test.frame.depth.format = format;
    test.frame.replay = {bytes, {}};
    const Body body = [&](Region& region) { Peel{region, walk}.run(); };
    const RunResult literal = run_one_way(test.frame, body, Execution::literal, {});
    const std::string checked =
        difference_of(literal, run_one_way(test.frame, body, Execution::replay, {.check_selections = true}));
    return checked + difference_of(literal, run_one_way(test.frame, body, Execution::replay, {}));
}

}  // namespace

TEST_CASE("passes of a peel give the same result as visiting every fragment for any bounds") {
    Random random{2081};
    for (int round = 0; round < 250; ++round) {
        const FragmentScene scene = any_layers(random);
        const Walk walk = random_walk(random);
        const auto format = std::array{DepthFormat::d32f, DepthFormat::d24, DepthFormat::d16}[round % 3];
        // Tiles of 8 x 8 pixels with about three hundred fragments: the smallest of these memories has room for the
        // fragments, but not for the sorted lists.
        const std::uint64_t bytes = std::array{1u << 20, 1u << 20, 12'000u}[static_cast<std::size_t>(round / 3 % 3)];
        INFO("round " << round << ", format " << static_cast<int>(format) << ", bytes " << bytes);
        REQUIRE(difference_of_walk(walk, scene, format, bytes) == "");
    }
}

TEST_CASE("a peel without irregular passes visits a fragment once") {
    Random random{2082};
    const FragmentScene scene = any_layers(random);
    std::uint64_t fragments = 0;
    for (const auto& pixel : scene.pixels) fragments += pixel.fragments.size();
    const Walk plain{{Step::first, Step::next, Step::next, Step::next, Step::next, Step::next}, 1};
    TestFrame test{scene, "ideal"};
    test.frame.replay = {std::uint64_t{1} << 20, {}};
    const RunResult tiled = run_one_way(test.frame,
                                        [&](Region& region) {
                                            Peel{region, plain}.run();
                                        },
                                        Execution::replay, {});
    CHECK(tiled.visited > 0);
    CHECK(tiled.visited <= fragments);
}

}  // namespace strata::testing::peel_layers
