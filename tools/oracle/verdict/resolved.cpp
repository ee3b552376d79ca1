// tools/oracle/verdict/resolved.cpp - is a resolved multisampled picture, at every pixel, the mean of right samples
// under one hypothesis of rounding (resolved.h)?
#include "tools/oracle/verdict/resolved.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <mutex>
#include <nlohmann/json.hpp>

#include "scenes/numbers/srgb_encode.h"
#include "tools/oracle/rounding/composite.h"
#include "tools/oracle/rules/structure.h"

namespace strata::oracle::verdict {

namespace {

// The fragments of a pixel's samples.
struct ResolvedPixel {
    std::vector<PixelList> lists{};
    std::array<double, 4> value{};  // the candidate's
    std::uint32_t number = 0;       // row-major
    std::size_t fragments = 0;
};

bool has_same_fragments(const PixelList& a, const PixelList& b) {
    return std::ranges::equal(a.visible, b.visible, {}, &Fragment::primitive, &Fragment::primitive) &&
           a.has_opaque == b.has_opaque;
}

bool is_at_edge(const ResolvedPixel& pixel) {
    return !std::ranges::all_of(pixel.lists,
                                [&](const PixelList& list) { return has_same_fragments(list, pixel.lists[0]); });
}

bool holds(const rasterizer::Rect& rect, int x, int y) {
    return x >= rect.x0 && x < rect.x1 && y >= rect.y0 && y < rect.y1;
}

// All pixels; those that are not within have no lists, and are not compared.
std::vector<ResolvedPixel> pixels_of(const Samples& samples, const Colors& candidate,
                                     const std::optional<rasterizer::Rect>& within) {
    const auto width = static_cast<std::size_t>(candidate.width());
    std::vector<ResolvedPixel> pixels(width * static_cast<std::size_t>(candidate.height()));
    for (const auto& sample : samples) {
        std::mutex mutex;
        sample->for_each_tile([&](const TileLists& tile) {
            const std::scoped_lock lock{mutex};
            for (std::size_t p = 0; p < tile.rect.area(); ++p) {
                const PixelList list = sample->at(tile, p);
                if (within && !holds(*within, list.x, list.y)) continue;
                ResolvedPixel& pixel =
                    pixels[static_cast<std::size_t>(list.y) * width + static_cast<std::size_t>(list.x)];
                pixel.fragments += list.visible.size();
                pixel.lists.push_back(list);
            }
        });
    }
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        pixels[i].number = static_cast<std::uint32_t>(i);
        pixels[i].value = candidate.at(static_cast<int>(i % width), static_cast<int>(i / width));
    }
    return pixels;
}

double unit_of(Storage storage) {
    switch (storage) {
        case Storage::unorm8: return 1.0 / 255;
        case Storage::unorm10: return 1.0 / 1023;
        case Storage::unorm16: return 1.0 / 65535;
        case Storage::half: return 0x1p-11;
        case Storage::single: break;
    }
    return 0x1p-22;
}

// A hypothesis about the samples, and the picture's storage.
class SampleMean {
  public:
    SampleMean(const Hypothesis& hypothesis, const Colors& candidate)
        : compositor_{hypothesis},
          unit_{unit_of(storage_of(candidate.code()))},
          codes_{candidate.use().is_divided ? 1 : 0.5},
          is_float_{!has_codes(storage_of(candidate.code()))},
          is_encoded_{candidate.use().is_encoded} {}

    // The mean of the samples, before the resolve stores it.
    [[nodiscard]] std::array<Interval, 3> mean(const std::vector<Stack>& samples) const {
        std::array<Interval, 3> sum{};
        for (const Stack& stack : samples) {
            const ReachableColor reach = compositor_.reach(stack);
            const double more = through_by_excess(stack);
            for (std::size_t c = 0; c < 3; ++c) sum[c] = sum[c] + (more > 0 ? reach[c].widened(more) : reach[c]);
        }
        const auto share = Interval::of(1 / static_cast<double>(samples.size()));  // exact: a power of two
        for (Interval& channel : sum) channel = channel * share;
        return sum;
    }
    [[nodiscard]] bool holds(const std::array<Interval, 3>& mean, const std::array<double, 4>& value) const {
        for (std::size_t c = 0; c < 3; ++c)
            if (!in_file(mean[c]).holds(value[c])) return false;
        return true;
    }
    // The values of a colour that the file may hold: of a linear frame the resolve's, encoded and rounded again.
    [[nodiscard]] Interval in_file(const Interval& mean) const {
        const Interval kept = stored(mean);
        if (!is_encoded_) return kept;
        constexpr double error = 0x1p-20;  // of encode_srgb
        const auto encoded = [](double v) { return double{scenes::encode_srgb(static_cast<float>(v))}; };
        return stored({encoded(kept.low) - error, encoded(kept.high) + error});
    }
    // The values that the resolve may store.
    [[nodiscard]] Interval stored(const Interval& mean) const {
        return mean.widened(is_float_ ? unit_ * std::max(mean.magnitude(), 0x1p-14) : unit_ * (codes_ + 0x1p-12));
    }
    [[nodiscard]] double width(const std::array<Interval, 3>& mean) const {
        double widest = 0;
        for (const Interval& channel : mean) widest = std::max(widest, channel.high - channel.low);
        return widest / unit_;
    }

