#include "tools/oracle/search/split_sample.h"

#include <algorithm>

namespace strata::oracle::verdict {

SplitSample split_by_account(const Sample& sample, const Hypothesis& closest) {
    const Compositor compositor{closest};
    StackMaker maker{sample.setting()};
    SplitSample parts;
    for (const SampledPixel& pixel : sample.pixels()) {
        SplitPixel made{&pixel, stacked({}, pixel, maker)};
        (reaching(compositor, made.right, maker.steps()) == nullptr ? parts.wrong : parts.right)
            .push_back(std::move(made));
    }
    return parts;
}

bool is_unchanged(const StackedPixel& made, const SplitPixel& pixel) {
    return std::ranges::equal(made.stacks, pixel.right.stacks, [](const Stack& a, const Stack& b) {
        return a.layers == b.layers && a.background == b.background && a.is_linear == b.is_linear &&
               a.finish == b.finish && a.mixing == b.mixing;
    });
}

SplitPixel::Reached how_reached(const Compositor& compositor, const StackedPixel& pixel, Steps& steps) {
    const Stack* const found = reaching(compositor, pixel, steps);
    if (found == nullptr) return SplitPixel::Reached::no;
    return is_as_given(pixel, *found) ? SplitPixel::Reached::as_given : SplitPixel::Reached::at_edge;
}

void note(SplitSample& parts, const std::vector<Hypothesis>& each, const Setting& setting) {
    const std::vector<Compositor> compositors(each.begin(), each.end());
    parts.noted = each;
    setting.work->for_each(parts.wrong.size(), [&](std::size_t i) {
        SplitPixel& pixel = parts.wrong[i];
        Steps steps{*setting.work};
        pixel.reached.clear();
        for (const Compositor& c : compositors) pixel.reached.push_back(how_reached(c, pixel.right, steps));
    });
    if (setting.work->is_spent()) parts.noted.clear();
}

std::vector<const SplitPixel*> thinned(const std::vector<SplitPixel>& pixels, std::size_t most) {
    std::vector<const SplitPixel*> some;
    const std::size_t step = pixels.size() / most + 1;
    for (std::size_t i = 0; i < pixels.size(); i += step) some.push_back(&pixels[i]);
    return some;
}

std::vector<Rules> singles(const std::vector<Rule>& rules) {
    std::vector<Rules> all;
    for (const Rule& rule : rules) all.push_back({rule});
    return all;
}

}  // namespace strata::oracle::verdict
