// tools/oracle/program/screen/patterns.cpp - patterns of pixels: codes with a dither, and one layer a pixel (screen.h).
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>

#include "tools/oracle/program/screen/screen.h"

namespace strata::oracle::program {

namespace {

// For each place of a period its threshold: codes are floor(v + threshold). `codes`: of each channel.
std::optional<std::vector<double>> thresholds_of(const ScreenPictures& p, int period, const Color& codes) {
    const auto classes = static_cast<std::size_t>(period * period);
    std::vector<std::vector<double>> least(classes), most(classes);
    for (const ListPixel& pixel : p.lists.pixels) {
        const Color& predicted = p.at(pixel.x, pixel.y);
        const auto at = static_cast<std::size_t>(pixel.y % period * period + pixel.x % period);
        for (std::size_t c = 0; c < 3; ++c) {
            const double code = std::nearbyint(pixel.seen[c] * codes[c]), v = predicted[c] * codes[c];
            least[at].push_back(code - v);     // threshold is at least this
            most[at].push_back(code + 1 - v);  // and below this
        }
    }
    std::vector<double> found;
    for (std::size_t i = 0; i < classes; ++i) {
        if (least[i].size() < 12) return std::nullopt;
        std::ranges::sort(least[i]);
        std::ranges::sort(most[i]);
        const std::size_t few = least[i].size() / 100;  // roundings of blends move some
        const double low = least[i][least[i].size() - 1 - few], high = most[i][few];
        if (low > high + 0.25) return std::nullopt;
        found.push_back((low + high) / 2);
    }
    return found;
}

struct Dither {
    int period = 0;
    Color codes{};
    std::vector<double> thresholds{};
    std::size_t misses = 0;  // values that another code is seen for