  private:
    // The compositor clamps alpha to 1; floats do not. A layer of alpha 1 + e adds e (its colour - what is behind it).
    [[nodiscard]] double through_by_excess(const Stack& stack) const {
        const Hypothesis& h = compositor_.hypothesis();
        if (has_codes(h.front.storage) && has_codes(h.back.storage)) return 0;
        double excess = 0, greatest = 1;
        const auto add = [&greatest](const Rgba& color) {
            for (std::size_t c = 0; c < 4; ++c) greatest = std::max(greatest, std::fabs(double{color[c]}));
        };
        add(stack.background);
        for (const Layer& layer : stack.layers) {
            excess += std::max(0.0, double{layer.color[3]} - 1);
            add(layer.color);
        }
        return 2 * excess * greatest * (1 + excess);
    }

    Compositor compositor_;
    double unit_;
    double codes_;  // the error of a stored code: half of one, and another half if it was divided by alpha
    bool is_float_;
    bool is_encoded_;
};

// The number of wrong pixels among the given ones, and the sum of their intervals' widths; or more than the best cost.
struct ResolveCost {
    std::size_t wrong = 0;
    double width = 0;
    friend bool operator<(const ResolveCost& a, const ResolveCost& b) noexcept {
        return a.wrong != b.wrong ? a.wrong < b.wrong : a.width < b.width;
    }
};
ResolveCost cost_of(const SampleMean& resolve, const std::vector<std::vector<Stack>>& stacks,
                    const std::vector<const ResolvedPixel*>& pixels, const ResolveCost& best) {
    ResolveCost cost;
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        const auto mean = resolve.mean(stacks[i]);
        cost.wrong += resolve.holds(mean, pixels[i]->value) ? 0 : 1;
        cost.width += std::log2(1 + resolve.width(mean));
        if (best < cost) break;
    }
    return cost;
}

std::vector<Stack> stacks_of(const ResolvedPixel& pixel, const Ties& ties, StackMaker& maker) {
    std::vector<Stack> stacks;
    for (const PixelList& list : pixel.lists) stacks.push_back(maker.right(list, ties));
    return stacks;
}

// Of the pixels with the most fragments.
std::vector<const ResolvedPixel*> deepest(const std::vector<ResolvedPixel>& pixels, std::size_t most) {
    std::vector<const ResolvedPixel*> deep;
    for (const ResolvedPixel& pixel : pixels)
        if (!pixel.lists.empty()) deep.push_back(&pixel);
    std::ranges::stable_sort(deep, std::ranges::greater{}, &ResolvedPixel::fragments);
    deep.resize(std::min(most, deep.size()));
    return deep;
}

std::vector<Hypothesis> hypotheses(Storage picture) {
    std::vector<Hypothesis> all;
    std::vector<Storage> storages{picture};  // of the samples
    for (const Storage floats : {Storage::half, Storage::single})
        if (floats != picture) storages.push_back(floats);
    for (const Storage storage : storages)
        for (const HypothesisFamily& family : families(storage, {0, 0x1p-20}, Looseness::definite))
            // One device blends both ends. A program that multiplies in front leaves one product to round there.
            std::ranges::copy_if(family.members, std::back_inserter(all), [](const Hypothesis& h) {
                return h.front.storage == h.back.storage &&
                       (h.front.rounding == h.back.rounding || h.front.rounding == Rounding::nearest);
            });
    return all;
}

