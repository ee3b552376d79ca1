// tools/oracle/fragments/sample.cpp - fills a sample: which pixels are taken, by their positions alone, and the
// fragments and colour of each (sample.h).
#include "tools/oracle/fragments/sample.h"

#include <algorithm>
#include <mutex>

#include "tools/oracle/fragments/coverages.h"
#include "tools/oracle/rules/structure.h"

namespace strata::oracle::verdict {

Colors::Colors(const TargetImage& target, const ChannelUse& use) : target_{&target}, use_{use} {}

double Colors::value(int x, int y, int channel) const noexcept {
    const std::size_t pixel =
        static_cast<std::size_t>(y) * static_cast<std::size_t>(target_->width) + static_cast<std::size_t>(x);
    return target_->value_at(pixel, channel);
}

std::array<double, 4> Colors::at(int x, int y) const noexcept {
    if (target_->channels < 3) {
        const double grey = value(x, y, 0);
        return {grey, grey, grey, 1};
    }
    return {value(x, y, 0), value(x, y, 1), value(x, y, 2), 1};
}

double Colors::alpha_at(int x, int y) const noexcept { return has_alpha() ? value(x, y, target_->channels - 1) : 1; }

Sample::Sample(const Sample& other) : setting_{other.setting_} {
    for (const SampledPixel& pixel : other.pixels_) add(pixel.list, pixel.value);
}

void Sample::add(const PixelList& list, const std::array<double, 4>& value) {
    SampledPixel& pixel = pixels_.emplace_back();
    pixel.list = list;
    pixel.value = value;
    pixel.fragments.assign(list.visible.begin(), list.visible.end());
    pixel.fragments.insert(pixel.fragments.end(), list.hidden.begin(), list.hidden.end());
    const std::span<const Fragment> all{pixel.fragments};
    pixel.list.visible = all.first(list.visible.size());
    pixel.list.hidden = all.subspan(list.visible.size());
}

bool Sample::has(int x, int y) const noexcept {
    return std::ranges::any_of(pixels_, [&](const SampledPixel& p) { return p.list.x == x && p.list.y == y; });
}

void Sample::sort() {
    std::ranges::sort(pixels_, {}, [](const SampledPixel& p) { return std::pair{p.list.y, p.list.x}; });
}

Sample Sample::thinned(std::size_t most) const {
    Sample some{*setting_};
    const std::size_t step = std::max<std::size_t>(pixels_.size() / std::max<std::size_t>(most, 1), 1);
    for (std::size_t i = 0; i < pixels_.size(); i += step) some.add(pixels_[i].list, pixels_[i].value);
    return some;
}

namespace {

// An estimate of the number of structures that each rule has to try at the pixel.
std::size_t structures_at(const PixelList& list) {
    const TieChoices choices = tie_choices({}, list);
    std::size_t own = std::max<std::size_t>(1, choices.permutations);
    for (std::size_t n = 1; n < ties_count; ++n) own += choices.same_as[n] == n ? 1 : 0;
    const std::size_t others = list.edge != nullptr ? list.edge->others.size() : 0;
    return (own + others * own) * (list.has_spreads ? 2 : 1);
}

}  // namespace

Sample Sample::with_few_structures(std::size_t most) const {
    constexpr std::size_t few = 4;
    Sample some{*setting_};
    std::size_t left = most;
    for (const SampledPixel& pixel : pixels_) {
        const std::size_t structures = structures_at(pixel.list);
        if (structures > few && structures > left) continue;
        if (structures > few) left -= structures;
        some.add(pixel.list, pixel.value);
    }
    return some;
}

namespace {

// A pseudo-random number in [0, 1) that depends only on the position.
double lot_of(int x, int y) noexcept {
    std::uint64_t h = static_cast<std::uint64_t>(x) << 32 | static_cast<std::uint32_t>(y);
    h = (h ^ h >> 33) * 0xff51afd7ed558ccdull;
    h = (h ^ h >> 33) * 0xc4ceb9fe1a85ec53ull;
    return static_cast<double>((h ^ h >> 33) >> 11) * 0x1p-53;
}

}  // namespace

Sample sampled(const SceneFragments& scene, const Colors& candidate, std::size_t most) {
    // A pixel's chance is proportional to its number of fragments plus a quarter.
    const double pixels = static_cast<double>(scene.width()) * scene.height();
    const double chance = static_cast<double>(most) / (static_cast<double>(scene.count()) + 0.25 * pixels);
    Sample sample{scene.setting()};
    std::mutex mutex;
    scene.for_each_tile([&](const TileLists& tile) {
        for (std::size_t p = 0; p < tile.rect.area(); ++p) {
            const PixelList list = scene.at(tile, p);
            const double weight = static_cast<double>(list.visible.size() + list.hidden.size()) + 0.25;
            if (lot_of(list.x, list.y) >= weight * chance) continue;
            const std::scoped_lock lock{mutex};
            sample.add(list, candidate.at(list.x, list.y));
        }
    });
    sample.sort();
    return sample;
}

}  // namespace strata::oracle::verdict
