#include "tools/oracle/verdict/match.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <map>
#include <mutex>

#include "tools/oracle/verdict/coverages.h"
#include "tools/oracle/verdict/pricing.h"

namespace strata::oracle::verdict {

bool holds(const Reach& reach, const std::array<double, 4>& value) noexcept {
    constexpr double fine = 0x1p-40;  // codes are quotients, rounded on both sides
    for (std::size_t c = 0; c < 3; ++c)
        if (!(value[c] >= reach[c].low - fine && value[c] <= reach[c].high + fine)) return false;
    return true;
}

namespace {

bool may_have_ties(std::span<const Rule> rules, const PixelList& list) noexcept {
    return has_ties(list.visible) || (!rules.empty() && has_ties(list.hidden));
}

}  // namespace

namespace {

TiesFound found_in(const Compositor& compositor, std::span<const Rule> rules, const PixelList& list,
                   const std::array<double, 4>& value, bool is_moved, StackMaker& maker) {
    const auto is_held = [&](const Ties& ties) {
        return holds(compositor.reach(maker.with(rules, list, ties, is_moved)), value);
    };
    TiesFound found{.list = list, .is_moved = is_moved};
    const auto add = [&](TieMask mask, const Ties& ties) {
        found.mask |= mask;
        found.ties = ties;
    };
    if (!may_have_ties(rules, list)) {
        if (is_held({})) add(all_ties, {});
        return found;
    }
    for (std::size_t n = ties_count; n-- > 0;)
        if (is_held(ties_number(n))) add(1u << n, ties_number(n));
    for (std::uint32_t p = 0; p < permutations && found.mask == 0; ++p)
        if (const Ties other{TieRule::other, DepthKey::code, p}; is_held(other)) add(1u << ties_count, other);
    return found;
}

}  // namespace

TiesFound ties_that_hold(const Compositor& compositor, std::span<const Rule> rules, const PixelList& list,
                         const std::array<double, 4>& value, StackMaker& maker) {
    TiesFound found = found_in(compositor, rules, list, value, false, maker);
    const auto try_others = [&](bool is_moved) {
        if (list.edge == nullptr) return;
        for (const OtherList& other : list.edge->others) {
            found = found_in(compositor, rules, other.at(list.x, list.y), value, is_moved, maker);
            if (found.mask != 0) break;
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

StackedPixel stacked(std::span<const Rule> rules, const SampledPixel& pixel, StackMaker& maker) {
    StackedPixel made{.value = pixel.value};
    const auto add_all = [&](const PixelList& list, bool is_moved) {
        const auto add = [&](const Ties& ties) {
            const Stack& stack = maker.with(rules, list, ties, is_moved);
            if (std::ranges::find(made.stacks, stack) == made.stacks.end()) made.stacks.push_back(stack);
        };
        add({});
        if (!may_have_ties(rules, list)) return;
        for (std::size_t n = 0; n < ties_count; ++n) add(ties_number(n));
        for (std::uint32_t p = 0; p < permutations; ++p) add({TieRule::other, DepthKey::code, p});
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

const Stack* reaching(const Compositor& compositor, const StackedPixel& pixel) {
    for (const Stack& stack : pixel.stacks)
        if (holds(compositor.reach(stack), pixel.value)) return &stack;
    return nullptr;
}

bool is_as_given(const StackedPixel& pixel, const Stack& found) noexcept {
    return static_cast<std::size_t>(&found - pixel.stacks.data()) < pixel.given;
}

namespace {

// What a hypothesis costs of a sample.
struct Cost {
    double wrong = 0, bits = 0;
    bool is_as_given = true;  // every pixel
    // Where no hypothesis holds, a wrong pixel weighs more: what makes it wrong is a mistake, which has a reason of its own.
    [[nodiscard]] double total(const Pricing& pricing) const noexcept { return bits + 4 * wrong * pricing.of_wrong(); }
};

// A pixel of a sample, which stands for all that have the same structures and the same value.
struct WeightedPixel {
    StackedPixel pixel{};
    double weight = 1;
};

// All that makes a pixel what it is, as bytes.
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
            pixels.push_back({std::move(made), 1});
        else
            pixels[found->second].weight += 1;
    }
    return pixels;
}

// The sample is looked at no further once the cost is more than `most_bits`, or a pixel is wrong where none may be.
Cost cost_of(const Hypothesis& hypothesis, std::vector<const WeightedPixel*>& pixels, Wrong allowed, double most_bits) {
    const Compositor compositor{hypothesis};
    const Pricing pricing{hypothesis.result.storage};
    Cost cost{.bits = bits_of(hypothesis)};
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        const auto& [pixel, weight] = *pixels[i];
        const Stack* const stack = reaching(compositor, pixel);
        if (stack == nullptr) {
            cost.wrong += weight;
            std::swap(pixels[i], pixels[i / 2]);  // it may well tell against the next hypothesis, too
        } else {
            const bool as_given = is_as_given(pixel, *stack);
            cost.is_as_given = cost.is_as_given && as_given;
            cost.bits += weight * (pricing.of(compositor.reach(*stack)) + (as_given ? 0 : Pricing::of_edge));
        }
        if (cost.wrong > 0 && allowed == Wrong::none) break;
        if (cost.total(pricing) > most_bits) break;
    }
    return cost;
}

// What the members of a family cost at least: the pixels that their widest hypothesis does not reach.
double least_of(const HypothesisFamily& family, std::vector<const WeightedPixel*>& pixels, Wrong allowed, double most) {
    Cost cost = cost_of(family.widest, pixels, allowed, std::numeric_limits<double>::max());
    if (allowed == Wrong::none && cost.wrong > 0) return most;
    cost.bits = 0;
    return cost.total(Pricing{family.widest.result.storage});
}

}  // namespace

std::optional<Hypothesis> best_of(const Families& all, std::span<const Rule> rules, const Sample& sample, Wrong allowed,
                                  const std::optional<Hypothesis>& likely) {
    const std::vector<WeightedPixel> made = weighted(rules, sample);
    std::vector<const WeightedPixel*> pixels;
    for (const WeightedPixel& pixel : made) pixels.push_back(&pixel);
    constexpr double any_bits = std::numeric_limits<double>::max();
    if (likely)
        if (const Cost cost = cost_of(*likely, pixels, Wrong::none, any_bits); cost.wrong == 0 && cost.is_as_given)
            return likely;
    // The first hypothesis that costs less than `most`, or the one that costs the least.
    const auto choose = [&](double most, auto is_enough) {
        double best = most;
        std::optional<Hypothesis> found;
        for (const HypothesisFamily& family : all) {
            if (least_of(family, pixels, allowed, best) >= best) continue;
            for (const Hypothesis& h : family.members) {
                const Cost cost = cost_of(h, pixels, allowed, best);
                const double bits = cost.total(Pricing{h.result.storage});
                if (bits >= best || (allowed == Wrong::none && cost.wrong > 0)) continue;
                best = bits;
                found = h;
                if (is_enough(bits)) return std::pair{found, best};
            }
        }
        return std::pair{found, best};
    };
    const auto [least, bits] = choose(any_bits, [](double) { return false; });
    if (!least || allowed == Wrong::some) return least;
    // Of those that tell it nearly as well the plainest is believed: families and their members stand in that order.
    return choose(1.1 * bits + 64, [](double) { return true; }).first;
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

constexpr std::size_t most_examples =
    64;  // of a tile's pixels that are wrong or at edges: the next choice has to reckon with them

// A tile's part of the picture.
struct PartChecked {
    Checked checked{};
    TieMask everywhere = all_ties;
    Sample examples;
};

class Checker {
  public:
    Checker(const SceneFragments& scene, const Colors& candidate, const Account& account)
        : scene_{scene}, candidate_{candidate}, account_{account}, compositor_{account.hypothesis} {}

    [[nodiscard]] PartChecked part(const TileLists& tile) const {
        StackMaker maker{scene_.setting()};
        PartChecked part{.examples = Sample{scene_.setting()}};
        for (std::size_t p = 0; p < tile.rect.area(); ++p) look_at(scene_.at(tile, p), maker, part);
        return part;
    }

  private:
    void look_at(const PixelList& list, StackMaker& maker, PartChecked& part) const {
        const auto value = candidate_.at(list.x, list.y);
        Checked& found = part.checked;
        ++found.pixels;
        found.covered += list.visible.empty() ? 0 : 1;
        const TiesFound way = ties_that_hold(compositor_, account_.rules, list, value, maker);
        const TieMask mask = way.mask;
        if (mask == 0) {
            found.wrong_pixels.push_back(static_cast<std::uint32_t>(list.y * scene_.width() + list.x));
            if (part.examples.pixels().size() < most_examples) part.examples.add(list, value);
            return;
        }
        found.tied += mask != all_ties ? 1 : 0;
        part.everywhere &= mask;
        found.at_edges += way.at_edge ? 1 : 0;
        if (way.at_edge && part.examples.pixels().size() < most_examples) part.examples.add(list, value);
        const Stack& stack = maker.with(account_.rules, way.list, way.ties, way.is_moved);
        const Reach reach = compositor_.reach(stack);
        found.bits += Pricing{account_.hypothesis.result.storage}.of(reach) + (way.at_edge ? Pricing::of_edge : 0);
        if (!way.at_edge) measure(stack, reach, value, account_.hypothesis.result.storage, found);
        if (account_.rules.empty()) return;
        Stack own = stack;
        const Stack& right = maker.right(way.list, way.ties);
        own.near = right.near;  // the division of a peel is no change of the structure
        own.near_without_middle = right.near_without_middle;
        own.is_moved = false;
        if (own == right) return;
        ++found.changed;
        found.undecided += ties_that_hold(compositor_, {}, list, value, maker).mask != 0 ? 1 : 0;
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
    all.at_edges += part.at_edges;
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
    const TieMask rules = everywhere & (all_ties >> 1);
    all.has_one_tie_rule = rules != 0;
    if (rules != 0) all.ties = ties_number(static_cast<std::size_t>(std::countr_zero(rules)));
    return all;
}

std::optional<Checked> account_for(const Families& all, const std::vector<Rule>& rules, const SceneFragments& scene,
                                   const Colors& candidate, Sample& sample, const std::optional<Hypothesis>& likely) {
    constexpr int most_tries = 3;  // of one that another rasterizer has to help
    std::optional<Checked> best;
    for (int helped = 0; helped < most_tries;) {
        const auto hypothesis = best_of(all, rules, sample, Wrong::none, helped == 0 ? likely : std::nullopt);
        if (!hypothesis || (best && *hypothesis == best->account.hypothesis)) break;
        Sample examples{scene.setting()};
        Checked found = check_all(scene, candidate, {rules, *hypothesis}, examples);
        const bool is_done = found.is_whole() && found.at_edges == 0;
        if (found.is_whole()) {
            ++helped;
            if (!best || found.bits < best->bits) best = std::move(found);
        }
        if (is_done) break;
        for (const SampledPixel& pixel : examples.pixels()) sample.add(pixel.list, pixel.value);
    }
    return best;
}

}  // namespace strata::oracle::verdict