std::string first_line(const ResolvedVerdict& v) {
    if (!v.equal_to.empty())
        return fmt::format("right: equal to the picture of {} at all {} pixels", v.equal_to, v.pixels);
    if (v.is_right())
        return fmt::format(
            "right: the mean of the samples at all {} pixels, {} of them at edges; intervals of at most "
            "{:.2g} codes",
            v.pixels, v.at_edges, v.possible);
    if (v.wrong_pixels.empty())
        return fmt::format(
            "wrong: alpha is not the mean of the samples' alphas at {} of {} pixels; "
            "the colours are right",
            v.alpha.wrong_pixels.size(), v.pixels);
    return fmt::format("wrong: {} of {} pixels are not the mean of right samples{}", v.wrong_pixels.size(), v.pixels,
                       v.wrong_at_edges == v.wrong_pixels.size()
                           ? ", edges only: the samples of each have different fragments"
                           : fmt::format("; {} of them at edges", v.wrong_at_edges));
}

}  // namespace

namespace {

// What is said about the samples.
struct SamplesAccount {
    Hypothesis hypothesis{};
    Ties ties{};
    std::size_t wrong = 0;  // of the pixels by which it was chosen
};

// Empty if every hypothesis has more wrong pixels than `most_wrong`.
std::optional<SamplesAccount> closest(const std::vector<Hypothesis>& all, const Colors& candidate,
                                      const std::vector<const ResolvedPixel*>& pixels, StackMaker& maker,
                                      std::size_t most_wrong) {
    std::optional<SamplesAccount> account;
    ResolveCost best{.wrong = most_wrong + 1};
    std::vector<std::vector<Stack>> previous;
    for (std::size_t n = 0; n < ties_count; ++n) {
        std::vector<std::vector<Stack>> stacks;
        for (const ResolvedPixel* pixel : pixels) stacks.push_back(stacks_of(*pixel, ties_number(n), maker));
        if (stacks == previous) continue;  // no fragments have equal depths
        for (const Hypothesis& h : all) {
            const ResolveCost cost = cost_of(SampleMean{h, candidate}, stacks, pixels, best);
            if (cost < best) best = cost, account = SamplesAccount{h, ties_number(n), cost.wrong};
        }
        previous = std::move(stacks);
    }
    return account;
}

ResolvedVerdict checked(const SamplesAccount& account, const Colors& candidate,
                        const std::vector<ResolvedPixel>& pixels, StackMaker& maker) {
    ResolvedVerdict verdict{.hypothesis = account.hypothesis, .width = candidate.width(), .pixels = pixels.size()};
    const SampleMean resolve{account.hypothesis, candidate};
    for (const ResolvedPixel& pixel : pixels) {
        if (pixel.lists.empty()) continue;
        const bool at_edge = is_at_edge(pixel);
        verdict.at_edges += at_edge ? 1 : 0;
        const auto mean = resolve.mean(stacks_of(pixel, account.ties, maker));
        verdict.possible = std::max(verdict.possible, resolve.width(mean));
        if (resolve.holds(mean, pixel.value)) continue;
        verdict.wrong_pixels.push_back(pixel.number);
        verdict.wrong_at_edges += at_edge ? 1 : 0;
    }
    return verdict;
}

AlphaChecked checked_alpha(const SamplesAccount& account, const Colors& candidate,
                           const std::vector<ResolvedPixel>& pixels, StackMaker& maker, const Setting& setting) {
    AlphaChecked found{.background = setting.cleared[3], .is_told = setting.cleared[3] < 1};
    if (!candidate.has_alpha()) return found;
    const AlphaReach reach{account.hypothesis};
    const SampleMean resolve{account.hypothesis, candidate};
    const int width = candidate.width();
    for (const ResolvedPixel& pixel : pixels) {
        if (pixel.lists.empty()) continue;
        Interval sum{};
        for (const Stack& stack : stacks_of(pixel, account.ties, maker)) sum = sum + reach.of(stack);
        const Interval mean = sum * Interval::of(1 / static_cast<double>(pixel.lists.size()));
        const int number = static_cast<int>(pixel.number);
        if (!resolve.stored(mean).holds(candidate.alpha_at(number % width, number / width)))
            found.wrong_pixels.push_back(pixel.number);
    }
    found.state = found.wrong_pixels.empty()    ? AlphaState::right
                  : is_everywhere(candidate, 1) ? AlphaState::opaque
                                                : AlphaState::wrong;
    if (found.state == AlphaState::wrong)
        found.is_told = true;
    else
        found.wrong_pixels.clear();
    return found;
}

}  // namespace

