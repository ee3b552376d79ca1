// tools/oracle/program/screen/screen.cpp - the order of the maps, and their proof (screen.h).
#include "tools/oracle/program/screen/screen.h"

#include <algorithm>
#include <cmath>

namespace strata::oracle::program {

void ScreenProofs::add(std::string words, double price, const std::vector<Color>& mapped,
                       const std::vector<char>& has_value) {
    const Lists& lists = pictures_.lists;
    ScreenMap map{.words = std::move(words), .price = price};
    std::uint64_t asked = 0;
    for (std::size_t i = 0; i < mapped.size(); ++i) {
        if (has_value[i] == 0) continue;
        ++asked;
        const Color off = residual(mapped[i], lists.pixels[i], lists.unit());
        map.bits += bits_of(off);
        const double most = std::max({std::fabs(off[0]), std::fabs(off[1]), std::fabs(off[2])});
        map.beyond += most > bound_at(lists.pixels[i]) ? 1 : 0;
    }
    const Fitness& right = pictures_.right;
    const double covered = static_cast<double>(std::max<std::uint64_t>(right.covered, 1));
    const bool is_whole = static_cast<double>(map.beyond) <= std::max(2.0, 0.002 * covered) &&
                          map.bits < 1.5 * covered && map.cost() < 0.6 * right.bits &&
                          10 * asked >= 8 * static_cast<std::uint64_t>(mapped.size());
    if (is_whole) found_.push_back(std::move(map));
}

std::vector<ScreenMap> ScreenProofs::best() && {
    if (found_.empty()) return {};
    const double least = std::ranges::min(found_, {}, &ScreenMap::cost).cost();
    std::erase_if(found_, [&](const ScreenMap& m) { return m.cost() > 1.15 * least + 20; });
    std::ranges::stable_sort(found_, {}, &ScreenMap::price);
    constexpr std::size_t most_told = 3;
    if (found_.size() > most_told) found_.resize(most_told);
    return std::move(found_);
}

std::vector<ScreenMap> explain_by_screen(const Lists& lists, const Fitness& right) {
    const auto pixels = static_cast<std::size_t>(lists.width) * static_cast<std::size_t>(lists.height);
    if (lists.pixels.size() != pixels || right.covered < 20) return {};
    std::vector<const ListPixel*> sorted(pixels);
    ScreenPictures pictures{.lists = lists, .right = right, .width = lists.width, .height = lists.height};
    const bool is_by_rows = lists.pixels[0].y == 0;
    for (std::size_t i = 0; i < pixels; ++i) {
        const ListPixel& pixel = lists.pixels[i];
        // Frames whose rows are stored from the bottom are not mapped.
        if (!is_by_rows || pixel.y * lists.width + pixel.x != static_cast<int>(i)) return {};
        pictures.predicted.push_back(value({}, pixel, {}));
    }
    ScreenProofs proofs{pictures};
    add_shifts(pictures, proofs);
    add_blocks(pictures, proofs);
    add_addresses(pictures, proofs);
    add_weights(pictures, proofs);
    add_dithers(pictures, proofs);
    std::vector<ScreenMap> found = std::move(proofs).best();
    if (found.empty()) add_chosen_layers(pictures, found);
    return found;
}

}  // namespace strata::oracle::program
