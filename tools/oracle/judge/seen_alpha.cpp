// tools/oracle/judge/seen_alpha.cpp - composites a sample of pixels with every --alpha (seen_alpha.h).
#include "tools/oracle/judge/seen_alpha.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "pipeline/device/profile.h"
#include "tools/oracle/verdict/other_rules.h"

namespace strata::oracle {

namespace {

using Color = std::array<double, 3>;

// The mean difference of a channel from the exact composite of fragments whose alpha is multiplied by `factor`; no
// channel counts for more than some codes.
double distance_with(const verdict::Sample& sample, const Color& background, double factor) {
    constexpr double most = 16.0 / 255;
    double sum = 0;
    std::size_t pixels = 0;
    for (const verdict::SampledPixel& pixel : sample.pixels()) {
        if (pixel.list.visible.empty()) continue;
        double through = 1;
        Color color{};
        for (const verdict::Fragment& f : pixel.list.visible) {
            const double alpha = factor * double{f.color[3]};
            for (std::size_t c = 0; c < 3; ++c) color[c] += through * alpha * double{f.color[c]};
            through *= 1 - alpha;
        }
        for (std::size_t c = 0; c < 3; ++c)
            sum += std::min(most, std::fabs(color[c] + through * background[c] - pixel.value[c]));
        ++pixels;
    }
    return pixels == 0 ? std::numeric_limits<double>::infinity() : sum / (3 * static_cast<double>(pixels));
}

}  // namespace

std::vector<float> seen_alphas(const peeling::FrameRequest& input, const verdict::Colors& picture,
                               const Color& background, const rasterizer::Rect& part) {
    constexpr std::size_t most_sampled = 1024;
    constexpr double nearly = 3.0 / 255;
    peeling::RenderOptions options = verdict::scissored(input.options, part);
    options.alpha = 1.0f;  // all surfaces are transparent, with their own alpha
    const verdict::SceneFragments scene{input.with(options), input.options.fragment_memory};
    const verdict::Sample sample = verdict::sampled(scene, picture, most_sampled);
    const auto best_of = [&](int from, int to, int step) {
        int best = from;
        double least = std::numeric_limits<double>::infinity();
        for (int thousandths = from; thousandths <= to; thousandths += step)
            if (const double d = distance_with(sample, background, thousandths / 1000.0); d < least) {
                least = d;
                best = thousandths;
            }
        return std::pair{best, least};
    };
    const auto [hundredth, coarse] = best_of(10, 1000, 10);
    const auto [thousandth, fine] = best_of(std::max(1, hundredth - 9), std::min(1000, hundredth + 9), 1);
    std::vector<float> seen;
    if (fine > nearly) return seen;
    const auto is_written = [](int number) { return number <= 990 || number == 1000; };  // 0.996 is the rounding of 1
    const bool is_finer = fine < 0.8 * coarse;
    for (const int number : {is_finer ? thousandth : hundredth, is_finer ? hundredth : thousandth})
        if (const float alpha = static_cast<float>(number) / 1000.0f;
            is_written(number) && input.options.alpha != alpha && std::ranges::find(seen, alpha) == seen.end())
            seen.push_back(alpha);
    return seen;
}

}  // namespace strata::oracle
