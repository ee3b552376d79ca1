// tools/oracle/program/screen/shifts.cpp - a picture, or some of its pixels, shows other pixels: shifts and blocks
// (screen.h).
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>

#include "tools/oracle/program/fit/fitting.h"
#include "tools/oracle/program/fit/solve.h"
#include "tools/oracle/program/screen/screen.h"

namespace strata::oracle::program {

namespace {

// Which pixel a pixel shows, and what it costs at every pixel.
struct Shift {
    int x = 0, y = 0;
    std::vector<double> cost{};
    [[nodiscard]] std::string words() const {
        const auto side = [](int by, std::string_view positive, std::string_view negative) {
            return fmt::format("{} {} {}", std::abs(by), std::abs(by) == 1 ? "pixel" : "pixels",
                               by > 0 ? positive : negative);
        };
        std::string all;
        if (x != 0) all = "the one " + side(x, "to the right", "to the left");
        if (y != 0) all += (all.empty() ? "the one " : " and ") + side(y, "below", "above");
        return all;
    }
};

class ShiftSearch {
  public:
    ShiftSearch(const ScreenPictures& pictures, ScreenProofs& proofs) : pictures_{pictures}, proofs_{proofs} {}

    void run() {
        right_ = cost_of(0, 0);
        std::vector<Tried> tried;
        find_masks();
        for (int y = -reach; y <= reach; ++y)
            for (int x = -reach; x <= reach; ++x)
                if (x != 0 || y != 0) try_masks(cost_of(x, y), tried);
        std::ranges::stable_sort(tried, {}, &Tried::cost);
        constexpr std::size_t most_proved = 5;
        for (std::size_t i = 0; i < std::min(tried.size(), most_proved); ++i) prove(tried[i]);
    }

  private:
    static constexpr int reach = 4;
    struct PixelMask {
        std::vector<Condition> conditions{};
        std::vector<char> mask{};
        double price = 0;
    };
    struct Tried {
        int x = 0, y = 0;
        const PixelMask* mask = nullptr;
        double cost = 0;
    };

    [[nodiscard]] std::size_t index(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(pictures_.width) + static_cast<std::size_t>(x);
    }
    // Of pixels that would show one outside of the picture: nothing.
    [[nodiscard]] Shift cost_of(int dx, int dy) const {
        Shift shift{dx, dy, {}};
        for (int y = 0; y < pictures_.height; ++y)
            for (int x = 0; x < pictures_.width; ++x)
                shift.cost.push_back(pictures_.has(x + dx, y + dy) ? cost_of(pictures_.at(x + dx, y + dy), index(x, y))
                                                                   : 0);
        return shift;
    }
    [[nodiscard]] double cost_of(const Color& color, std::size_t i) const {
        return program::cost_of(color, pictures_.lists.pixels[i], pictures_.lists.unit());
    }

    // Every condition on the place of a pixel.
    void find_masks() {
        std::vector<PixelMask> all{{{}, std::vector<char>(pictures_.predicted.size(), 1), 0}};
        for (const FragmentProperty& property : properties()) {
            if (!property.is_of_pixel || (property.name[0] != 'x' && property.name[0] != 'y' &&
                                          property.name.find("columns") == property.name.npos &&
                                          property.name.find("rows") == property.name.npos &&
                                          property.name.find("checkerboard") == property.name.npos))
                continue;
            std::vector<double> values;
            for (const ListPixel& pixel : pictures_.lists.pixels) values.push_back(property.of(pixel, 0));
            for (const Condition& condition : conditions_of(property, values)) {
                PixelMask& made = all.emplace_back(PixelMask{{condition}, {}, property.price});
                for (const double v : values) made.mask.push_back(condition.holds(v) ? 1 : 0);
            }
        }
        masks_ = std::move(all);
    }

    void try_masks(const Shift& shift, std::vector<Tried>& tried) const {
        for (const PixelMask& mask : masks_) {
            double cost = 0;
            for (std::size_t i = 0; i < mask.mask.size(); ++i)
                cost += mask.mask[i] != 0 ? shift.cost[i] : right_.cost[i];
            if (cost < 0.6 * pictures_.right.bits) tried.push_back({shift.x, shift.y, &mask, cost + mask.price});
        }
    }

    void prove(const Tried& tried) {
        std::vector<Color> mapped = pictures_.predicted;
        std::vector<char> has_value(mapped.size(), 1);
        for (int y = 0; y < pictures_.height; ++y)
            for (int x = 0; x < pictures_.width; ++x) {
                const std::size_t i = index(x, y);
                if (tried.mask->mask[i] == 0) continue;
                const bool has = pictures_.has(x + tried.x, y + tried.y);
                has_value[i] = has ? 1 : 0;
                if (has) mapped[i] = pictures_.at(x + tried.x, y + tried.y);
            }
        const std::string where = tried.mask->conditions.empty()
                                      ? "every pixel"
                                      : fmt::format("pixels {}", joined_words(tried.mask->conditions));
        proofs_.add(fmt::format("{} {} {}", where, tried.mask->conditions.empty() ? "shows" : "show",
                                Shift{tried.x, tried.y, {}}.words()),
                    3 + tried.mask->price, mapped, has_value);
    }

