// tools/oracle/search/match.cpp - decides whether a pixel has one of the values that its fragments allow: the given
// list under every rule for ties, then other coverages, then colours changed by up to their spreads; and which
// hypothesis describes a sample in the fewest bits.
#include "tools/oracle/search/match.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <map>
#include <numeric>

#include "tools/oracle/fragments/coverages.h"
#include "tools/oracle/rounding/pricing.h"

namespace strata::oracle::verdict {

namespace {

bool may_have_ties(std::span<const Rule> rules, const PixelList& list) noexcept {
    return has_ties(list.visible) || (!rules.empty() && has_ties(list.hidden));
}

}  // namespace

namespace {

MatchingTies found_in(const Compositor& compositor, std::span<const Rule> rules, const PixelList& list,
                      const std::array<double, 4>& value, bool is_moved, StackMaker& maker) {
    const auto is_held = [&](const Ties& ties) {
        const Stack& stack = maker.with(rules, list, ties, is_moved);
        const ReachableColor reach = compositor.reach(stack);
        maker.steps().composite(stack.layers.size() + reach.sums.weights());
        return holds(reach, value);
    };
    MatchingTies found{.list = list, .is_moved = is_moved};
    const auto add = [&](TieMask mask, const Ties& ties) {
        found.mask |= mask;
        found.ties = ties;
    };
    if (!may_have_ties(rules, list)) {
        if (is_held({})) add(all_ties, {});
        return found;
    }
    const TieChoices choices = tie_choices(rules, list);
    std::array<bool, ties_count> are_held{};
    for (std::size_t n = 0; n < ties_count; ++n) {
        const std::size_t same = choices.same_as[n];
        are_held[n] = same == n ? is_held(ties_number(n)) : are_held[same];
    }
    for (std::size_t n = ties_count; n-- > 0;)
        if (are_held[n]) add(1u << n, ties_number(n));
    for (std::uint32_t p = 1; p < choices.permutations && found.mask == 0; ++p)  // 0 is submission order
        if (const Ties other{TieHandling::other, ComparedDepth::code, p}; is_held(other)) add(1u << ties_count, other);
    return found;
}

}  // namespace

MatchingTies matching_ties(const Compositor& compositor, std::span<const Rule> rules, const PixelList& list,
                           const std::array<double, 4>& value, StackMaker& maker) {
    MatchingTies found = found_in(compositor, rules, list, value, false, maker);
    const auto try_others = [&](bool is_moved) {
        if (list.edge == nullptr) return;
        for (const OtherList& other : list.edge->others) {
            found = found_in(compositor, rules, other.at(list.x, list.y), value, is_moved, maker);
            if (found.mask == 0) continue;
            found.has_close_depths = other.has_close_depths;
            break;
        }
    };
    if (found.mask != 0) return found;
    try_others(false);
    if (found.mask == 0 && list.has_spreads) {
        found = found_in(compositor, rules, list, value, true, maker);
        if (found.mask == 0) try_others(true);
    }
    found.at_edge = true;
    return found;
}

namespace {

// Equal structures have equal hashes, except for zeros of different sign; such structures are then both kept.
std::uint64_t hash_of(const Stack& stack) noexcept {
    std::uint64_t hash = stack.layers.size();
    const auto add = [&](const Rgba& color) {
        for (std::size_t c = 0; c < 4; ++c) hash = (hash ^ std::bit_cast<std::uint32_t>(color[c])) * 0x9e3779b97f4a7c15;
    };
    for (const Layer& layer : stack.layers) add(layer.color);
    add(stack.background);
    return hash;
}

}  // namespace

StackedPixel stacked(std::span<const Rule> rules, const SampledPixel& pixel, StackMaker& maker) {
    StackedPixel made{.value = pixel.value};
    std::vector<std::uint64_t> hashes;  // of made.stacks; ties and edges make thousands of structures, few of them new
    const auto add_all = [&](const PixelList& list, bool is_moved) {
        const auto add = [&](const Ties& ties) {
            const Stack& stack = maker.with(rules, list, ties, is_moved);
            const std::uint64_t hash = hash_of(stack);
            for (auto at = std::ranges::find(hashes, hash); at != hashes.end();
                 at = std::find(at + 1, hashes.end(), hash))
                if (made.stacks[static_cast<std::size_t>(at - hashes.begin())] == stack) return;
            hashes.push_back(hash);
            made.stacks.push_back(stack);
        };
        add({});
        if (!may_have_ties(rules, list)) return;
        const TieChoices choices = tie_choices(rules, list);
        for (std::size_t n = 1; n < ties_count; ++n)
            if (choices.same_as[n] == n) add(ties_number(n));
        for (std::uint32_t p = 1; p < choices.permutations; ++p) add({TieHandling::other, ComparedDepth::code, p});
    };
    const auto add_others = [&](bool is_moved) {
        if (pixel.list.edge == nullptr) return;
        for (const OtherList& other : pixel.list.edge->others) add_all(other.at(pixel.list.x, pixel.list.y), is_moved);
    };
    add_all(pixel.list, false);
    made.given = made.stacks.size();
    add_others(false);
    if (!pixel.list.has_spreads) return made;
    add_all(pixel.list, true);
    add_others(true);
    return made;
}

const Stack* reaching(const Compositor& compositor, const StackedPixel& pixel, Steps& steps) {
    for (const Stack& stack : pixel.stacks) {
        const ReachableColor reach = compositor.reach(stack);
        steps.composite(stack.layers.size() + reach.sums.weights());
        if (holds(reach, pixel.value)) return &stack;
    }
    return nullptr;
}

void AskedPixel::ask_all() {
    asked_.resize(pixel_->stacks.size());
    std::iota(asked_.begin(), asked_.end(), 0u);
}

ReachedStack AskedPixel::reached(const Compositor& compositor, Steps& steps) {
    for (const std::uint32_t i : asked_) {
        const Stack& stack = pixel_->stacks[i];
        ReachableColor reach = compositor.reach(stack, known_[i]);
        steps.composite(stack.layers.size() + reach.sums.weights());
        if (holds(reach, pixel_->value)) return {&stack, std::move(reach)};
    }
    return {};
}

ReachedStack AskedPixel::narrowed(const Compositor& widest, Steps& steps) {
    ask_all();
    ReachedStack first = reached(widest, steps);
    const auto at = first.stack != nullptr ? first.stack - pixel_->stacks.data() : std::ssize(asked_);
    asked_.erase(asked_.begin(), asked_.begin() + at);
    return first;
}

bool is_as_given(const StackedPixel& pixel, const Stack& found) noexcept {
    return static_cast<std::size_t>(&found - pixel.stacks.data()) < pixel.given;
}

namespace {

// The cost of a sample under one hypothesis.
struct SampleCost {
    double wrong = 0, bits = 0;
    bool is_as_given = true;  // holds for every pixel
    // If no hypothesis holds, a wrong pixel costs four times as much as in pricing.h: it is caused by a mistake, which
    // needs its own explanation.
    [[nodiscard]] double total(const Pricing& pricing) const noexcept { return bits + 4 * wrong * pricing.of_wrong(); }
};

// A pixel of a sample, for all pixels with the same structures and the same value.
struct WeightedPixel {
    StackedPixel pixel{};
    double weight = 1;
};

struct PricedPixel {
    AskedPixel asked;
    double weight = 1;
};

// The structures and the value of a pixel as bytes, for comparing them.
std::string key_of(const StackedPixel& pixel) {
    std::string key;
    const auto add = [&](const auto& value) { key.append(reinterpret_cast<const char*>(&value), sizeof value); };
    for (const double v : pixel.value) add(v);
    for (const Stack& stack : pixel.stacks) {
        for (const Layer& layer : stack.layers) {
            for (std::size_t c = 0; c < 4; ++c) add(layer.color[c]);
            add(layer.is_premultiplied);
            add(layer.slack);
            add(layer.spread);
        }
        for (std::size_t c = 0; c < 4; ++c) add(stack.background[c]);
        add(stack.background_spread);
        add(stack.near);
        add(stack.near_without_middle);
        add(stack.is_linear);
        add(stack.finish);
        add(stack.is_moved);
        add(stack.mixing.through);
        add(stack.mixing.behind);
        add(stack.mixing.attenuates);
        add(stack.mixing.color_bits);
        add(stack.mixing.weight_bits);
        add(stack.mixing.picture_too);
    }
    return key;
}

std::vector<WeightedPixel> weighted(std::span<const Rule> rules, const Sample& sample) {
    StackMaker maker{sample.setting()};
    std::map<std::string, std::size_t> number_of;
    std::vector<WeightedPixel> pixels;
    for (const SampledPixel& pixel : sample.pixels()) {
        StackedPixel made = stacked(rules, pixel, maker);
        const auto [found, is_new] = number_of.emplace(key_of(made), pixels.size());
        if (is_new)
            pixels.push_back({.pixel = std::move(made)});
        else
            pixels[found->second].weight += 1;
    }
    return pixels;
}

// Stops when the cost exceeds `most_bits`, or at the first wrong pixel if none is allowed.
SampleCost cost_of(const Hypothesis& hypothesis, std::vector<PricedPixel*>& pixels, WrongPixels allowed,
                   double most_bits, Steps& steps, bool narrows = false) {
    const Compositor compositor{hypothesis};
    const Pricing pricing{hypothesis.result.storage};
    SampleCost cost{.bits = bits_of(hypothesis)};
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        AskedPixel& asked = pixels[i]->asked;
        const double weight = pixels[i]->weight;
        const ReachedStack found = narrows ? asked.narrowed(compositor, steps) : asked.reached(compositor, steps);
        if (found.stack == nullptr) {
            cost.wrong += weight;
            std::swap(pixels[i], pixels[i / 2]);  // it is likely to reject the next hypothesis, too
        } else {
            const bool as_given = is_as_given(asked.pixel(), *found.stack);
            cost.is_as_given = cost.is_as_given && as_given;
            cost.bits += weight * (pricing.of(found.reach) + (as_given ? 0 : Pricing::of_edge));
        }
        if (cost.wrong > 0 && allowed == WrongPixels::none) break;
        if (cost.total(pricing) > most_bits) break;
    }
    return cost;
}

// A lower bound for the cost of all members of a family: the cost of the pixels that their widest hypothesis does not
// reach.
double least_of(const HypothesisFamily& family, std::vector<PricedPixel*>& pixels, WrongPixels allowed, double most,
                Steps& steps) {
    SampleCost cost = cost_of(family.widest, pixels, allowed, std::numeric_limits<double>::max(), steps, true);
    if (allowed == WrongPixels::none && cost.wrong > 0) return most;
    cost.bits = 0;
    return cost.total(Pricing{family.widest.result.storage});
}

}  // namespace