    [[nodiscard]] double code_of(const ListPixel& pixel, double v, std::size_t c) const {
        return v * codes[c] + thresholds[static_cast<std::size_t>(pixel.y % period * period + pixel.x % period)];
    }
    void count_misses(const ScreenPictures& p) {
        for (const ListPixel& pixel : p.lists.pixels)
            for (std::size_t c = 0; c < 3; ++c)
                misses +=
                    std::floor(code_of(pixel, p.at(pixel.x, pixel.y)[c], c)) != std::nearbyint(pixel.seen[c] * codes[c])
                        ? 1
                        : 0;
    }
    // Near a threshold the roundings of blends decide.
    [[nodiscard]] std::vector<Color> mapped(const ScreenPictures& p) const {
        std::vector<Color> made;
        for (const ListPixel& pixel : p.lists.pixels) {
            Color& color = made.emplace_back(p.at(pixel.x, pixel.y));
            for (std::size_t c = 0; c < 3; ++c) {
                const double at = code_of(pixel, color[c], c), seen = std::nearbyint(pixel.seen[c] * codes[c]);
                const double code = std::floor(at);
                const bool is_near = std::fabs(at - std::max(seen, code)) < 2 * codes[c] * p.lists.unit();
                color[c] = (is_near ? seen : code) / codes[c];
            }
        }
        return made;
    }
};

bool are_codes(const std::set<double>& values, double codes, double unit) {
    return std::ranges::all_of(
        values, [&](double v) { return std::fabs(v * codes - std::nearbyint(v * codes)) < 0.6 * codes * unit; });
}

// The period with the fewest values that it does not give; a longer one must earn its thresholds.
void add_codes(const ScreenPictures& p, const Color& codes, const std::string& kept, ScreenProofs& proofs) {
    std::optional<Dither> best;
    for (const int period : {1, 2, 4, 8}) {
        auto thresholds = thresholds_of(p, period, codes);
        if (!thresholds) continue;
        Dither dither{period, codes, *std::move(thresholds)};
        dither.count_misses(p);
        if (!best || 2 * dither.misses + 10 * static_cast<std::size_t>(period * period) < best->misses)
            best = std::move(dither);
    }
    if (!best) return;
    const std::string words =
        best->period > 1
            ? fmt::format("the picture is rounded to {} with a dither of {} x {} pixels", kept, best->period,
                          best->period)
            : fmt::format("the picture is {} to {}", best->thresholds[0] < 0.25 ? "truncated" : "rounded", kept);
    proofs.add(words, best->period > 1 ? 12 : 6, best->mapped(p), std::vector<char>(p.predicted.size(), 1));
}

}  // namespace

void add_dithers(const ScreenPictures& p, ScreenProofs& proofs) {
    std::array<std::set<double>, 3> values;
    for (const ListPixel& pixel : p.lists.pixels)
        for (std::size_t c = 0; c < 3; ++c) values[c].insert(pixel.seen[c]);
    const bool is_8_bits = p.lists.format == PortFormat::unorm8;
    Color codes{}, masked{};
    std::array<int, 3> bits{}, kept{};
    for (std::size_t c = 0; c < 3; ++c) {
        for (int b = 7; b > 0; --b) {
            const double all = std::exp2(b) - 1, high = 255 / std::exp2(8 - b);
            // A code of fewer bits whose high bits are repeated may be one below the nearest.
            if (are_codes(values[c], all, (b < 7 ? 1.7 : 1) * p.lists.unit())) {
                codes[c] = all;
                bits[c] = b;
            }
            if (is_8_bits && are_codes(values[c], high, 1e-4)) {
                masked[c] = high;
                kept[c] = b;
            }
        }
    }
    const auto words = [](const std::array<int, 3>& b) {
        return b[0] == b[1] && b[1] == b[2] ? fmt::format("{} bits", b[0])
                                            : fmt::format("{}, {} and {} bits", b[0], b[1], b[2]);
    };
    if (std::ranges::count(bits, 0) == 0)
        add_codes(p, codes, words(bits), proofs);
    else if (std::ranges::count(kept, 0) == 0)
        add_codes(p, masked, words(kept) + ", the low ones are 0", proofs);
}

namespace {

// The layer that a pixel shows: its rank; the number of layers if it shows what is behind; none if several could be,
// -1 if nothing is.
struct ShownLayer {
    int rank = -1;
    bool is_certain = false;
};

ShownLayer shown_layer(const ListPixel& pixel, double unit) {
    ShownLayer shown;
    int matches = 0;
    const auto is_seen = [&](const Color& color) {
        return std::ranges::equal(color, pixel.seen, [&](double a, double b) { return std::fabs(a - b) < 1.6 * unit; });
    };
    const auto count = static_cast<int>(pixel.fragments.size());
    for (int k = 0; k <= count; ++k)
        if (is_seen(k < count ? pixel.fragments[static_cast<std::size_t>(k)].color : pixel.behind)) {
            if (matches++ == 0) shown.rank = k;
        }
    shown.is_certain = matches == 1;
    return shown;
}

// True if one threshold for each place of the period says which layer is shown: the first whose alpha is beyond it.
bool is_by_pattern(const Lists& lists, const std::vector<ShownLayer>& shown, int period) {
    struct Range {
        double low = 0, high = 1;
        std::size_t count = 0;
    };
    std::vector<Range> ranges(static_cast<std::size_t>(period * period));
    for (std::size_t i = 0; i < lists.pixels.size(); ++i) {
        if (!shown[i].is_certain) continue;
        const ListPixel& pixel = lists.pixels[i];
        Range& range = ranges[static_cast<std::size_t>(pixel.y % period * period + pixel.x % period)];
        ++range.count;
        const auto rank = static_cast<std::size_t>(shown[i].rank);
        for (std::size_t k = 0; k < rank; ++k) range.low = std::max(range.low, pixel.fragments[k].alpha);
        if (rank < pixel.fragments.size()) range.high = std::min(range.high, pixel.fragments[rank].alpha);
    }
    return std::ranges::all_of(ranges, [](const Range& r) { return r.count > 1 && r.low <= r.high + 1e-9; });
}

}  // namespace

void add_chosen_layers(const ScreenPictures& p, std::vector<ScreenMap>& found) {
    std::vector<ShownLayer> shown;
    std::size_t covered = 0, none = 0, behind = 0;
    for (const ListPixel& pixel : p.lists.pixels) {
        ShownLayer& layer = shown.emplace_back();
        if (pixel.fragments.empty()) continue;
        layer = shown_layer(pixel, p.lists.unit());
        ++covered;
        none += layer.rank < 0 ? 1 : 0;
        behind += layer.is_certain && layer.rank > 0 ? 1 : 0;
    }
    if (covered < 50 || none > std::max<std::size_t>(2, covered / 500) || 20 * behind < covered) return;
    std::string words = "every pixel shows one layer or what is behind: fragments are kept or dropped, not blended";
    int known = 0;
    for (int period = 2; period <= 16; ++period)
        if (known == 0 && is_by_pattern(p.lists, shown, period)) known = period;
    words += known > 0
                 ? fmt::format(", by a pattern that repeats every {} x {} pixels and serves all layers", known, known)
                 : ", by no pattern of at most 16 x 16 pixels";
    found.push_back({.words = std::move(words), .price = 8, .bits = 0, .beyond = none});
}

}  // namespace strata::oracle::program
