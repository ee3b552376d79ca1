// tools/oracle/rounding/doubt.cpp - decides whether differences within a hypothesis' rounding have a direction, or
// follow layers, alpha or transmittance: reasons to doubt (doubt.h).
#include "tools/oracle/rounding/doubt.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <set>
#include <string_view>
#include <vector>

#include "tools/oracle/search/match.h"

namespace strata::oracle::verdict {

namespace {

// What the differences of a right picture do not depend on: rounding does not know it.
enum class Property : std::uint8_t { transmittance, layers, alpha, color };
constexpr std::size_t property_count = 4;

std::string_view words_of(Property property) noexcept {
    constexpr std::array<std::string_view, property_count> words{
        "the transmittance", "the number of layers", "the alpha of the layers", "the colours of the layers"};
    return words[static_cast<std::size_t>(property)];
}

// A channel of a pixel: its distance from the middle of the allowed values, in codes of 255, and its properties.
struct Residual {
    double distance = 0;
    std::array<double, property_count> properties{};
};

struct Fit {
    double mean = 0, slope = 0, error = 0;  // slope: per standard deviation of the property
};

Fit fit_of(const std::vector<Residual>& all, Property property) {
    const auto n = static_cast<double>(all.size());
    const auto of = [&](const Residual& r) { return r.properties[static_cast<std::size_t>(property)]; };
    double sum = 0, sum_x = 0;
    for (const Residual& r : all) sum += r.distance, sum_x += of(r);
    Fit fit{.mean = sum / n};
    const double mean_x = sum_x / n;
    double xx = 0, xr = 0, rr = 0;
    for (const Residual& r : all) {
        const double x = of(r) - mean_x, d = r.distance - fit.mean;
        xx += x * x, xr += x * d, rr += d * d;
    }
    fit.error = std::sqrt(rr / n / n);
    if (xx > 1e-12) fit.slope = xr / std::sqrt(xx * n);
    return fit;
}

// The properties of a channel under exact OVER: alpha is the change of the result if every alpha grows by its own part,
// color the same of colours.
std::array<double, property_count> properties_of(const Stack& stack, std::size_t c) {
    double transmittance = 1, value = stack.background[c], by_alpha = 0;
    for (std::size_t i = stack.layers.size(); i-- > 0;) {
        const Layer& layer = stack.layers[i];
        const double alpha = layer.color[3];
        const double own = layer.is_premultiplied ? double{layer.color[c]} : alpha * layer.color[c];
        by_alpha = own - alpha * value + (1 - alpha) * by_alpha;
        value = own + (1 - alpha) * value;
        transmittance *= 1 - alpha;
    }
    return {transmittance, static_cast<double>(stack.layers.size()), by_alpha,
            value - transmittance * double{stack.background[c]}};
}

struct Residuals {
    std::array<std::vector<Residual>, 3> channels{};  // of pixels with equal layers and values only one
    double most = 0;
    std::uint64_t pixels = 0, beyond = 0;  // beyond: those that need more codes than their layers ask for
};

// A sampled pixel with the structure that the account found there.
struct Structured {
    Stack stack{};
    std::array<double, 4> value{};
};

std::vector<Structured> structures(const SceneFragments& scene, const Colors& candidate,
                                   const CheckedAccount& checked) {
    constexpr std::size_t most_sampled = 16384;
    const Compositor compositor{checked.account.hypothesis};
    const std::vector<Rule>& rules = checked.account.rules;
    StackMaker maker{scene.setting()};
    std::vector<Structured> all;
    const Sample sample = sampled(scene, candidate, most_sampled);
    for (const SampledPixel& pixel : sample.pixels()) {
        const MatchingTies way = matching_ties(compositor, rules, pixel.list, pixel.value, maker);
        if (way.mask == 0 || way.at_edge) continue;
        const Stack& stack = maker.with(rules, way.list, way.ties);
        if (!stack.layers.empty()) all.push_back({stack, pixel.value});
    }
    return all;
}

// Calls act(channel, distance) for the channels whose values are not cut at 0 or 1.
void for_each_distance(const Compositor& compositor, const Structured& pixel, auto act) {
    const ReachableColor reach = compositor.reach(pixel.stack);
    for (std::size_t c = 0; c < 3; ++c)
        if (reach[c].low > 0 && reach[c].high < 1) act(c, (pixel.value[c] - (reach[c].low + reach[c].high) / 2) * 255);
}

// The definite hypothesis whose values are nearest to the picture's.
Hypothesis nearest(const Families& definite, const std::vector<Structured>& all) {
    constexpr std::size_t most_looked_at = 200;
    const std::size_t step = all.size() / most_looked_at + 1;
    double least = std::numeric_limits<double>::max();
    Hypothesis best;
    for (const HypothesisFamily& family : definite)
        for (const Hypothesis& h : family.members) {
            if (h.slack > 0) continue;
            const Compositor compositor{h};
            double bits = 0;
            for (std::size_t i = 0; i < all.size() && bits < least; i += step)
                for_each_distance(compositor, all[i], [&](std::size_t, double d) { bits += std::log2(1 + d * d); });
            if (bits >= least) continue;
            least = bits;
            best = h;
        }
    return best;
}

Residuals residuals(const Hypothesis& hypothesis, const std::vector<Structured>& all) {
    const Compositor compositor{hypothesis};
    Residuals found{.pixels = all.size()};
    std::set<std::array<double, 6>> known;
    for (const Structured& pixel : all) {
        double most = 0;
        std::array<double, 6> key{};
        std::array<std::optional<Residual>, 3> own;
        for_each_distance(compositor, pixel, [&](std::size_t c, double distance) {
            most = std::max(most, std::fabs(distance));
            own[c] = {distance, properties_of(pixel.stack, c)};
            key[c] = distance, key[c + 3] = pixel.value[c];
        });
        found.most = std::max(found.most, most);
        found.beyond += most > most_codes(pixel.stack.layers.size()) + 0.5 ? 1 : 0;
        if (!known.insert(key).second) continue;
        for (std::size_t c = 0; c < 3; ++c)
            if (own[c]) found.channels[c].push_back(*own[c]);
    }
    return found;
}

std::string codes(double n) { return fmt::format("{:.0f} code{} allowed", n, n < 1.5 ? "" : "s"); }

std::string more_than_right(double needed) {
    return fmt::format("{}, where a right port needs at most {:.0f}", codes(needed), most_codes_of_right);
}

// Channels of different pixels that a direction is asked of.
constexpr std::size_t fewest = 64;

// Whether the differences of a channel have a direction, which rounding has not; "" if not.
std::string direction_of(const std::vector<Residual>& channel, std::string_view name, double most_mean) {
    constexpr double most_slope = 0.45;
    if (channel.size() < fewest) return "";
    const auto exceeds = [](double value, double limit, double error) { return std::fabs(value) > limit + 3 * error; };
    const Fit any = fit_of(channel, Property::transmittance);  // the mean and its error are those of every property
    if (exceeds(any.mean, most_mean, any.error))
        return fmt::format("{} is off by {:+.1f} codes on average, and rounding has no direction", name, any.mean);
    for (const Property property : {Property::transmittance, Property::layers, Property::alpha, Property::color}) {
        const Fit fit = fit_of(channel, property);
        if (exceeds(fit.slope, most_slope, fit.error))
            return fmt::format("the differences of {} change with {}", name, words_of(property));
    }
    return "";
}

}  // namespace

std::string doubt_of(const SceneFragments& scene, const Colors& candidate, const CheckedAccount& checked,
                     const Families& definite) {
    constexpr double most = most_codes_of_right, narrow = 1.5;
    const bool is_of_codes = has_codes(checked.account.hypothesis.result.storage);
    // Off by 4 codes where more than 5 are possible: without many different pixels that is no evidence of rounding.
    const bool is_wide = is_of_codes && checked.observed > most - 1.5 && checked.possible > most + 0.5;
    if (checked.needed <= narrow && !is_wide) return "";
    if (is_of_codes && checked.observed > most + 0.5) return more_than_right(checked.observed);
    const std::vector<Structured> all = structures(scene, candidate, checked);
    const Hypothesis hypothesis = nearest(definite, all);
    const Residuals found = residuals(hypothesis, all);
    if (is_wide && std::ranges::all_of(found.channels, [](const auto& c) { return c.size() < fewest; }))
        return fmt::format("{}, at {} different pixels, which are too few to tell rounding from a mistake",
                           codes(checked.observed),
                           std::ranges::max(found.channels, {}, [](const auto& c) { return c.size(); }).size());
    if (checked.needed <= narrow) return "";
    const std::uint64_t spared = 1 + found.pixels / 5000;
    if (found.beyond > spared && found.most > most + 0.5) return more_than_right(found.most);
    if (found.beyond > spared)
        return fmt::format("{}, more than the layers of {} pixels need", codes(found.most), found.beyond);
    const bool has_front_codes = has_front(hypothesis.order) && has_codes(hypothesis.front.storage);
    constexpr const char* names[] = {"red", "green", "blue"};
    for (std::size_t c = 0; c < 3; ++c)
        if (const std::string direction = direction_of(found.channels[c], names[c], has_front_codes ? 1 : 0.5);
            !direction.empty())
            return fmt::format("{}, but {}", codes(found.most), direction);
    return "";
}

}  // namespace strata::oracle::verdict