std::optional<Hypothesis> best_of(const Families& all, std::span<const Rule> rules, const Sample& sample,
                                  WrongPixels allowed, const std::optional<Hypothesis>& likely) {
    Steps steps{*sample.setting().work};
    if (allowed == WrongPixels::none && steps.is_spent()) return std::nullopt;
    const std::vector<WeightedPixel> made = weighted(rules, sample);
    std::vector<PricedPixel> priced;
    for (const WeightedPixel& one : made) priced.push_back({AskedPixel{one.pixel}, one.weight});
    std::vector<PricedPixel*> pixels;
    for (PricedPixel& pixel : priced) pixels.push_back(&pixel);
    constexpr double any_bits = std::numeric_limits<double>::max();
    if (likely)
        if (const SampleCost cost = cost_of(*likely, pixels, WrongPixels::none, any_bits, steps);
            cost.wrong == 0 && cost.is_as_given)
            return likely;
    // Returns the first hypothesis with a cost below `most` that is_enough, or the one with the least cost.
    const auto choose = [&](double most, auto is_enough) {
        double best = most;
        std::optional<Hypothesis> found;
        for (const HypothesisFamily& family : all) {
            if (allowed == WrongPixels::none && steps.is_spent()) break;
            if (least_of(family, pixels, allowed, best, steps) >= best) continue;
            for (const Hypothesis& h : family.members) {
                const SampleCost cost = cost_of(h, pixels, allowed, best, steps);
                const double bits = cost.total(Pricing{h.result.storage});
                if (bits >= best || (allowed == WrongPixels::none && cost.wrong > 0)) continue;
                best = bits;
                found = h;
                if (is_enough(bits)) return std::pair{found, best};
            }
        }
        return std::pair{found, best};
    };
    const auto [least, bits] = choose(any_bits, [](double) { return false; });
    if (!least || allowed == WrongPixels::some) return least;
    // Of those with nearly equal costs the simplest is chosen: families and their members are in that order.
    return choose(1.1 * bits + 64, [](double) { return true; }).first;
}

