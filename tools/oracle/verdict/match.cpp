#include "tools/oracle/verdict/match.h"

#include <algorithm>
#include <limits>
#include <mutex>

#include "tools/oracle/verdict/pricing.h"

namespace strata::oracle::verdict {

bool holds(const Reach& reach, const std::array<double, 4>& value) noexcept {
    constexpr double fine = 0x1p-40;  // codes are quotients, rounded on both sides
    for (std::size_t c = 0; c < 3; ++c)
        if (!(value[c] >= reach[c].low - fine && value[c] <= reach[c].high + fine)) return false;
    return true;
}

TieMask ties_that_hold(const Compositor& compositor, std::span<const Rule> rules, const PixelList& list,
                       const std::array<double, 4>& value, StackMaker& maker) {
    const bool has_hidden_ties = !rules.empty() && has_ties(list.hidden);
    if (!has_ties(list.visible) && !has_hidden_ties)
        return holds(compositor.reach(maker.with(rules, list, {})), value) ? all_ties : 0;
    TieMask mask = 0;
    for (std::size_t n = 0; n < ties_count; ++n)
        if (holds(compositor.reach(maker.with(rules, list, ties_number(n))), value)) mask |= 1u << n;
    return mask;
}

namespace {

std::size_t first_of(TieMask mask) noexcept {
    std::size_t n = 0;
    while (n + 1 < ties_count && (mask >> n & 1) == 0) ++n;
    return n;
}

}  // namespace

StackedPixel stacked(std::span<const Rule> rules, const SampledPixel& pixel, StackMaker& maker) {
    StackedPixel made{.value = pixel.value};
    const bool has_some = has_ties(pixel.list.visible) || (!rules.empty() && has_ties(pixel.list.hidden));
    for (std::size_t n = 0; n < (has_some ? ties_count : 1); ++n) {
        const Stack& stack = maker.with(rules, pixel.list, ties_number(n));
        if (std::ranges::find(made.stacks, stack) == made.stacks.end()) made.stacks.push_back(stack);
    }
    return made;
}

const Stack* reaching(const Compositor& compositor, const StackedPixel& pixel) {
    for (const Stack& stack : pixel.stacks)
        if (holds(compositor.reach(stack), pixel.value)) return &stack;
    return nullptr;
}

namespace {

// What a hypothesis costs of a sample.
struct Cost {
    std::uint64_t wrong = 0;
    double bits = 0;
    // Where no hypothesis holds, a wrong pixel weighs more: what makes it wrong is a mistake, which has a reason of its own.
    [[nodiscard]] double total(const Pricing& pricing) const noexcept {
        return bits + 4 * static_cast<double>(wrong) * pricing.of_wrong();
    }
};

// The sample is looked at no further once the cost is more than `most_bits`, or a pixel is wrong where none may be: that one
// comes first from then on, for it may well tell against the next hypothesis, too.
Cost cost_of(const Hypothesis& hypothesis, std::vector<const StackedPixel*>& pixels, Wrong allowed, double most_bits) {
    const Compositor compositor{hypothesis};
    const Pricing pricing{hypothesis.result.storage};
    Cost cost{.bits = bits_of(hypothesis)};
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        const Stack* const stack = reaching(compositor, *pixels[i]);
        if (stack != nullptr)
            cost.bits += pricing.of(compositor.reach(*stack));
        else
            ++cost.wrong;
        if (cost.wrong > 0 && allowed == Wrong::none) {
            std::rotate(pixels.begin(), pixels.begin() + static_cast<std::ptrdiff_t>(i),
                        pixels.begin() + static_cast<std::ptrdiff_t>(i) + 1);
            break;
        }
        if (cost.total(pricing) > most_bits) break;
    }
    return cost;
}

}  // namespace

std::optional<Hypothesis> best_of(const std::vector<Hypothesis>& all, std::span<const Rule> rules, const Sample& sample,
                                  Wrong allowed) {
    StackMaker maker{sample.cleared()};
    std::vector<StackedPixel> made;
    for (const SampledPixel& pixel : sample.pixels()) made.push_back(stacked(rules, pixel, maker));
    std::vector<const StackedPixel*> pixels;
    for (const StackedPixel& pixel : made) pixels.push_back(&pixel);
    double best = std::numeric_limits<double>::max();
    std::optional<Hypothesis> found;
    for (const Hypothesis& h : all) {
        const Cost cost = cost_of(h, pixels, allowed, best);
        const double bits = cost.total(Pricing{h.result.storage});
        if (bits >= best || (allowed == Wrong::none && cost.wrong > 0)) continue;
        best = bits;
        found = h;
    }
    return found;
}

