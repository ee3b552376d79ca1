#include "tools/oracle/verdict/doubt.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <set>
#include <vector>

#include "tools/oracle/verdict/match.h"

namespace strata::oracle::verdict {

namespace {

// A channel of a pixel: its distance from the middle of the allowed values, in codes of 255, and what it may depend on.
struct Residual {
    double distance = 0, through = 1, layers = 0;
};

struct Fit {
    double mean = 0, mean_error = 0, slope = 0, slope_error = 0;  // slope: per standard deviation of the property
};

Fit fit_of(const std::vector<Residual>& all, double Residual::*property) {
    const auto n = static_cast<double>(all.size());
    double sum = 0, sum_x = 0;
    for (const Residual& r : all) sum += r.distance, sum_x += r.*property;
    Fit fit{.mean = sum / n};
    const double mean_x = sum_x / n;
    double xx = 0, xr = 0, rr = 0;
    for (const Residual& r : all) {
        const double x = r.*property - mean_x, d = r.distance - fit.mean;
        xx += x * x, xr += x * d, rr += d * d;
    }
    fit.mean_error = std::sqrt(rr / n / n);
    fit.slope_error = fit.mean_error;
    if (xx > 1e-12) fit.slope = xr / std::sqrt(xx * n);
    return fit;
}

struct Residuals {
    std::array<std::vector<Residual>, 3> channels{};  // of pixels with equal layers and values only one
    double most = 0;
    std::uint64_t pixels = 0, beyond = 0;  // beyond: those that need more codes than their layers ask for
};

// A sampled pixel with the structure that the right account found there.
struct Structured {
    Stack stack{};
    std::array<double, 4> value{};
};

std::vector<Structured> structures(const SceneFragments& scene, const Colors& candidate, const CheckedAccount& right) {
    constexpr std::size_t most_sampled = 16384;
    const Compositor compositor{right.account.hypothesis};
    StackMaker maker{scene.setting()};
    std::vector<Structured> all;
    const Sample sample = sampled(scene, candidate, most_sampled);
    for (const SampledPixel& pixel : sample.pixels()) {
        const MatchingTies way = matching_ties(compositor, {}, pixel.list, pixel.value, maker);
        if (way.mask == 0 || way.at_edge) continue;
        const Stack& stack = maker.with({}, way.list, way.ties);
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
        const auto layers = static_cast<double>(pixel.stack.layers.size());
        double through = 1, most = 0;
        for (const Layer& layer : pixel.stack.layers) through *= 1 - layer.color[3];
        std::array<double, 6> key{};
        std::array<std::optional<Residual>, 3> own;
        for_each_distance(compositor, pixel, [&](std::size_t c, double distance) {
            most = std::max(most, std::fabs(distance));
            own[c] = {distance, through, layers};
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

}  // namespace

std::string doubt_of(const SceneFragments& scene, const Colors& candidate, const CheckedAccount& right,
                     const Families& definite) {
    constexpr double most = most_codes_of_right, narrow = 1.5, most_slope = 0.45;
    constexpr std::size_t fewest = 64;
    if (right.needed <= narrow) return "";
    if (has_codes(right.account.hypothesis.result.storage) && right.observed > most + 0.5)
        return fmt::format("{}, where a right port needs at most {:.0f}", codes(right.observed), most);
    const std::vector<Structured> all = structures(scene, candidate, right);
    const Hypothesis hypothesis = nearest(definite, all);
    const Residuals found = residuals(hypothesis, all);
    const std::uint64_t spared = 1 + found.pixels / 5000;
    if (found.beyond > spared && found.most > most + 0.5)
        return fmt::format("{}, where a right port needs at most {:.0f}", codes(found.most), most);
    if (found.beyond > spared)
        return fmt::format("{}, more than the layers of {} pixels need", codes(found.most), found.beyond);
    const bool has_front_codes = has_front(hypothesis.order) && has_codes(hypothesis.front.storage);
    const double most_mean = has_front_codes ? 1 : 0.5;
    constexpr const char* names[] = {"red", "green", "blue"};
    for (std::size_t c = 0; c < 3; ++c) {
        const std::vector<Residual>& channel = found.channels[c];
        if (channel.size() < fewest) continue;
        const auto exceeds = [](double value, double limit, double error) {
            return std::fabs(value) > limit + 3 * error;
        };
        const Fit by_through = fit_of(channel, &Residual::through), by_layers = fit_of(channel, &Residual::layers);
        if (exceeds(by_through.mean, most_mean, by_through.mean_error))
            return fmt::format("{}, and rounding has no direction, but {} is off by {:+.1f} codes on average",
                               codes(found.most), names[c], by_through.mean);
        if (exceeds(by_through.slope, most_slope, by_through.slope_error))
            return fmt::format("{}, but the differences of {} follow what the layers let through", codes(found.most),
                               names[c]);
        if (exceeds(by_layers.slope, most_slope, by_layers.slope_error))
            return fmt::format("{}, but the differences of {} follow the number of layers", codes(found.most),
                               names[c]);
    }
    return "";
}

}  // namespace strata::oracle::verdict
