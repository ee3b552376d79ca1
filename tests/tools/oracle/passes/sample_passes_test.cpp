// Tests the passes of frames of several samples: every sample's targets against those of its own frame, rendered alone,
// and the published picture against the resolve of a frame without observers.
#include <algorithm>
#include <catch2/catch.hpp>
#include <stdexcept>

#include "peeling/registry.h"
#include "peeling/render.h"
#include "pipeline/device/check.h"
#include "pipeline/device/sample_points.h"
#include "scenes/camera.h"
#include "scenes/scene.h"
#include "tools/oracle/passes/passes.h"

using namespace strata;
using namespace strata::oracle;
using peeling::Multisampling;
using rasterizer::Interpolation;

namespace {

struct SampledScene {
    scenes::Scene scene;
    pipeline::View view;
    pipeline::DeviceProfile profile;
    peeling::RenderOptions options{};
};

SampledScene sampled_teapot(const char* profile) {
    SampledScene l{scenes::load_scene("teapot", {}), {}, *pipeline::find_profile(profile)};
    l.options.width = 24;
    l.options.height = 16;
    l.options.threads = 1;
    l.options.alpha = 0.5f;
    l.view = scenes::orbit_view(l.scene.bounds, 30, 20, 1.5);
    return l;
}

std::vector<PassReport> sampled_passes(SampledScene l, const peeling::Algorithm& algorithm,
                                       const Multisampling& sampling) {
    std::vector<PassReport> all;
    l.options.sampling = sampling;
    passes({l.scene.list, l.view, l.profile, l.options}, algorithm,
           [&](PassReport&& pass) { all.push_back(std::move(pass)); });
    return all;
}

std::vector<PassReport> passes_of_sample(SampledScene l, const peeling::Algorithm& algorithm, int samples, int number) {
    pipeline::set_sample(l.options.raster, l.profile.sample_positions, samples, static_cast<std::size_t>(number));
    return sampled_passes(l, algorithm, {});
}

// Without an observer, and without an audit.
peeling::RenderResult resolved_frame(SampledScene& l, const peeling::Algorithm& algorithm,
                                     const Multisampling& sampling) {
    l.options.audit = false;
    l.options.sampling = sampling;
    return peeling::Renderer{l.scene.list, l.view, l.profile, l.options}.render(algorithm);
}

pipeline::Image sample_image(const pipeline::Image& all, int sample) {
    pipeline::Image part{all.format, all.width, all.height};
    for (int y = 0; y < all.height; ++y)
        for (int x = 0; x < all.width; ++x)
            for (int c = 0; c < all.channels(); ++c)
                part.codes[part.index(x, y, c)] = all.codes[all.index(x, y, c, sample)];
    return part;
}

// The passes of the loop: those at the end, which composite once, have another number where a frame ends earlier.
std::size_t passes_of_loop(const std::vector<PassReport>& passes) {
    const auto last = std::find_if(passes.rbegin(), passes.rend(),
                                   [](const PassReport& pass) { return pass.kind == ReportedPassKind::geometry; });
    return static_cast<std::size_t>(passes.rend() - last);
}

// The numbers of targets that were compared, and of those that differ.
struct TargetAgreement {
    int compared = 0, wrong = 0;
};

TargetAgreement compare_sample(const std::vector<PassReport>& joint, const std::vector<PassReport>& alone, int sample) {
    TargetAgreement agreement;
    const std::size_t count = joint.size() == alone.size() ? joint.size() - 1 : passes_of_loop(alone);
    for (std::size_t k = 0; k < count; ++k) {
        const bool is_same_pass = joint[k].kind == alone[k].kind && joint[k].before == alone[k].before &&
                                  joint[k].reads == alone[k].reads && joint[k].writes == alone[k].writes &&
                                  joint[k].targets.size() == alone[k].targets.size();
        agreement.wrong += is_same_pass ? 0 : 1;
        for (std::size_t t = 0; is_same_pass && t < joint[k].targets.size(); ++t) {
            const NamedImage &ours = joint[k].targets[t], &theirs = alone[k].targets[t];
            ++agreement.compared;
            agreement.wrong += ours.name == theirs.name && sample_image(ours.image, sample) == theirs.image ? 0 : 1;
        }
    }
    return agreement;
}

}  // namespace