namespace {

double exact_over(const Layer& layer, std::size_t c, double behind) noexcept {
    const double alpha = layer.color[3], color = layer.color[c];
    return (layer.is_premultiplied ? color : alpha * color) + (1 - alpha) * behind;
}

// Exact OVER in binary64.
std::array<double, 3> exact(const Stack& stack) noexcept {
    std::array<double, 3> color{stack.background[0], stack.background[1], stack.background[2]};
    for (std::size_t i = stack.layers.size(); i-- > 0;)
        for (std::size_t c = 0; c < 3; ++c) color[c] = exact_over(stack.layers[i], c, color[c]);
    return color;
}

double levels_of(Storage storage) noexcept {
    return storage == Storage::unorm10 ? 1023 : storage == Storage::unorm16 ? 65535 : 255;
}

// How far a pixel is off the exact result, and could be.
void measure(const Stack& stack, const Reach& reach, const std::array<double, 4>& value, Storage storage,
             Checked& found) {
    const std::array<double, 3> truth = exact(stack);
    const double levels = levels_of(storage);
    const auto as_code = [&](double v) {
        return has_codes(storage) ? std::floor(std::clamp(v, 0.0, 1.0) * levels + 0.5) : v * levels;
    };
    for (std::size_t c = 0; c < 3; ++c) {
        const double wanted = as_code(truth[c]);
        found.observed = std::max(found.observed, std::fabs(as_code(value[c]) - wanted));
        found.possible = std::max(
            {found.possible, std::fabs(as_code(reach[c].low) - wanted), std::fabs(as_code(reach[c].high) - wanted)});
    }
}

constexpr std::size_t most_examples = 64;  // of a tile's wrong pixels, which the next choice has to reckon with

// A tile's part of the picture.
struct PartChecked {
    Checked checked{};
    TieMask everywhere = all_ties;
    Sample examples{};
};

class Checker {
  public:
    Checker(const SceneFragments& scene, const Colors& candidate, const Account& account)
        : scene_{scene}, candidate_{candidate}, account_{account}, compositor_{account.hypothesis} {}

    [[nodiscard]] PartChecked part(const TileLists& tile) const {
        StackMaker maker{scene_.cleared()};
        PartChecked part;
        part.examples = Sample{scene_.cleared()};
        for (std::size_t p = 0; p < tile.rect.area(); ++p) look_at(scene_.at(tile, p), maker, part);
        return part;
    }

  private:
    void look_at(const PixelList& list, StackMaker& maker, PartChecked& part) const {
        const auto value = candidate_.at(list.x, list.y);
        Checked& found = part.checked;
        ++found.pixels;
        found.covered += list.visible.empty() ? 0 : 1;
        const TieMask mask = ties_that_hold(compositor_, account_.rules, list, value, maker);
        if (mask == 0) {
            found.wrong_pixels.push_back(static_cast<std::uint32_t>(list.y * scene_.width() + list.x));
            if (part.examples.pixels().size() < most_examples) part.examples.add(list, value);
            return;
        }
        found.tied += mask != all_ties ? 1 : 0;
        part.everywhere &= mask;
        const Ties ties = ties_number(first_of(mask));
        const Stack& stack = maker.with(account_.rules, list, ties);
        const Reach reach = compositor_.reach(stack);
        found.bits += Pricing{account_.hypothesis.result.storage}.of(reach);
        measure(stack, reach, value, account_.hypothesis.result.storage, found);
        if (account_.rules.empty()) return;
        Stack own = stack;
        const Stack& right = maker.right(list, ties);
        own.near = right.near;  // the division of a peel is no change of the structure
        own.near_without_middle = right.near_without_middle;
        if (own == right) return;
        ++found.changed;
        found.undecided += ties_that_hold(compositor_, {}, list, value, maker) != 0 ? 1 : 0;
    }

    const SceneFragments& scene_;
    const Colors& candidate_;
    const Account& account_;
    Compositor compositor_;
};

void merge(const Checked& part, Checked& all) {
    all.pixels += part.pixels;
    all.covered += part.covered;
    all.tied += part.tied;
    all.changed += part.changed;
    all.undecided += part.undecided;
    all.bits += part.bits;
    all.observed = std::max(all.observed, part.observed);
    all.possible = std::max(all.possible, part.possible);
    all.wrong_pixels.insert(all.wrong_pixels.end(), part.wrong_pixels.begin(), part.wrong_pixels.end());
}

}  // namespace

Checked check_all(const SceneFragments& scene, const Colors& candidate, const Account& account, Sample& examples) {
    const Checker checker{scene, candidate, account};
    Checked all{.account = account};
    TieMask everywhere = all_ties;
    std::mutex mutex;
    scene.for_each_tile([&](const TileLists& tile) {
        const PartChecked part = checker.part(tile);
        const std::scoped_lock lock{mutex};
        merge(part.checked, all);
        everywhere &= part.everywhere;
        for (const SampledPixel& pixel : part.examples.pixels()) examples.add(pixel.list, pixel.value);
    });
    std::ranges::sort(all.wrong_pixels);
    examples.sort();
    all.has_one_tie_rule = everywhere != 0;
    all.ties = ties_number(first_of(everywhere));
    return all;
}

std::optional<Checked> account_for(const std::vector<Hypothesis>& all, const std::vector<Rule>& rules,
                                   const SceneFragments& scene, const Colors& candidate, Sample& sample) {
    while (const auto hypothesis = best_of(all, rules, sample, Wrong::none)) {
        Sample examples{scene.cleared()};
        Checked found = check_all(scene, candidate, {rules, *hypothesis}, examples);
        if (found.is_whole()) return found;
        for (const SampledPixel& pixel : examples.pixels()) sample.add(pixel.list, pixel.value);
    }
    return std::nullopt;
}

}  // namespace strata::oracle::verdict