    const ScreenPictures& pictures_;
    ScreenProofs& proofs_;
    Shift right_{};
    std::vector<PixelMask> masks_{};
};

// Blocks of some pixels that show one of them, or their mean.
void add_block(const ScreenPictures& p, int wide, int high, ScreenProofs& proofs) {
    const auto mapped_by = [&](auto of_block) {
        std::vector<Color> mapped;
        for (int y = 0; y < p.height; ++y)
            for (int x = 0; x < p.width; ++x) mapped.push_back(of_block(x / wide * wide, y / high * high));
        return mapped;
    };
    const std::vector<char> everywhere(p.predicted.size(), 1);
    const auto clamped = [&](int x, int y) { return p.at(std::min(x, p.width - 1), std::min(y, p.height - 1)); };
    const std::string size = fmt::format("{} x {} pixels", wide, high);
    for (const auto& [x, y] : {std::array{0, 0}, std::array{wide - 1, high - 1}, std::array{wide / 2, high / 2}})
        proofs.add(fmt::format("blocks of {} show the {} of them: a picture of fewer pixels is enlarged", size,
                               x == 0          ? "upper left"
                               : x == wide - 1 ? "lower right"
                                               : "middle"),
                   8, mapped_by([&, x = x, y = y](int bx, int by) { return clamped(bx + x, by + y); }), everywhere);
    proofs.add(fmt::format("blocks of {} show their mean: a picture of more pixels is reduced, then enlarged", size), 8,
               mapped_by([&](int bx, int by) {
                   Color sum{};
                   for (int y = 0; y < high; ++y)
                       for (int x = 0; x < wide; ++x)
                           for (std::size_t c = 0; c < 3; ++c) sum[c] += clamped(bx + x, by + y)[c] / (wide * high);
                   return sum;
               }),
               everywhere);
}

}  // namespace

void add_shifts(const ScreenPictures& pictures, ScreenProofs& proofs) { ShiftSearch{pictures, proofs}.run(); }

namespace {

void add_pairs(const ScreenPictures& p, int across, int down, std::string words, ScreenProofs& proofs) {
    std::vector<Color> mapped;
    for (int y = 0; y < p.height; ++y)
        for (int x = 0; x < p.width; ++x)
            mapped.push_back(p.at(std::min(x ^ across, p.width - 1), std::min(y ^ down, p.height - 1)));
    proofs.add(std::move(words), 8, mapped, std::vector<char>(mapped.size(), 1));
}

// What is read at address y * width + x of rows that are `pitch` pixels apart.
void add_pitch(const ScreenPictures& p, int pitch, ScreenProofs& proofs) {
    std::vector<Color> mapped;
    std::vector<char> has_value;
    for (int address = 0; address < p.width * p.height; ++address) {
        const int x = address % pitch, y = address / pitch;
        has_value.push_back(p.has(x, y) ? 1 : 0);
        mapped.push_back(p.has(x, y) ? p.at(x, y) : Color{});
    }
    proofs.add(fmt::format("rows are {} pixels apart in memory and are read as if {}", pitch, p.width), 8, mapped,
               has_value);
}

void add_transposed(const ScreenPictures& p, int size, ScreenProofs& proofs) {
    std::vector<Color> mapped;
    std::vector<char> has_value;
    for (int y = 0; y < p.height; ++y)
        for (int x = 0; x < p.width; ++x) {
            const int from_x = x / size * size + y % size, from_y = y / size * size + x % size;
            has_value.push_back(p.has(from_x, from_y) ? 1 : 0);
            mapped.push_back(p.has(from_x, from_y) ? p.at(from_x, from_y) : Color{});
        }
    proofs.add(fmt::format("tiles of {0} x {0} pixels are transposed: x and y within a tile are exchanged", size), 8,
               mapped, has_value);
}

}  // namespace

void add_addresses(const ScreenPictures& pictures, ScreenProofs& proofs) {
    std::set<int> pitches;
    for (const int by : {-4, -3, -2, -1, 1, 2, 3, 4}) pitches.insert(pictures.width + by);
    for (const int whole : {16, 32, 64, 128, 256}) pitches.insert((pictures.width + whole - 1) / whole * whole);
    pitches.erase(pictures.width);
    for (const int pitch : pitches)
        if (pitch > 0) add_pitch(pictures, pitch, proofs);
    for (const int size : {2, 4, 8, 16, 32}) add_transposed(pictures, size, proofs);
}

void add_blocks(const ScreenPictures& pictures, ScreenProofs& proofs) {
    add_pairs(pictures, 1, 0, "columns are exchanged in pairs", proofs);
    add_pairs(pictures, 0, 1, "rows are exchanged in pairs", proofs);
    for (const auto& [wide, high] :
         {std::array{2, 2}, std::array{2, 1}, std::array{1, 2}, std::array{3, 3}, std::array{4, 4}, std::array{8, 8}})
        add_block(pictures, wide, high, proofs);
}

}  // namespace strata::oracle::program
