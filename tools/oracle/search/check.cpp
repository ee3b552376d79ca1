// tools/oracle/search/check.cpp - checks an account (account.h) against every pixel of a picture.
#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <mutex>

#include "scenes/numbers/srgb_encode.h"
#include "tools/oracle/rounding/doubt.h"
#include "tools/oracle/rounding/pricing.h"
#include "tools/oracle/search/match.h"

namespace strata::oracle::verdict {

namespace {

double exact_over(const Layer& layer, std::size_t c, double behind) noexcept {
    const double alpha = layer.color[3], color = layer.color[c];
    return (layer.is_premultiplied ? color : alpha * color) + (1 - alpha) * behind;
}

// Exact OVER in binary64, encoded if the picture is.
std::array<double, 3> exact(const Stack& stack) noexcept {
    std::array<double, 3> color{stack.background[0], stack.background[1], stack.background[2]};
    for (std::size_t i = stack.layers.size(); i-- > 0;)
        for (std::size_t c = 0; c < 3; ++c) color[c] = exact_over(stack.layers[i], c, color[c]);
    if (stack.is_linear || stack.finish == Finish::encoded)
        for (double& v : color) v = double{scenes::encode_srgb(static_cast<float>(v))};
    return color;
}

double levels_of(Storage storage) noexcept {
    return storage == Storage::unorm10 ? 1023 : storage == Storage::unorm16 ? 65535 : 255;
}

// Updates the largest distance of a pixel from the exact result, and the largest that its interval allows.
void measure(const Stack& stack, const ReachableColor& reach, const std::array<double, 4>& value, Storage storage,
             CheckedAccount& found) {
    const std::array<double, 3> truth = exact(stack);
    const double levels = levels_of(storage);
    double needed = 0;
    const auto as_code = [&](double v) {
        return has_codes(storage) ? std::floor(std::clamp(v, 0.0, 1.0) * levels + 0.5) : v * levels;
    };
    for (std::size_t c = 0; c < 3; ++c) {
        const double wanted = as_code(truth[c]);
        found.observed = std::max(found.observed, std::fabs(as_code(value[c]) - wanted));
        found.possible = std::max(
            {found.possible, std::fabs(as_code(reach[c].low) - wanted), std::fabs(as_code(reach[c].high) - wanted)});
        // An interval that ends at 0 or 1 may be cut there.
        if (reach[c].low > 0 && reach[c].high < 1)
            needed = std::max(needed, std::fabs(value[c] - (reach[c].low + reach[c].high) / 2) * 255);
    }
    found.needed = std::max(found.needed, needed);
    found.needing_many += needed > most_codes(stack.layers.size()) + 0.5 ? 1 : 0;
}

// Limit per tile of the wrong pixels and pixels at edges that are returned as examples, from which the next hypothesis
// is chosen.
constexpr std::size_t most_examples = 64;

// The rules for ties that keep all fragments of one depth.
constexpr TieMask of_rule(TieHandling rule) {
    const TieMask bit = TieMask{1} << static_cast<unsigned>(rule);
    return bit | bit << tie_rule_count;
}
constexpr TieMask keeping_ties = of_rule(TieHandling::first) | of_rule(TieHandling::last) |
                                 of_rule(TieHandling::first_then_last) | TieMask{1} << ties_count;

// A pixel without fragments whose background has the candidate's value, and its bits.
struct BlankPixel {
    Rgba behind{};
    std::array<double, 4> value{};
    double bits = 0;
};

bool is_blank(const PixelList& list) noexcept {
    return list.visible.empty() && list.hidden.empty() && list.edge == nullptr && list.behind_spread == 0;
}

// The result for one tile.
struct PartChecked {
    CheckedAccount checked{};
    TieMask everywhere = all_ties;
    Sample examples;
    std::optional<BlankPixel> blank{};  // the last that was found right: most have the same value
};

class Checker {
  public:
    Checker(const SceneFragments& scene, const Colors& candidate, const Account& account, WrongPixels allowed)
        : scene_{scene},
          candidate_{candidate},
          account_{account},
          compositor_{account.hypothesis},
          most_wrong_{allowed == WrongPixels::some ? std::numeric_limits<std::size_t>::max() : enough_wrong} {}

    [[nodiscard]] PartChecked part(const TileLists& tile) const {
        StackMaker maker{scene_.setting()};
        PartChecked part{.examples = Sample{scene_.setting()}};
        for (std::size_t p = 0; p < tile.rect.area() && part.checked.wrong_pixels.size() < most_wrong_; ++p)
            look_at(scene_.at(tile, p), maker, part);
        return part;
    }

  private:
    static constexpr std::size_t enough_wrong = 16;  // wrong pixels of a tile that suffice to reject the account

