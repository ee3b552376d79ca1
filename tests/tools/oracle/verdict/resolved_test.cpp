// Tests verdicts on pictures with several samples per pixel against the resolved pictures of Renderer, whose
// samples are rendered and rounded step by step.
#include "tools/oracle/verdict/resolved.h"

#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "peeling/render.h"
#include "pipeline/device/sample_points.h"
#include "tests/tools/oracle/verdict/opened_scene.h"

using namespace strata;
using namespace strata::oracle::verdict;
using strata::test::OpenedScene;

namespace {

constexpr int samples = 4;

oracle::TargetImage resolved(const OpenedScene& opened, const std::string& algorithm, pipeline::Format format,
                             int max_passes = 0) {
    peeling::RenderOptions options = opened.options;
    options.color_format = format;
    options.audit = false;
    if (max_passes > 0) options.max_passes = max_passes;
    options.sampling.samples = samples;
    peeling::Renderer renderer{opened.scene.list, opened.view, opened.profile, options};
    return oracle::as_target(renderer.render(*peeling::find_algorithm(algorithm)).frame.color, "color");
}

Samples samples_of(const OpenedScene& opened) {
    Samples all;
    for (std::size_t number = 0; number < samples; ++number) {
        peeling::RenderOptions options = opened.options;
        pipeline::set_sample(options.raster, opened.profile.sample_positions, samples, number);
        all.push_back(std::make_unique<SceneFragments>(
            peeling::FrameRequest{opened.scene.list, opened.view, opened.profile, options},
            std::numeric_limits<std::uint64_t>::max()));
    }
    return all;
}
ResolvedVerdict judged_samples(const OpenedScene& opened, const oracle::TargetImage& picture) {
    return judge_resolved(samples_of(opened), Colors{picture});
}

// The picture of a port that composites every sample in binary64 and rounds only the mean.
oracle::TargetImage rounded_once(const OpenedScene& opened, const Samples& lists) {
    oracle::TargetImage picture = resolved(opened, "a_buffer", pipeline::Format::rgba8);
    const auto width = static_cast<std::size_t>(picture.width);
    for (int y = 0; y < opened.options.height; ++y)
        for (int x = 0; x < opened.options.width; ++x) {
            std::array<double, 3> sum{};
            const PixelList place = lists[0]->list_at(x, y);
            for (const auto& sample : lists) {
                const PixelList list = sample->list_at(x, y);
                std::array<double, 3> color{list.behind[0], list.behind[1], list.behind[2]};
                for (auto f = list.visible.rbegin(); f != list.visible.rend(); ++f)
                    for (std::size_t c = 0; c < 3; ++c)
                        color[c] = double{f->color[3]} * f->color[c] + (1 - double{f->color[3]}) * color[c];
                for (std::size_t c = 0; c < 3; ++c) sum[c] += color[c] / samples;
            }
            const std::size_t first =
                (static_cast<std::size_t>(place.y) * width + static_cast<std::size_t>(place.x)) * 4;
            for (std::size_t c = 0; c < 3; ++c)
                picture.codes[first + c] = static_cast<std::uint32_t>(std::floor(sum[c] * 255 + 0.5));
        }
    return picture;
}

}  // namespace

TEST_CASE("the mean of right samples is right in each format and by each end of a peel") {
    const OpenedScene opened{"showroom", 48, 36};
    for (const std::string algorithm : {"front_to_back", "dual"})
        for (const pipeline::Format format :
             {pipeline::Format::rgba8, pipeline::Format::rgba16f, pipeline::Format::rgba32f}) {
            const ResolvedVerdict verdict = judged_samples(opened, resolved(opened, algorithm, format));
            INFO(algorithm << ' ' << pipeline::info(format).name << ": " << to_text(verdict));
            CHECK(verdict.is_right());
            CHECK(verdict.pixels == 48 * 36);
            CHECK(verdict.at_edges > 50);
            CHECK(verdict.possible <= (has_codes(verdict.hypothesis.result.storage) ? 3 : 4096));
        }
}

// llvmpipe evaluates 1/w at the pixel's centre, so that colours at a sample may exceed 1: a program multiplies them by
// alpha before they are clamped. It also rounds each product of a blend.
TEST_CASE("the mean of right samples is right where a profile interpolates beyond 1") {
    for (const std::string scene : {"showroom", "random:seed=3,triangles=60"}) {
        OpenedScene opened{scene, 48, 36};
        opened.profile = *pipeline::find_profile("llvmpipe");
        for (const std::string algorithm : {"front_to_back", "dual"}) {
            for (const pipeline::Format format : {pipeline::Format::rgba8, pipeline::Format::rgba32f}) {
                const ResolvedVerdict verdict = judged_samples(opened, resolved(opened, algorithm, format));
                INFO(scene << ' ' << algorithm << ": " << to_text(verdict));
                CHECK(verdict.is_right());
            }
        }
    }
}

TEST_CASE("a port with one sample per pixel is wrong at edges only and one that loses layers elsewhere too") {
    const OpenedScene opened{"planes:count=3", 48, 36};  // of one colour each
    const ResolvedVerdict single = judged_samples(opened, *opened.picture("front_to_back", pipeline::Format::rgba8));
    CHECK_FALSE(single.is_right());
    CHECK(to_text(single).find(", edges only: ") != std::string::npos);
    const OpenedScene deep{"showroom", 48, 36};
    const ResolvedVerdict early = judged_samples(deep, resolved(deep, "front_to_back", pipeline::Format::rgba8, 1));
    CHECK_FALSE(early.is_right());
    CHECK(early.wrong_at_edges < early.wrong_pixels.size());
}

// Several hypotheses of narrow intervals hold all of the pixels that are tried first. A background in the middle
// between two codes is what separates them.
TEST_CASE("a port that rounds the mean alone is right over a background in the middle between two codes") {
    for (const std::string scene : {"showroom", "random:seed=24,triangles=6"}) {
        OpenedScene opened{scene, 64, 48};
        opened.options.background = {0.9f, 0.9f, 0.8f, 1};
        const Samples lists = samples_of(opened);
        const ResolvedVerdict verdict = judge_resolved(lists, Colors{rounded_once(opened, lists)});
        INFO(scene << ": " << to_text(verdict));
        CHECK(verdict.is_right());
    }
}
