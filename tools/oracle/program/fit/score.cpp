// tools/oracle/program/fit/score.cpp - costs, and what is left of a whole picture (score.h).
#include "tools/oracle/program/fit/score.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace strata::oracle::program {

Color residual(const Color& predicted, const ListPixel& pixel, double unit) noexcept {
    Color off{};
    for (std::size_t c = 0; c < 3; ++c) {
        const bool may_be_clamped = pixel.seen[c] == 0 || pixel.seen[c] == 1;
        const double p = may_be_clamped ? std::clamp(predicted[c], 0.0, 1.0) : predicted[c];
        off[c] = (p - pixel.seen[c]) / unit;
        if (pixel.fragments.empty()) off[c] -= std::clamp(off[c], -1.0, 1.0);
    }
    return off;
}

double bits_of(const Color& r) noexcept {
    const double product = (1 + r[0] * r[0]) * (1 + r[1] * r[1]) * (1 + r[2] * r[2]);
    // The exponent, and a parabola through 0, log2(1.5) and 1 for the mantissa.
    const auto bits = std::bit_cast<std::uint64_t>(product);
    const double m = std::bit_cast<double>((bits & 0xfffffffffffff) | 0x3ff0000000000000) - 1;
    const double log = static_cast<double>(static_cast<int>(bits >> 52) - 1023) + m * (1.33985 - 0.33985 * m);
    return std::nearbyint(log * 0x1p16) * 0x1p-16;
}

namespace {

// Of each rounding.
void find_residuals(const Program& program, const ListPixel& pixel, std::span<const PortRounding> roundings,
                    double unit, std::span<TiedResidual> found) {
    const EditedPixel& own = edited(program, pixel);
    for (std::size_t r = 0; r < roundings.size(); ++r) found[r] = {residual(own.color(roundings[r]), pixel, unit)};
    if (pixel.ties.empty()) return;
    ListPixel other{pixel.x,      pixel.y,          pixel.first,       {},        {},
                    pixel.behind, pixel.has_opaque, pixel.opaque_code, pixel.seen};
    for (std::size_t i = 0; i < pixel.ties.size(); ++i) {
        other.fragments = pixel.ties[i];
        const EditedPixel& tied = edited(program, other);
        for (std::size_t r = 0; r < roundings.size(); ++r) {
            const Color off = residual(tied.color(roundings[r]), pixel, unit);
            if (bits_of(off) < bits_of(found[r].off)) found[r] = {off, i >= tie_orders};
        }
    }
}

}  // namespace

TiedResidual residual_of(const Program& program, const ListPixel& pixel, const PortRounding& rounding, double unit) {
    TiedResidual best;
    find_residuals(program, pixel, {&rounding, 1}, unit, {&best, 1});
    return best;
}

double bound_at(const ListPixel& pixel) noexcept {
    const std::size_t layers = pixel.fragments.size();
    constexpr double hair = 1e-3;  // of the arithmetic
    return layers == 0 ? 1 : hair + std::min(5.0, static_cast<double>((layers + 1) / 2 + 1));
}

namespace {

// The covariance of residuals with a property of the pixels.
class Trend {
  public:
    void add(double x, const Color& r) noexcept {
        count_ += 1;
        x_ += x;
        xx_ += x * x;
        for (std::size_t c = 0; c < 3; ++c) {
            r_[c] += r[c];
            xr_[c] += x * r[c];
        }
    }
    // The largest of a channel, in codes per standard deviation.
    [[nodiscard]] double slope() const noexcept {
        const double mean = x_ / std::max(count_, 1.0), variance = xx_ / std::max(count_, 1.0) - mean * mean;
        if (count_ < 30 || variance < 1e-9) return 0;
        double most = 0;
        for (std::size_t c = 0; c < 3; ++c)
            most = std::max(most, std::fabs(xr_[c] - mean * r_[c]) / count_ / std::sqrt(variance));
        return most;
    }

