// Tests passes that rows can draw, which are depth-only passes and sums of halves, and the same passes with one setting
// changed. The reference is literal execution, which never walks a row.
#include <catch2/catch.hpp>

#include "tests/pipeline/region/both_ways.h"
#include "tests/pipeline/region/changed_states.h"
#include "tests/support/random_numbers.h"

namespace {

using namespace strata::testing;
using namespace strata::pipeline;

enum class RowPass : std::uint8_t { depth, sums, sums_and_counts, wide_sums };

// Large triangles, each over a good part of the frame, some behind the opaque surfaces.
const FragmentScene& row_scene() {
    static const FragmentScene scene = [] {
        FragmentScene made{32, 16};
        Random random{77};
        for (auto& pixel : made.pixels) {
            for (int i = random_int(random, 0, 4); i-- > 0;) {
                const auto depth = static_cast<float>(random_int(random, 0, 31)) / 32.0f;
                const auto shade = static_cast<float>(random_int(random, 0, 16)) / 16.0f;
                pixel.fragments.push_back({depth, {shade, 0.25f, 1.0f, 0.5f}});
            }
            if (random_int(random, 0, 3) == 0) pixel.opaque = GivenFragment{0.5f, {0, 0, 1, 1}};
        }
        return made;
    }();
    return scene;
}

void draw_rows(Region& region, RowPass kind, const Changed& change) {
    PassState state;
    state.needs = {.shader_z = false, .code = false, .color = kind != RowPass::depth};
    if (kind == RowPass::depth) {
        state.depth = nearest_stays;
        state.depth_target = region.make_depth();
        region.copy(region.opaque_depth(), state.depth_target);
        change(state, region);
        state.color = {};  // no colour, as the function requires
        static_cast<void>(region.draw_depth(state));
    } else {
        state.depth = {.enabled = true, .func = CompareFunc::less, .write = false};
        state.depth_target = region.opaque_depth();
        state.color[0] = region.make(kind == RowPass::wide_sums ? Format::rgba32f : Format::rgba16f);
        state.blend[0] = blend_mode::sum;
        if (kind != RowPass::sums) {
            state.color[1] = region.make(kind == RowPass::wide_sums ? Format::r32f : Format::r16f);
            state.blend[1] = blend_mode::sum;
        }
        change(state, region);
        static_cast<void>(region.draw_sums(state));
    }
    region.publish(region.opaque_color());
}

std::string row_difference(const char* profile, RowPass kind, const Changed& change,
                           const std::function<void(Frame&)>& reframe = {}, const Instruments& instruments = {}) {
    TestFrame test{row_scene(), profile};
    if (reframe) reframe(test.frame);
    const Body body = [&](Region& region) { draw_rows(region, kind, change); };
    return difference_of(run_one_way(test.frame, body, Execution::literal, instruments),
                         run_one_way(test.frame, body, Execution::replay, instruments));
}

constexpr std::array row_passes{RowPass::depth, RowPass::sums, RowPass::sums_and_counts, RowPass::wide_sums};
constexpr std::array row_profiles{"geforce3", "geforce8", "geforce8_dx101", "ideal"};

}  // namespace

TEST_CASE("rows give the results and counts of batches for any changed state of their pass", "[slow]") {
    for (const char* profile : row_profiles)
        for (const RowPass kind : row_passes)
            for (const Change& change : changes()) {
                INFO(profile << ", pass " << static_cast<int>(kind) << ", changed: " << change.name);
                CHECK(row_difference(profile, kind, change.make) == "");
            }
}

TEST_CASE("rows give the results and counts of batches under every memory limit and instrument", "[slow]") {
    const std::vector<std::function<void(Frame&)>> frames{
        [](Frame& f) { f.replay.bytes = 1 << 20; }, [](Frame& f) { f.effects = Effects::all; },
        [](Frame& f) { f.key = DepthKey::shader_z; },
        [](Frame& f) { f.depth.reference = strata::rasterizer::DepthPath::exact; }};
    for (const char* profile : {"geforce8", "ideal"})
        for (const RowPass kind : row_passes) {
            const Changed nothing = changes().front().make;
            for (std::size_t frame = 0; frame < frames.size(); ++frame) {
                INFO(profile << ", pass " << static_cast<int>(kind) << ", frame " << frame);
                CHECK(row_difference(profile, kind, nothing, frames[frame]) == "");
            }
            CHECK(row_difference(profile, kind, nothing, {}, {.once_more = Effect::blending}) == "");
            CHECK(row_difference(profile, kind, nothing, {}, {.once_more = Effect::loads}) == "");
            CHECK(row_difference(profile, kind, nothing, {}, {.log_passes = true}) == "");
        }
}
