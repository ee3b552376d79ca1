// tools/oracle/program/screen/weights.cpp - a pixel as a weighted sum of its neighbours (screen.h).
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "tools/oracle/program/fit/search.h"
#include "tools/oracle/program/screen/screen.h"

namespace strata::oracle::program {

namespace {

using NineWeights = std::array<double, 9>;

// Of the pixel's neighbours row by row; those outside of the picture are the nearest ones inside.
Color weighed(const ScreenPictures& p, int x, int y, const NineWeights& weights) {
    Color sum{};
    for (int i = 0; i < 9; ++i) {
        const Color& color =
            p.at(std::clamp(x + i % 3 - 1, 0, p.width - 1), std::clamp(y + i / 3 - 1, 0, p.height - 1));
        for (std::size_t c = 0; c < 3; ++c) sum[c] += weights[static_cast<std::size_t>(i)] * color[c];
    }
    return sum;
}

// By least squares over pixels whose neighbours differ.
NineWeights fitted_weights(const ScreenPictures& p) {
    std::vector<std::vector<double>> a(9, std::vector<double>(9, 0));
    std::vector<double> b(9, 0);
    for (int y = 1; y + 1 < p.height; ++y)
        for (int x = 1; x + 1 < p.width; ++x) {
            const auto at = static_cast<std::size_t>(y * p.width + x);
            for (std::size_t c = 0; c < 3; ++c) {
                std::array<double, 9> row{};
                for (int i = 0; i < 9; ++i) row[static_cast<std::size_t>(i)] = p.at(x + i % 3 - 1, y + i / 3 - 1)[c];
                for (std::size_t i = 0; i < 9; ++i) {
                    b[i] += row[i] * p.lists.pixels[at].seen[c];
                    for (std::size_t j = 0; j < 9; ++j) a[i][j] += row[i] * row[j];
                }
            }
        }
    for (std::size_t i = 0; i < 9; ++i) a[i][i] += 1e-9 * (a[i][i] + 1);
    const std::vector<double> found = solved(std::move(a), std::move(b));
    NineWeights weights{};
    std::ranges::copy(found, weights.begin());
    return weights;
}

struct KnownWeights {
    NineWeights parts;
    std::string_view words;
};
const KnownWeights known_weights[] = {
    {{1, 1, 1, 1, 1, 1, 1, 1, 1}, "every pixel is the mean of 3 x 3 pixels: a blur"},
    {{1, 2, 1, 2, 4, 2, 1, 2, 1}, "every pixel is the mean of 3 x 3 pixels with weights 1, 2, 1: a blur"},
    {{0, 1, 0, 1, 4, 1, 0, 1, 0}, "every pixel is mixed with its four neighbours: a blur"},
    {{0, 1, 0, 1, 1, 1, 0, 1, 0}, "every pixel is the mean of itself and its four neighbours: a blur"},
    {{1, 1, 0, 1, 1, 0, 0, 0, 0}, "every pixel is the mean of 2 x 2 pixels up and left: half a texel off, filtered"},
    {{0, 1, 1, 0, 1, 1, 0, 0, 0}, "every pixel is the mean of 2 x 2 pixels up and right: half a texel off, filtered"},
    {{0, 0, 0, 1, 1, 0, 1, 1, 0}, "every pixel is the mean of 2 x 2 pixels down and left: half a texel off, filtered"},
    {{0, 0, 0, 0, 1, 1, 0, 1, 1}, "every pixel is the mean of 2 x 2 pixels down and right: half a texel off, filtered"},
    {{0, 0, 0, 1, 1, 0, 0, 0, 0}, "every pixel is the mean of itself and the one to the left"},
    {{0, 0, 0, 0, 1, 1, 0, 0, 0}, "every pixel is the mean of itself and the one to the right"},
    {{0, 1, 0, 0, 1, 0, 0, 0, 0}, "every pixel is the mean of itself and the one above"},
    {{0, 0, 0, 0, 1, 0, 0, 1, 0}, "every pixel is the mean of itself and the one below"},
    {{0, -1, 0, -1, 5, -1, 0, -1, 0}, "every pixel is sharpened by its four neighbours"},
};

void add_weight(const ScreenPictures& p, const NineWeights& weights, std::string words, double price,
                ScreenProofs& proofs) {
    std::vector<Color> mapped;
    for (int y = 0; y < p.height; ++y)
        for (int x = 0; x < p.width; ++x) mapped.push_back(weighed(p, x, y, weights));
    std::vector<char> has_value(mapped.size(), 1);
    // Ports differ in what lies outside of the picture.
    for (int y = 0; y < p.height; ++y)
        for (int x = 0; x < p.width; ++x)
            if (x == 0 || y == 0 || x + 1 == p.width || y + 1 == p.height)
                has_value[static_cast<std::size_t>(y * p.width + x)] = 0;
    proofs.add(std::move(words), price, mapped, has_value);
}

std::string list_of(const NineWeights& weights) {
    std::string all;
    for (std::size_t i = 0; i < 9; ++i)
        all += fmt::format("{}{:.3g}", i == 0 ? "" : i % 3 == 0 ? "; " : ", ", weights[i] + 0.0);
    return all;
}

}  // namespace

void add_weights(const ScreenPictures& p, ScreenProofs& proofs) {
    const NineWeights fitted = fitted_weights(p);
    bool is_known = false;
    for (const KnownWeights& known : known_weights) {
        NineWeights weights = known.parts;
        double sum = 0;
        for (const double part : weights) sum += part;
        for (double& w : weights) w /= sum;
        double most = 0;
        for (std::size_t i = 0; i < 9; ++i) most = std::max(most, std::fabs(weights[i] - fitted[i]));
        if (most > 0.05) continue;
        is_known = true;
        add_weight(p, weights, std::string{known.words}, 8, proofs);
    }
    if (is_known) return;
    NineWeights rounded = fitted;
    for (double& w : rounded) w = std::nearbyint(w * 100) / 100;
    const double others = std::accumulate(rounded.begin(), rounded.end(), 0.0) - rounded[4];
    if (std::fabs(others) < 0.02) return;  // no neighbours: nothing that this says
    add_weight(p, rounded,
               fmt::format("every pixel is the sum of its neighbours, row by row, times {}", list_of(rounded)), 60,
               proofs);
}

}  // namespace strata::oracle::program
