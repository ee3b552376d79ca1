// tools/oracle/program/screen/screen.h - is a picture the right one in another place: moved, enlarged, blurred, or with
// a pattern of pixels?
//
// Rule     What the right program predicts is mapped: by a shift, also of some rows, columns or parts; by blocks of
//          pixels that show one of them or their mean; by another pitch of rows, or tiles that are transposed; by nine
//          weights of a pixel's neighbours, fitted by least squares and rounded to parts of 16 or 9; by fewer codes
//          with a dither of a period. A map explains a picture as a program does (prove.h). A picture whose pixels each
//          show one layer, or what is behind, is told as that, with the period of the pattern.
// Tests    tests/tools/oracle/program/screen_test.cpp
#pragma once
#include <string>
#include <vector>

#include "tools/oracle/program/fit/score.h"

namespace strata::oracle::program {

struct ScreenMap {
    std::string words{};
    double price = 0, bits = 0;
    std::uint64_t beyond = 0;
    [[nodiscard]] double cost() const noexcept { return bits + price; }
};

// Those that explain the whole picture, best first. `lists` have all pixels of the picture, row by row.
[[nodiscard]] std::vector<ScreenMap> explain_by_screen(const Lists& lists, const Fitness& right);

// The picture that is predicted and the one that is seen, row by row.
struct ScreenPictures {
    const Lists& lists;
    const Fitness& right;
    std::vector<Color> predicted{};  // before it is rounded
    int width = 0, height = 0;
    [[nodiscard]] const Color& at(int x, int y) const noexcept {
        return predicted[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)];
    }
    [[nodiscard]] bool has(int x, int y) const noexcept { return x >= 0 && y >= 0 && x < width && y < height; }
};

// Measures a map, and keeps it if it explains the picture. `has_value`: the map says something about the pixel.
class ScreenProofs {
  public:
    explicit ScreenProofs(const ScreenPictures& pictures) : pictures_{pictures} {}
    void add(std::string words, double price, const std::vector<Color>& mapped, const std::vector<char>& has_value);
    [[nodiscard]] std::vector<ScreenMap> best() &&;

  private:
    const ScreenPictures& pictures_;
    std::vector<ScreenMap> found_{};
};

void add_shifts(const ScreenPictures& pictures, ScreenProofs& proofs);
void add_blocks(const ScreenPictures& pictures, ScreenProofs& proofs);
void add_addresses(const ScreenPictures& pictures, ScreenProofs& proofs);
void add_weights(const ScreenPictures& pictures, ScreenProofs& proofs);
void add_dithers(const ScreenPictures& pictures, ScreenProofs& proofs);
void add_chosen_layers(const ScreenPictures& pictures, std::vector<ScreenMap>& found);

}  // namespace strata::oracle::program