    void look_at(const PixelList& list, StackMaker& maker, PartChecked& part) const {
        const auto value = candidate_.at(list.x, list.y);
        CheckedAccount& found = part.checked;
        ++found.pixels;
        found.covered += list.visible.empty() ? 0 : 1;
        const bool may_be_known = account_.rules.empty() && is_blank(list);
        if (may_be_known && part.blank && part.blank->value == value && part.blank->behind == list.behind) {
            found.bits += part.blank->bits;
            return;
        }
        const MatchingTies way = matching_ties(compositor_, account_.rules, list, value, maker);
        found.edges += list.edge != nullptr || (way.mask != 0 && way.at_edge) ? 1 : 0;
        const TieMask mask = way.mask;
        if (mask == 0) {
            found.wrong_pixels.push_back(static_cast<std::uint32_t>(list.y * scene_.width() + list.x));
            if (part.examples.pixels().size() < most_examples) part.examples.add(list, value);
            return;
        }
        found.tied += mask != all_ties ? 1 : 0;
        part.everywhere &= mask;
        found.at_edges += way.at_edge && !way.has_close_depths ? 1 : 0;
        found.at_close_depths += way.has_close_depths ? 1 : 0;
        found.lost_at_ties += !way.at_edge && (mask & keeping_ties) == 0 ? 1 : 0;
        if (way.at_edge && part.examples.pixels().size() < most_examples) part.examples.add(list, value);
        const Stack& stack = maker.with(account_.rules, way.list, way.ties, way.is_moved);
        const ReachableColor reach = compositor_.reach(stack);
        maker.steps().composite(stack.layers.size());
        const double bits =
            Pricing{account_.hypothesis.result.storage}.of(reach) + (way.at_edge ? Pricing::of_edge : 0);
        found.bits += bits;
        if (may_be_known && !way.at_edge) part.blank = {list.behind, value, bits};
        if (!way.at_edge) measure(stack, reach, value, account_.hypothesis.result.storage, found);
        if (account_.rules.empty()) return;
        Stack own = stack;
        const Stack& right = maker.right(way.list, way.ties);
        // The position of a peel's division is not part of the structure. A rule may have left fewer layers than the
        // right structure has in its near half.
        own.near = std::min(right.near, own.layers.size());
        own.near_without_middle = std::min(right.near_without_middle, own.layers.size());
        own.is_moved = false;
        if (own == right || (own.mixing != right.mixing && compositor_.reach(own) == compositor_.reach(right))) return;
        ++found.changed;
        found.undecided += matching_ties(compositor_, {}, list, value, maker).mask != 0 ? 1 : 0;
    }

    const SceneFragments& scene_;
    const Colors& candidate_;
    const Account& account_;
    Compositor compositor_;
    std::size_t most_wrong_;
};

void merge(const CheckedAccount& part, CheckedAccount& all) {
    all.pixels += part.pixels;
    all.covered += part.covered;
    all.tied += part.tied;
    all.at_edges += part.at_edges;
    all.at_close_depths += part.at_close_depths;
    all.lost_at_ties += part.lost_at_ties;
    all.needing_many += part.needing_many;
    all.edges += part.edges;
    all.needed = std::max(all.needed, part.needed);
    all.changed += part.changed;
    all.undecided += part.undecided;
    all.bits += part.bits;
    all.observed = std::max(all.observed, part.observed);
    all.possible = std::max(all.possible, part.possible);
    all.wrong_pixels.insert(all.wrong_pixels.end(), part.wrong_pixels.begin(), part.wrong_pixels.end());
}

}  // namespace

CheckedAccount check_all(const SceneFragments& scene, const Colors& candidate, const Account& account,
                         WrongPixels allowed, Sample& examples) {
    const Checker checker{scene, candidate, account, allowed};
    CheckedAccount all{.account = account};
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

std::optional<CheckedAccount> account_for(const Families& all, const std::vector<Rule>& rules,
                                          const SceneFragments& scene, const Colors& candidate, Sample& sample,
                                          const std::optional<Hypothesis>& likely, int most_rejected) {
    constexpr int most_tries = 3;  // of accounts that need pixels at edges
    constexpr std::size_t most_added = 200;
    std::optional<CheckedAccount> best;
    int rejected = 0;
    for (int helped = 0; helped < most_tries && rejected < most_rejected;) {
        const auto hypothesis = best_of(all, rules, sample, WrongPixels::none, helped == 0 ? likely : std::nullopt);
        if (!hypothesis || (best && *hypothesis == best->account.hypothesis)) break;
        Sample examples{scene.setting()};
        CheckedAccount found = check_all(scene, candidate, {rules, *hypothesis}, WrongPixels::none, examples);
        const bool is_done = found.is_whole() && found.rasterized_otherwise() == 0;
        if (found.is_whole()) {
            ++helped;
            if (!best || found.bits < best->bits) best = std::move(found);
        } else {
            ++rejected;
        }
        if (is_done) break;
        const Sample some = examples.thinned(most_added);
        for (const SampledPixel& pixel : some.pixels()) sample.add(pixel.list, pixel.value);
    }
    return best;
}

}  // namespace strata::oracle::verdict
