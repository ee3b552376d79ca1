// Tests the histories of a pixel's samples: against the histories of the samples' own frames, and their pictures
// against the resolved one by the mean of codes in integers.
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "peeling/registry.h"
#include "peeling/render.h"
#include "pipeline/device/sample_points.h"
#include "tests/tools/oracle/explain/explained_scene.h"
#include "tools/oracle/explain/history_report.h"

using namespace strata;
using namespace strata::oracle;
using namespace strata::testing;

namespace {

History history_of_sample(peeling::FrameRequest input, const peeling::Algorithm& algorithm, std::size_t sample, int x,
                          int y) {
    pipeline::set_sample(input.options.raster, input.profile.sample_positions, input.options.sampling.samples, sample);
    input.options.sampling = {};
    return explain(input, algorithm, {x, y, x + 1, y + 1}).at(0);
}

}  // namespace

TEST_CASE("the histories of a pixel's samples are those of their own frames and their mean is the picture") {
    const ExplainedScene column = explained_scene("teapot", 16, 12);
    for (const char* name : {"front_to_back", "dual", "weighted_average"})
        for (const int samples : {2, 4}) {
            peeling::FrameRequest input = column.input("geforce8");
            input.options.sampling.samples = samples;
            const peeling::Algorithm& algorithm = *peeling::find_algorithm(name);
            const peeling::RenderResult usual =
                peeling::Renderer{input.list, input.view, input.profile, input.options}.render(algorithm);
            int fragments = 0, differing = 0;
            for (int x = 0, y = 6; x < 16; x += 2) {
                const SampledHistory history = explain_samples(input, algorithm, x, y);
                REQUIRE(history.samples.size() == static_cast<std::size_t>(samples));
                std::vector<std::uint32_t> sums(4);
                for (std::size_t s = 0; s < history.samples.size(); ++s) {
                    const History& sample = history.samples[s];
                    const History alone = history_of_sample(input, algorithm, s, x, y);
                    REQUIRE(sample.fragments.size() == alone.fragments.size());
                    for (std::size_t f = 0; f < sample.fragments.size(); ++f) {
                        CHECK(sample.fragments[f].primitive == alone.fragments[f].primitive);
                        CHECK(sample.fragments[f].path_codes == alone.fragments[f].path_codes);
                        CHECK(sample.fragments[f].barycentric == alone.fragments[f].barycentric);
                    }
                    CHECK(composited(sample) == composited(alone));
                    CHECK(sample.sample == static_cast<int>(s));
                    CHECK(history.points[s] == pipeline::sample_points(input.profile.sample_positions, samples)[s]);
                    const std::vector<std::uint32_t>& codes = sample.lines.back().held.at(0).before;
                    CHECK(codes == alone.lines.back().held.at(0).before);
                    for (std::size_t c = 0; c < 4; ++c) sums[c] += codes[c];
                    fragments += static_cast<int>(sample.fragments.size());
                    differing += s > 0 && sample.fragments.size() != history.samples[0].fragments.size() ? 1 : 0;
                }
                const auto n = static_cast<std::uint32_t>(samples);
                for (std::size_t c = 0; c < 4; ++c) {
                    CHECK(history.resolved[c] == (2 * sums[c] + n) / (2 * n));
                    CHECK(history.resolved[c] ==
                          usual.frame.color.codes[usual.frame.color.index(x, y, static_cast<int>(c))]);
                }
            }
            CHECK(fragments > 10);
            CHECK(differing > 0);  // an edge: the samples have other fragments
        }
}

TEST_CASE("the report of a pixel's samples has a section for each and the resolved picture") {
    const ExplainedScene column = explained_scene("planes:count=2", 16, 12);
    peeling::FrameRequest input = column.input("geforce8");
    input.options.sampling = {.samples = 2, .loads = pipeline::LoadedSample::zero};
    input.options.max_passes = 8;
    const std::vector<SampledHistory> histories{
        explain_samples(input, *peeling::find_algorithm("front_to_back"), 8, 6),
        explain_samples(input, *peeling::find_algorithm("weighted_average"), 8, 6)};
    const std::string text = to_text(histories[0]);
    using Catch::Contains;
    CHECK_THAT(text, Contains("sample 0 at 12,12 sixteenths of the pixel: pixel 8,6 by front_to_back"));
    CHECK_THAT(text, Contains("sample 1 at 4,4 sixteenths of the pixel: pixel 8,6"));
    CHECK_THAT(text, Contains("programs load the sample: zero in geometry passes, own in full-screen passes"));
    CHECK_THAT(text, Contains(": the box resolve of 2 samples"));
    const auto document = nlohmann::json::parse(to_json(histories));
    REQUIRE(document["histories"].size() == 4);
    CHECK(document["histories"][3]["sample"] == 1);
    CHECK(document["pixels"][1]["algorithm"] == "weighted_average");
    CHECK(document["pixels"][0]["picture"] == histories[0].resolved);
    CHECK(document["pixels"][0]["loads"] == "zero");
    REQUIRE(document["first_differences"].size() == 2);
    CHECK_THAT(document["first_differences"][1].get<std::string>(), Contains("sample 1: weighted_average"));
}