  private:
    double count_ = 0, x_ = 0, xx_ = 0;
    Color r_{}, xr_{};
};

class Measure {
  public:
    explicit Measure(const PortRounding& rounding) { f_.rounding = rounding; }
    void add(const ListPixel& pixel, const TiedResidual& tied) {
        const Color& off = tied.off;
        f_.lost_at_ties += tied.loses ? 1 : 0;
        f_.bits += bits_of(off);
        f_.pixels += 1;
        const double most = std::max({std::fabs(off[0]), std::fabs(off[1]), std::fabs(off[2])});
        f_.worst = std::max(f_.worst, most);
        f_.beyond += most > bound_at(pixel) ? 1 : 0;
        f_.beyond_one += most > 1.01 ? 1 : 0;
        if (pixel.fragments.empty()) return;
        f_.covered += 1;
        Color limited{};
        double through = 1;
        for (std::size_t c = 0; c < 3; ++c) limited[c] = std::clamp(off[c], -6.0, 6.0);
        for (const ListFragment& f : pixel.fragments) through *= 1 - f.alpha;
        by_through_.add(through, limited);
        by_layers_.add(static_cast<double>(pixel.fragments.size()), limited);
        by_brightness_.add(pixel.seen[0] + pixel.seen[1] + pixel.seen[2], limited);
        for (std::size_t c = 0; c < 3; ++c) sum_[c] += limited[c];
    }
    [[nodiscard]] Fitness found() const {
        Fitness f = f_;
        f.slope = std::max({by_through_.slope(), by_layers_.slope(), by_brightness_.slope()});
        for (const double s : sum_)
            f.mean = std::max(f.mean, std::fabs(s) / static_cast<double>(std::max<std::uint64_t>(f.covered, 1)));
        return f;
    }

  private:
    Fitness f_{};
    Trend by_through_{}, by_layers_{}, by_brightness_{};
    Color sum_{};
};

std::vector<Fitness> measure_all(const Lists& lists, const Program& program, std::span<const PortRounding> roundings) {
    std::vector<Measure> all{roundings.begin(), roundings.end()};
    std::vector<TiedResidual> found(roundings.size());
    for (const ListPixel& pixel : lists.pixels) {
        find_residuals(program, pixel, roundings, lists.unit(), found);
        for (std::size_t r = 0; r < all.size(); ++r) all[r].add(pixel, found[r]);
    }
    std::vector<Fitness> made;
    for (const Measure& m : all) made.push_back(m.found());
    return made;
}

constexpr std::size_t some_pixels = 2048;

// The roundings under which some pixels cost least, least first.
std::vector<PortRounding> likely(const Lists& lists, const Program& program, std::size_t most) {
    const std::size_t step = lists.pixels.size() / some_pixels | 1;
    struct Likely {
        PortRounding rounding{};
        double bits = 0;
    };
    std::vector<PortRounding> all = roundings(lists.format);
    std::vector<Likely> sorted;
    for (const PortRounding& rounding : all) sorted.push_back({rounding});
    std::vector<TiedResidual> found(all.size());
    for (std::size_t i = 0; i < lists.pixels.size() && all.size() > most; i += step) {
        find_residuals(program, lists.pixels[i], all, lists.unit(), found);
        for (std::size_t r = 0; r < all.size(); ++r) sorted[r].bits += bits_of(found[r].off);
    }
    std::ranges::stable_sort(sorted, {}, &Likely::bits);
    all.clear();
    for (std::size_t i = 0; i < std::min(most, sorted.size()); ++i) all.push_back(sorted[i].rounding);
    return all;
}

}  // namespace

Fitness measure(const Lists& lists, const Program& program, const PortRounding& rounding) {
    return measure_all(lists, program, {&rounding, 1})[0];
}

PortRounding likely_rounding(const Lists& lists, const Program& program) { return likely(lists, program, 1)[0]; }

Fitness best_fitness(const Lists& lists, const Program& program) {
    const std::size_t finalists = lists.pixels.size() < 2 * some_pixels ? 1 : 2;
    const std::vector<Fitness> all = measure_all(lists, program, likely(lists, program, finalists));
    return std::ranges::min(all, {}, &Fitness::bits);
}

bool is_narrow(const Fitness& f) noexcept {
    const auto few = static_cast<std::uint64_t>(2e-4 * static_cast<double>(f.pixels));
    return f.beyond_one == 0 || (f.beyond <= few && f.mean < 0.5 && f.slope < 0.45);
}

}  // namespace strata::oracle::program
