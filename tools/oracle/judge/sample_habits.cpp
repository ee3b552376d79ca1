// tools/oracle/judge/sample_habits.cpp - composites samples in the ways of ports (sample_habits.h).
#include "tools/oracle/judge/sample_habits.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "tools/oracle/judge/samples_verdict.h"

namespace strata::oracle {

namespace {

SampleColor mean_of(const std::vector<SampleColor>& colors) {
    SampleColor mean{};
    for (const SampleColor& color : colors)
        for (std::size_t c = 0; c < 3; ++c) mean[c] += color[c] / static_cast<double>(colors.size());
    return mean;
}

// Adds a layer of a premultiplied colour under those before.
struct FrontSum {
    SampleColor sum{};
    double through = 1;
    void add(const SampleColor& multiplied, double alpha) {
        for (std::size_t c = 0; c < 3; ++c) sum[c] += through * multiplied[c];
        through *= 1 - alpha;
    }
    [[nodiscard]] SampleColor over(const SampleColor& behind) const {
        SampleColor color = sum;
        for (std::size_t c = 0; c < 3; ++c) color[c] += through * behind[c];
        return color;
    }
};

}  // namespace

namespace {

// One list of every fragment that covers a sample, with its number of samples.
struct CoveringFragment {
    SampleFragment fragment;
    double samples = 0;
};

std::vector<CoveringFragment> covering(const SamplePixelLists& pixel) {
    std::vector<CoveringFragment> all;
    for (const auto& list : pixel.lists)
        for (const SampleFragment& f : list) {
            auto found = std::ranges::find(all, f.primitive, [](const auto& one) { return one.fragment.primitive; });
            if (found == all.end()) found = all.insert(all.end(), {f});
            found->samples += 1;
        }
    std::ranges::stable_sort(all, {}, [](const CoveringFragment& one) {
        return std::pair{one.fragment.depth, one.fragment.primitive};
    });
    return all;
}

}  // namespace

SampleColor without_mask(const SamplePixelLists& pixel) {
    FrontSum front;
    for (const auto& [f, samples] : covering(pixel)) front.add(f.color, f.alpha);
    return front.over(mean_of(pixel.behind));
}

SampleColor by_shares(const SamplePixelLists& pixel) {
    FrontSum front;
    for (const auto& [f, samples] : covering(pixel)) {
        const double share = samples / static_cast<double>(pixel.lists.size());
        front.add({share * f.color[0], share * f.color[1], share * f.color[2]}, share * f.alpha);
    }
    return front.over(mean_of(pixel.behind));
}

SampleColor peeled_resolved(const SamplePixelLists& pixel, DepthResolve resolve) {
    FrontSum front;
    double before = -1;
    const auto count = static_cast<double>(pixel.lists.size());
    constexpr int most_passes = 256;
    constexpr double nearly = 0x1p-24;  // a mean of depths is the pixel's own, apart from rounding
    for (int pass = 0; pass < most_passes; ++pass) {
        SampleColor layer{};
        double alpha = 0, depth = 0;
        bool is_empty = true;
        for (const auto& list : pixel.lists) {
            const auto next =
                std::ranges::find_if(list, [&](const SampleFragment& f) { return f.depth > before + nearly; });
            const bool has = next != list.end();
            // A sample without a fragment keeps the cleared depth.
            const double own = has ? next->stored : 1;
            const bool is_first = &list == &pixel.lists[0];
            switch (resolve) {
                case DepthResolve::mean: depth += own / count; break;
                case DepthResolve::first_sample: depth = is_first ? own : depth; break;
                case DepthResolve::nearest: depth = is_first ? own : std::min(depth, own); break;
                case DepthResolve::farthest: depth = is_first ? own : std::max(depth, own); break;
            }
            if (!has) continue;
            is_empty = false;
            for (std::size_t c = 0; c < 3; ++c) layer[c] += next->color[c] / count;
            alpha += next->alpha / count;
        }
        if (is_empty) break;
        front.add(layer, alpha);
        before = depth;
    }
    return front.over(mean_of(pixel.behind));
}

SampleColor composited_resolved(const SamplePixelLists& pixel) {
    FrontSum front;
    std::size_t most = 0;
    for (const auto& list : pixel.lists) most = std::max(most, list.size());
    const auto count = static_cast<double>(pixel.lists.size());
    for (std::size_t k = 0; k < most; ++k) {
        SampleColor layer{};
        double alpha = 0;
        for (const auto& list : pixel.lists) {
            if (k >= list.size()) continue;
            for (std::size_t c = 0; c < 3; ++c) layer[c] += list[k].color[c] / count;
            alpha += list[k].alpha / count;
        }
        front.add(layer, alpha);
    }
    return front.over(mean_of(pixel.behind));
}

namespace {

struct SampleHabit {
    std::string_view words;
    SampleColor (*of)(const SamplePixelLists& pixel);
};
const SampleHabit habits[] = {
    {"a fragment covers the whole pixel: the samples that it covers are not kept in its list", without_mask},
    {"a fragment covers the whole pixel with its alpha times its share of covered samples", by_shares},
    {"layers are peeled by samples, but resolved before they are composited", composited_resolved},
    {"layers are resolved before the next peel, which compares with the mean of the samples' depths",
     [](const SamplePixelLists& pixel) { return peeled_resolved(pixel, DepthResolve::mean); }},
    {"layers are resolved before the next peel, which compares with the first sample's depth",
     [](const SamplePixelLists& pixel) { return peeled_resolved(pixel, DepthResolve::first_sample); }},
    {"layers are resolved before the next peel, which compares with the nearest of the samples' depths",
     [](const SamplePixelLists& pixel) { return peeled_resolved(pixel, DepthResolve::nearest); }},
    {"layers are resolved before the next peel, which compares with the farthest of the samples' depths",
     [](const SamplePixelLists& pixel) { return peeled_resolved(pixel, DepthResolve::farthest); }},
};

// With the depth that is stored at its sample, which is in `at_sample`.
SampleFragment fragment_of(const verdict::Fragment& f, std::span<const verdict::Fragment> at_sample) {
    const auto own = std::ranges::find(at_sample, f.primitive, &verdict::Fragment::primitive);
    const double alpha{f.color[3]};
    return {.color = {double{f.color[0]} * alpha, double{f.color[1]} * alpha, double{f.color[2]} * alpha},
            .alpha = alpha,
            .depth = double{f.shader_z},
            .stored = double{own != at_sample.end() ? own->shader_z : f.shader_z},
            .primitive = f.primitive};
}

// Calls visit(x, y, pixel) for every pixel; stops if that is false. `at_samples`: with depths of the samples.
template <class Visit>
void for_each_pixel(const verdict::Samples& samples, const verdict::Samples& at_samples, Visit visit) {
    for (int row = 0; row < samples[0]->height(); ++row)
        for (int x = 0; x < samples[0]->width(); ++x) {
            SamplePixelLists pixel;
            int y = 0;
            for (std::size_t i = 0; i < samples.size(); ++i) {
                const verdict::PixelList list = samples[i]->list_at(x, row);
                const auto at_sample = at_samples[i]->list_at(x, row).visible;
                y = list.y;
                std::vector<SampleFragment>& made = pixel.lists.emplace_back();
                for (const verdict::Fragment& f : list.visible) made.push_back(fragment_of(f, at_sample));
                pixel.behind.push_back({double{list.behind[0]}, double{list.behind[1]}, double{list.behind[2]}});
            }
            if (!visit(x, y, pixel)) return;
        }
}

// The number of wrong pixels; empty if they are too many.
std::optional<std::size_t> wrong_by(const SampleHabit& habit, const verdict::Samples& samples,
                                    const verdict::Samples& at_samples, const verdict::Colors& picture,
                                    std::size_t wrong) {
    const std::size_t most = std::max<std::size_t>(2, wrong / 25);
    constexpr double two_codes = 2.01 / 255;
    std::size_t off = 0;
    for_each_pixel(samples, at_samples, [&](int x, int y, const SamplePixelLists& pixel) {
        const SampleColor made = habit.of(pixel);
        const auto seen = picture.at(x, y);
        for (std::size_t c = 0; c < 3; ++c)
            if (std::fabs(made[c] - seen[c]) > two_codes) {
                ++off;
                break;
            }
        return off <= most;
    });
    return off <= most ? std::optional{off} : std::nullopt;
}

}  // namespace

std::string NamedHabit::line(std::size_t wrong) const {
    return unexplained == 0
               ? fmt::format("  explains all {} pixels that are not the mean of right samples\n", wrong)
               : fmt::format("  {} pixels are wrong then; {} are not the mean of right samples\n", unexplained, wrong);
}

std::optional<NamedHabit> sample_habit(const peeling::FrameRequest& input, const verdict::Colors& picture,
                                       std::size_t wrong) {
    constexpr std::size_t few = 10;
    if (wrong < few) return std::nullopt;
    using rasterizer::Interpolation;
    const verdict::Samples at_samples = samples_by({"", input.profile, Interpolation::sample}, input);
    for (const Interpolation interpolation : {input.options.raster.interpolation, Interpolation::centre}) {
        const verdict::Samples samples = samples_by({"", input.profile, interpolation}, input);
        if (!std::ranges::all_of(samples, [](const auto& s) { return s->keeps(); })) return std::nullopt;
        for (const SampleHabit& habit : habits)
            if (const auto off = wrong_by(habit, samples, at_samples, picture, wrong))
                return NamedHabit{std::string{habit.words}, *off};
        if (input.options.raster.interpolation == Interpolation::centre) break;
    }
    return std::nullopt;
}

}  // namespace strata::oracle