TEST_CASE("sample s of every target is that of the frame of sample s alone") {
    for (const char* name : {"front_to_back", "dual", "weighted_average"})
        for (const int samples : {2, 4})
            for (const Interpolation where : {Interpolation::sample, Interpolation::centre}) {
                SampledScene l = sampled_teapot("geforce8");
                l.options.raster.interpolation = where;
                const peeling::Algorithm& algorithm = *peeling::find_algorithm(name);
                const auto joint = sampled_passes(l, algorithm, {.samples = samples});
                INFO(name << ", samples: " << samples << ", at the "
                          << (where == Interpolation::centre ? "centre" : "sample"));
                std::vector<std::vector<PassReport>> alone;
                std::size_t shared = joint.size();
                TargetAgreement all;
                for (int s = 0; s < samples; ++s) {
                    alone.push_back(passes_of_sample(l, algorithm, samples, s));
                    const auto [compared, wrong] = compare_sample(joint, alone.back(), s);
                    all.compared += compared, all.wrong += wrong;
                    shared = std::min(shared, passes_of_loop(alone.back()));
                }
                CHECK(all.compared > samples);
                CHECK(all.wrong == 0);
                // Counts are sums over the samples.
                for (std::size_t k = 0; k < shared; ++k) {
                    std::uint64_t passed = 0, tallied = 0, counted = 0;
                    for (const auto& frame : alone) {
                        passed += frame[k].passed, tallied += frame[k].tallied;
                        for (const Query& query : frame[k].queries) counted += query.count;
                    }
                    CHECK(joint[k].passed == passed);
                    CHECK(joint[k].tallied == tallied);
                    if (!joint[k].queries.empty()) CHECK(joint[k].queries.at(0).count == counted);
                }
                REQUIRE(joint.back().kind == ReportedPassKind::published);
                CHECK(joint.back().targets.at(0).image ==
                      resolved_frame(l, algorithm, {.samples = samples}).frame.color);
            }
}

TEST_CASE("the passes of several samples publish the picture of every algorithm and rule of loads and termination") {
    SampledScene l = sampled_teapot("ideal");
    const auto check = [&](const peeling::Algorithm& algorithm, const Multisampling& sampling) {
        const peeling::RenderResult result = resolved_frame(l, algorithm, sampling);
        INFO(algorithm.name << ", at most " << l.options.max_passes << " passes");
        if (result.outcome == peeling::Outcome::refused) {
            CHECK_THROWS_AS(sampled_passes(l, algorithm, sampling), pipeline::Refused);
            return 0;
        }
        const auto all = sampled_passes(l, algorithm, sampling);
        CHECK(all.back().targets.at(0).image == result.frame.color);
        CHECK(std::ranges::count(all, ReportedPassKind::geometry, &PassReport::kind) == result.frame.passes.geometry);
        return 1;
    };
    int ran = 0;
    for (const peeling::Algorithm& algorithm : peeling::algorithms()) {
        l.options.termination = {};
        l.options.max_passes = 0;
        ran += check(algorithm, {.samples = 2});
        l.options.max_passes = 3;
        static_cast<void>(check(algorithm, {.samples = 2}));
        l.options.max_passes = 0;
        l.options.termination = {pipeline::TerminationRule::ratio, 0.05, 0};
        static_cast<void>(check(algorithm, {.samples = 2}));
    }
    CHECK(ran >= 15);
    l = sampled_teapot("ideal");
    for (const auto loads : {pipeline::LoadedSample::zero, pipeline::LoadedSample::resolved})
        CHECK(check(*peeling::find_algorithm("front_to_back"),
                    {.samples = 4, .loads = loads, .composites = pipeline::LoadedSample::resolved}) == 1);
    l = sampled_teapot("geforce3");
    CHECK(check(*peeling::find_algorithm("depth_units"), {.samples = 2, .resolve = pipeline::Resolve::quincunx}) == 1);
}

TEST_CASE("a ratio of the frame is that of all samples") {
    SampledScene l = sampled_teapot("geforce8");
    const peeling::Algorithm& algorithm = *peeling::find_algorithm("front_to_back");
    constexpr int samples = 4;
    std::vector<std::uint64_t> counts;  // of each query, over all samples
    for (const PassReport& pass : sampled_passes(l, algorithm, {.samples = samples}))
        for (const Query& query : pass.queries) counts.push_back(query.count);
    REQUIRE(counts.size() > 3);
    // The count of a query in the middle is the limit, so that it goes on and the next one, which is less, does not.
    const std::size_t middle = counts.size() / 2;
    REQUIRE(counts[middle] > counts[middle + 1]);
    l.options.termination.rule = pipeline::TerminationRule::ratio;
    l.options.termination.ratio = static_cast<double>(counts[middle]) / (24.0 * 16 * samples) * (1 - 1e-9);
    std::vector<std::uint64_t> shorter;
    for (const PassReport& pass : sampled_passes(l, algorithm, {.samples = samples}))
        for (const Query& query : pass.queries) shorter.push_back(query.count);
    CHECK(shorter ==
          std::vector<std::uint64_t>(counts.begin(), counts.begin() + static_cast<std::ptrdiff_t>(middle) + 2));
    CHECK(resolved_frame(l, algorithm, {.samples = samples}).frame.passes.geometry == static_cast<int>(middle) + 2);
}

TEST_CASE("an error of the one who takes passes ends the frame") {
    SampledScene l = sampled_teapot("geforce8");
    l.options.sampling.samples = 4;
    int taken = 0;
    const auto take = [&](PassReport&&) {
        if (++taken == 2) throw std::runtime_error("the disk is full");
    };
    CHECK_THROWS_WITH(passes({l.scene.list, l.view, l.profile, l.options}, *peeling::find_algorithm("dual"), take),
                      "the disk is full");
    CHECK(taken == 2);
}