namespace {

// The hypothesis is chosen by some of the pixels, then again with some of those that it does not explain. Empty if
// every one has more than `most_wrong` wrong pixels of the first.
std::optional<ResolvedVerdict> judged(const Samples& samples, const Colors& candidate,
                                      const std::vector<std::uint32_t>& first, std::size_t most_wrong,
                                      const std::optional<rasterizer::Rect>& within = {}) {
    constexpr std::size_t few = 64, few_added = 32;
    const std::vector<ResolvedPixel> pixels = pixels_of(samples, candidate, within);
    const std::vector<Hypothesis> all = hypotheses(storage_of(candidate.code()));
    std::vector<const ResolvedPixel*> some;
    const auto add_some = [&](const std::vector<std::uint32_t>& numbers) {
        const std::size_t step = numbers.size() / few_added + 1;
        for (std::size_t k = 0; k < numbers.size(); k += step)
            if (const ResolvedPixel& pixel = pixels[numbers[k]]; !pixel.lists.empty()) some.push_back(&pixel);
    };
    add_some(first);  // they reject a hypothesis sooner than others
    std::ranges::copy(deepest(pixels, few), std::back_inserter(some));
    StackMaker maker{samples[0]->setting()};
    std::optional<SamplesAccount> account = closest(all, candidate, some, maker, std::min(most_wrong, some.size()));
    if (!account) return std::nullopt;
    ResolvedVerdict best = checked(*account, candidate, pixels, maker), last = best;
    // Every step excludes a hypothesis at least. If none explains these pixels, none explains the picture.
    while (account->wrong == 0 && !best.is_right()) {
        add_some(last.wrong_pixels);
        account = closest(all, candidate, some, maker, some.size());
        last = checked(*account, candidate, pixels, maker);
        if (last.wrong_pixels.size() < best.wrong_pixels.size()) best = last;
    }
    if (best.is_right()) best.alpha = checked_alpha(*account, candidate, pixels, maker, samples[0]->setting());
    return best;
}

}  // namespace

ResolvedVerdict judge_resolved(const Samples& samples, const Colors& candidate) {
    return *judged(samples, candidate, {}, std::numeric_limits<std::size_t>::max());
}

std::optional<ResolvedVerdict> right_resolved(const Samples& samples, const Colors& candidate,
                                              const std::vector<std::uint32_t>& doubtful,
                                              const std::optional<rasterizer::Rect>& within) {
    auto verdict = judged(samples, candidate, doubtful, 0, within);
    if (verdict && !verdict->is_right()) verdict.reset();
    return verdict;
}

const std::vector<std::uint32_t>& wrong_pixels(const ResolvedVerdict& v) {
    return v.wrong_pixels.empty() ? v.alpha.wrong_pixels : v.wrong_pixels;
}

namespace {

// At most some of the wrong pixels.
std::vector<std::array<std::uint32_t, 2>> first_wrong(const ResolvedVerdict& v, std::size_t most) {
    const std::vector<std::uint32_t>& wrong = oracle::verdict::wrong_pixels(v);
    const auto columns = static_cast<std::uint32_t>(v.width);
    std::vector<std::array<std::uint32_t, 2>> first;
    for (std::size_t i = 0; i < std::min(most, wrong.size()); ++i)
        first.push_back({wrong[i] % columns, wrong[i] / columns});
    return first;
}

}  // namespace

std::string to_text(const ResolvedVerdict& v) {
    std::string text = first_line(v) + '\n';
    if (v.equal_to.empty()) {
        text += fmt::format("  {}{}\n", v.wrong_pixels.empty() ? "" : "closest: ", describe(v.hypothesis));
        if (v.is_right() && v.alpha.is_told) text += fmt::format("  {}\n", describe(v.alpha));
        for (const auto& [x, y] : first_wrong(v, 1)) text += fmt::format("  the first wrong pixel is {},{}\n", x, y);
    }
    return text + v.form.description() + v.description;
}

nlohmann::ordered_json json_of(const ResolvedVerdict& v) {
    nlohmann::ordered_json document{{"verdict", v.is_right() ? "right" : "wrong"},
                                    {"sentence", first_line(v)},
                                    {"pixels", v.pixels},
                                    {"at_edges", v.at_edges},
                                    {"wrong", v.wrong_pixels.size()},
                                    {"wrong_at_edges", v.wrong_at_edges},
                                    {"hypothesis", describe(v.hypothesis)},
                                    {"possible", v.possible},
                                    {"alpha", name(v.alpha.state)},
                                    {"wrong_alpha", v.alpha.wrong_pixels.size()},
                                    {"first_wrong", first_wrong(v, 16)}};
    if (v.form.is_chosen) document["colors"] = v.form.use.is_divided ? "straight" : "premultiplied";
    document["rules"] = v.by;
    return document;
}

}  // namespace strata::oracle::verdict