Families holding(const Families& all, const Sample& sample) {
    Steps steps{*sample.setting().work};
    const std::vector<WeightedPixel> made = weighted({}, sample);
    std::vector<AskedPixel> pixels;
    for (const WeightedPixel& one : made) pixels.emplace_back(one.pixel);
    Families left;
    for (const HypothesisFamily& family : all) {
        const Compositor widest{family.widest};
        if (!std::ranges::all_of(pixels, [&](AskedPixel& p) { return p.narrowed(widest, steps).stack != nullptr; }))
            continue;
        HypothesisFamily own{.widest = family.widest};
        std::ranges::copy_if(family.members, std::back_inserter(own.members), [&](const Hypothesis& h) {
            const Compositor compositor{h};
            return std::ranges::all_of(pixels,
                                       [&](AskedPixel& p) { return p.reached(compositor, steps).stack != nullptr; });
        });
        if (!own.members.empty()) left.push_back(std::move(own));
    }
    return left;
}

Families narrower(const Families& all, const Hypothesis& wide, const Sample& sample) {
    constexpr double much_less = 0.8;
    constexpr std::size_t few = 64;
    StackMaker maker{sample.setting()};
    std::vector<Stack> stacks;
    const std::size_t step = sample.pixels().size() / few + 1;
    for (std::size_t i = 0; i < sample.pixels().size(); i += step)
        stacks.push_back(maker.right(sample.pixels()[i].list, {}));
    const auto open_by = [&](const Hypothesis& h) {
        const Compositor compositor{h};
        double bits = 0;
        for (const Stack& stack : stacks) bits += Pricing{h.result.storage}.of(compositor.reach(stack));
        return bits;
    };
    const double most = much_less * open_by(wide);
    Families left;
    for (const HypothesisFamily& family : all) {
        HypothesisFamily own{.widest = family.widest};
        std::ranges::copy_if(family.members, std::back_inserter(own.members),
                             [&](const Hypothesis& h) { return open_by(h) <= most; });
        if (!own.members.empty()) left.push_back(std::move(own));
    }
    return left;
}

}  // namespace strata::oracle::verdict
