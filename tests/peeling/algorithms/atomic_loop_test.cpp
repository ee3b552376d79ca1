// Tests atomic_loop, hybrid_transparency and the tail of front_to_back, with each kind of tail, against sorted lists in
// real numbers. peeling/reference/algorithms.md 21.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>

#include "tests/peeling/eighths.h"
#include "tests/peeling/expectations.h"

namespace {

using namespace strata::testing;
using strata::peeling::RenderOptions;
using strata::peeling::RenderResult;
using strata::peeling::Tail;
using strata::pipeline::Fault;

const ExpectedRow expected_atomic_loop{{.algorithm = "atomic_loop",
                                        .devices = Devices::buffers,
                                        .passes = [](int) { return 2; },
                                        .targets = {"tail", "result"}}};
const ExpectedRow expected_hybrid_transparency{{.algorithm = "hybrid_transparency",
                                                .devices = Devices::buffers,
                                                .passes = [](int) { return 2; },
                                                .targets = {"tail", "tail_sums", "tail_count", "result"},
                                                .render_targets = 2}};

struct CoreAndTail {
    std::vector<GivenFragment> core, tail;  // core: near to far; tail: in submission order
};

// The k nearest fragments of a pixel, and the others. With `share` fragments of equal depth are one entry with the
// colour of the last one.
CoreAndTail split_model(const GivenPixel& pixel, std::size_t k, bool share) {
    const auto fragments = visible(pixel);
    CoreAndTail split;
    if (share) {
        std::map<float, GivenFragment> last;
        for (const GivenFragment& f : fragments) last[f.depth] = f;
        for (const auto& [depth, f] : last)
            if (split.core.size() < k) split.core.push_back(f);
        for (const GivenFragment& f : fragments)
            if (f.depth > split.core.back().depth) split.tail.push_back(f);
        return split;
    }
    std::vector<std::size_t> order(fragments.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::ranges::stable_sort(order, {}, [&](std::size_t i) { return fragments[i].depth; });
    for (std::size_t i = 0; i < std::min(k, order.size()); ++i) split.core.push_back(fragments[order[i]]);
    for (std::size_t i = 0; i < fragments.size(); ++i)
        if (std::ranges::find(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(split.core.size()), i) ==
            order.begin() + static_cast<std::ptrdiff_t>(split.core.size()))
            split.tail.push_back(fragments[i]);
    return split;
}

Color3 tail_color(const std::vector<GivenFragment>& tail, const Color3& background, Tail kind) {
    Color3 color = background, sums{};
    double weights = 0, alphas = 0, through = 1;
    for (const GivenFragment& f : tail) {
        const RealLayer own = layer_of(f);
        const double a = f.color[3],
                     w = kind == Tail::weighted ? a * std::max(0.01, 3000 * std::pow(1.0 - f.depth, 3)) : 1;
        if (kind == Tail::blend) color = over(own, color);
        for (std::size_t c = 0; c < 3; ++c) sums[c] += own.color[c] * w;
        weights += a * w;
        alphas += a;
        through *= 1 - a;
    }
    if (kind == Tail::none || kind == Tail::blend || weights == 0) return color;
    if (kind == Tail::average)
        through = std::pow(1 - alphas / static_cast<double>(tail.size()), static_cast<double>(tail.size()));
    for (std::size_t c = 0; c < 3; ++c) color[c] = sums[c] / weights * (1 - through) + background[c] * through;
    return color;
}

Color3 core_over_tail(const GivenPixel& pixel, const CoreAndTail& split, Tail kind) {
    RealLayer all;
    for (const GivenFragment& f : split.core) all = joined(all, layer_of(f));
    return over(all, tail_color(split.tail, behind(pixel), kind));
}

}  // namespace

TEST_CASE("the k nearest fragments are composited in order over each tail of the others and equal in every execution") {
    const FragmentScene scene = eighths_scene(31, 6);
    for (const char* algorithm : {"atomic_loop", "hybrid_transparency"})
        for (const int k : {1, 2, 4, 8})
            for (const Tail tail : {Tail::none, Tail::blend, Tail::average, Tail::weighted}) {
                const bool share = std::string{algorithm} == "atomic_loop";
                RenderOptions options = eighths_options(scene);
                options.algorithm.nodes = k;
                options.algorithm.tail = tail;
                bool are_alike = true;
                const RenderResult result = rendered_alike(scene, algorithm, options, are_alike);
                INFO(algorithm << ", " << k << " nodes, tail " << static_cast<int>(tail));
                REQUIRE_FALSE(result.refusal);
                std::size_t overflowing = 0;
                const auto expected = [&](std::size_t p) {
                    const GivenPixel& pixel = scene.pixels[p];
                    if (visible(pixel).empty()) return behind(pixel);
                    const CoreAndTail split = split_model(pixel, static_cast<std::size_t>(k), share);
                    overflowing += split.tail.empty() ? 0 : 1;
                    return core_over_tail(pixel, split, tail);
                };
                // Tails of sums are rounded: at most 5 roundings for each of 6 fragments, in the numerator and in the
                // denominator.
                const bool is_exact = tail == Tail::none || tail == Tail::blend;
                CHECK(first_unlike(result.frame.color, expected, is_exact ? 0 : 60 * 0x1p-24) == "");
                CHECK(are_alike);
                CHECK(diagnosed(result, Fault::buffer_overflow) == overflowing);
            }
}

TEST_CASE("the default tail is blended for atomic_loop and averaged for hybrid_transparency") {
    const FragmentScene scene = eighths_scene(32, 6);
    RenderOptions options = eighths_options(scene);
    options.algorithm.nodes = 2;
    const auto picture = [&](const char* algorithm, std::optional<Tail> tail) {
        options.algorithm.tail = tail;
        return render(scene, {"ideal", algorithm}, options).frame.color;
    };
    CHECK(picture("atomic_loop", std::nullopt) == picture("atomic_loop", Tail::blend));
    CHECK(picture("hybrid_transparency", std::nullopt) == picture("hybrid_transparency", Tail::average));
}

TEST_CASE("front_to_back that stops early composites the tail of the remaining fragments in every execution") {
    const FragmentScene scene = eighths_scene(33, 6, false);
    for (const int passes : {1, 2, 3, 9})
        for (const Tail tail : {Tail::none, Tail::blend, Tail::average, Tail::weighted}) {
            RenderOptions options = eighths_options(scene);
            options.max_passes = passes;
            options.algorithm.tail = tail;
            bool are_alike = true;
            const RenderResult result = rendered_alike(scene, "front_to_back", options, are_alike);
            INFO(passes << " passes, tail " << static_cast<int>(tail));
            const auto expected = [&](std::size_t p) {
                const auto k = static_cast<std::size_t>(passes);
                return core_over_tail(scene.pixels[p], split_model(scene.pixels[p], k, false), tail);
            };
            const bool is_exact = tail == Tail::none || tail == Tail::blend;
            CHECK(first_unlike(result.frame.color, expected, is_exact ? 0 : 60 * 0x1p-24) == "");
            CHECK(are_alike);
        }
    RenderOptions options = eighths_options(scene);
    options.termination = {.rule = strata::pipeline::TerminationRule::ratio, .ratio = 40};  // after the first pass
    options.algorithm.tail = Tail::blend;
    CHECK(first_unlike(render(scene, {"ideal", "front_to_back"}, options).frame.color, [&](std::size_t p) {
              return core_over_tail(scene.pixels[p], split_model(scene.pixels[p], 1, false), Tail::blend);
          }) == "");
}

namespace {

// After `peels` peels of two layers each: those in front over the rest, and that over the layers behind it. Without
// ties.
Color3 between_ends(const GivenPixel& pixel, std::size_t peels, Tail kind) {
    std::vector<GivenFragment> sorted = visible(pixel), tail;
    std::ranges::sort(sorted, {}, &GivenFragment::depth);
    const std::size_t front = std::min(peels, (sorted.size() + 1) / 2), back = std::min(peels, sorted.size() / 2);
    Color3 color = behind(pixel);
    for (std::size_t i = 0; i < back; ++i) color = over(layer_of(sorted[sorted.size() - 1 - i]), color);
    for (const GivenFragment& f : visible(pixel)) {
        const auto number =
            static_cast<std::size_t>(std::ranges::find(sorted, f.depth, &GivenFragment::depth) - sorted.begin());
        if (number >= front && number < sorted.size() - back) tail.push_back(f);
    }
    RealLayer all;
    for (std::size_t i = 0; i < front; ++i) all = joined(all, layer_of(sorted[i]));
    return over(all, tail_color(tail, color, kind));
}

}  // namespace

TEST_CASE("dual that stops early composites the tail between its ends over the layers behind it") {
    const FragmentScene scene = eighths_scene(34, 6, false);
    for (const int passes : {1, 2, 3, 9})  // the first finds the ends
        for (const Tail tail : {Tail::none, Tail::blend, Tail::average, Tail::weighted}) {
            RenderOptions options = eighths_options(scene);
            options.max_passes = passes;
            options.algorithm.tail = tail;
            bool are_alike = true;
            const RenderResult result = rendered_alike(scene, "dual", options, are_alike);
            INFO(passes << " passes, tail " << static_cast<int>(tail));
            const auto expected = [&](std::size_t p) {
                return between_ends(scene.pixels[p], static_cast<std::size_t>(passes - 1), tail);
            };
            const bool is_exact = tail == Tail::none || tail == Tail::blend;
            CHECK(first_unlike(result.frame.color, expected, is_exact ? 0 : 60 * 0x1p-24) == "");
            CHECK(are_alike);
        }
}
