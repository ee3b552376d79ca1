// tools/oracle/judge/sample_habits.cpp - composites samples in the ways of ports (sample_habits.h).
#include "tools/oracle/judge/sample_habits.h"

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

SampleColor without_mask(const SamplePixelLists& pixel) {
    std::vector<SampleFragment> all;
    for (const auto& list : pixel.lists)
        for (const SampleFragment& f : list)
            if (std::ranges::find(all, f.primitive, &SampleFragment::primitive) == all.end()) all.push_back(f);
    std::ranges::stable_sort(all, {}, [](const SampleFragment& f) { return std::pair{f.depth, f.primitive}; });
    FrontSum front;
    for (const SampleFragment& f : all) front.add(f.color, f.alpha);
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
            if (resolve == DepthResolve::mean)
                depth += own / count;
            else if (&list == &pixel.lists[0])
                depth = own;
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

namespace {

struct SampleHabit {
    std::string_view words;
    SampleColor (*of)(const SamplePixelLists& pixel);
};
const SampleHabit habits[] = {
    {"a fragment covers the whole pixel: the samples that it covers are not kept in its list", without_mask},
    {"layers are resolved before the next peel, which compares with the mean of the samples' depths",
     [](const SamplePixelLists& pixel) { return peeled_resolved(pixel, DepthResolve::mean); }},
    {"layers are resolved before the next peel, which compares with the first sample's depth",
     [](const SamplePixelLists& pixel) { return peeled_resolved(pixel, DepthResolve::first_sample); }},
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

bool is_picture_of(const SampleHabit& habit, const verdict::Samples& samples, const verdict::Samples& at_samples,
                   const verdict::Colors& picture, std::size_t wrong) {
    const std::size_t most = std::max<std::size_t>(2, wrong / 40);
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
    return off <= most;
}

}  // namespace

std::string sample_habit(const peeling::FrameRequest& input, const verdict::Colors& picture, std::size_t wrong) {
    constexpr std::size_t few = 10;
    if (wrong < few) return "";
    using rasterizer::Interpolation;
    const verdict::Samples at_samples = samples_by({"", input.profile, Interpolation::sample}, input);
    for (const Interpolation interpolation : {input.options.raster.interpolation, Interpolation::centre}) {
        const verdict::Samples samples = samples_by({"", input.profile, interpolation}, input);
        if (!std::ranges::all_of(samples, [](const auto& s) { return s->keeps(); })) return "";
        for (const SampleHabit& habit : habits)
            if (is_picture_of(habit, samples, at_samples, picture, wrong)) return std::string{habit.words};
        if (input.options.raster.interpolation == Interpolation::centre) break;
    }
    return "";
}

}  // namespace strata::oracle
