// Expected values: two samples of a pixel, composited by hand.
#include "tools/oracle/judge/sample_habits.h"

#include <catch2/catch.hpp>

using strata::oracle::by_shares;
using strata::oracle::composited_resolved;
using strata::oracle::DepthResolve;
using strata::oracle::peeled_resolved;
using strata::oracle::SampleColor;
using strata::oracle::SampleFragment;
using strata::oracle::SamplePixelLists;
using strata::oracle::without_mask;

namespace {

constexpr SampleColor sky{0, 0, 1};

SampleFragment red(double depth) {
    return {.color = {0.5, 0, 0}, .alpha = 0.5, .depth = depth, .stored = depth, .primitive = 0};
}
SampleFragment green(double depth) {
    return {.color = {0, 0.5, 0}, .alpha = 0.5, .depth = depth, .stored = depth, .primitive = 1};
}

void check_color(const SampleColor& found, const SampleColor& wanted) {
    for (std::size_t c = 0; c < 3; ++c) CHECK(found[c] == Approx(wanted[c]).margin(1e-12));
}

}  // namespace

TEST_CASE("without masks a fragment of one sample covers the pixel, and one of two samples counts once") {
    check_color(without_mask({{{red(0.3)}, {}}, {sky, sky}}), {0.5, 0, 0.5});
    check_color(without_mask({{{red(0.3)}, {red(0.3)}}, {sky, sky}}), {0.5, 0, 0.5});
    check_color(without_mask({{{red(0.3)}, {green(0.2)}}, {sky, sky}}), {0.25, 0.5, 0.25});
}

TEST_CASE("a peel of resolved layers composites the mean of a layer") {
    // Red covers half of the pixel: a layer of alpha 0.25. The mean depth is 0.65.
    check_color(peeled_resolved({{{red(0.3)}, {}}, {sky, sky}}, DepthResolve::mean), {0.25, 0, 0.75});
    // A program that runs once a pixel has one depth, 0.3: the mean of those that the samples store.
    SampleFragment near_red = red(0.3), far_red = red(0.3);
    near_red.stored = 0.2;
    far_red.stored = 0.4;
    check_color(peeled_resolved({{{near_red, green(0.9)}, {far_red, green(0.9)}}, {sky, sky}}, DepthResolve::mean),
                {0.5, 0.25, 0.25});
    // Programs of the samples: the mean is 0.6, before which green is lost, and behind which red is found again.
    check_color(peeled_resolved({{{red(0.2), green(0.5)}, {red(1.0)}}, {sky, sky}}, DepthResolve::mean),
                {0.625, 0, 0.375});
}

TEST_CASE("a peel that compares with the first sample's depth loses what the other has before it") {
    // Both samples give their nearest; then only what is behind 0.3 is left, which green at 0.25 is not.
    check_color(peeled_resolved({{{red(0.3)}, {red(0.1), green(0.25)}}, {sky, sky}}, DepthResolve::first_sample),
                {0.5, 0, 0.5});
    // Where the first sample has nothing, its depth is the cleared one: the peel ends.
    check_color(peeled_resolved({{{}, {red(0.1), green(0.25)}}, {sky, sky}}, DepthResolve::first_sample),
                {0.25, 0, 0.75});
}

TEST_CASE("a peel that compares with the nearest or farthest depth of the samples repeats or loses the others'") {
    // Three passes: behind 0.1 red is found at both samples, at 0.3 again; behind 0.3 once more at the second.
    const SamplePixelLists apart{{{red(0.3)}, {green(0.1), red(0.9)}}, {sky, sky}};
    const double second = 0.5 * 0.5, third = 0.25 * 0.25;
    check_color(peeled_resolved(apart, DepthResolve::nearest), {0.25 + second + third, 0.25, 0.25 * 0.75});
    // The farthest is 0.3, behind which red at 0.9 is left at one of two samples.
    check_color(peeled_resolved(apart, DepthResolve::farthest), {0.25 + 0.5 * 0.25, 0.25, 0.5 * 0.75});
}

TEST_CASE("layers that are peeled by samples and resolved one by one hide less than the samples do") {
    // The first layer is red at one sample and green at the other; the second one is green at one of them.
    check_color(composited_resolved({{{red(0.2), green(0.5)}, {green(0.3)}}, {sky, sky}}), {0.25, 0.375, 0.375});
}

TEST_CASE("alphas times their share of samples hide less than the samples that are covered") {
    check_color(by_shares({{{red(0.3)}, {}}, {sky, sky}}), {0.25, 0, 0.75});
    check_color(by_shares({{{red(0.3)}, {red(0.3)}}, {sky, sky}}), {0.5, 0, 0.5});
    // Half a red of alpha 1/4 behind half a green of 1/4; samples would have 1/4 of each.
    check_color(by_shares({{{red(0.3)}, {green(0.2)}}, {sky, sky}}), {0.1875, 0.25, 0.5625});
}
