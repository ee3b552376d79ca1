#include "tools/oracle/compare/heat_scale.h"

#include <algorithm>
#include <bit>
#include <string>

#include "tools/oracle/compare/small_text.h"

namespace strata::oracle {

namespace {

// Inferno at 2/8, 3/8 ... 8/8.
constexpr std::array<std::array<std::uint8_t, 3>, 7> inferno{{{0x56, 0x10, 0x6e},
                                                              {0x89, 0x22, 0x6a},
                                                              {0xbb, 0x37, 0x54},
                                                              {0xe3, 0x59, 0x32},
                                                              {0xf9, 0x8c, 0x0a},
                                                              {0xf9, 0xc9, 0x32},
                                                              {0xfc, 0xff, 0xa4}}};

// log2 of at least 1, in fixed point with 16 fractional bits, linear between powers of two, with an error of at most
// 0.09.
constexpr std::uint64_t log2_of(std::uint32_t value) noexcept {
    const int whole = std::bit_width(value) - 1;
    const std::uint64_t rest = value - (std::uint64_t{1} << whole);
    return (static_cast<std::uint64_t>(whole) << 16) + ((rest << 16) >> whole);
}

// The colour at share / 2^16 of the table.
std::array<std::uint8_t, 3> between_stops(std::uint64_t share) noexcept {
    const std::uint64_t at = share * (inferno.size() - 1);
    const std::size_t stop = std::min<std::size_t>(at >> 16, inferno.size() - 2);
    const auto rest = static_cast<std::int64_t>(at - (std::uint64_t{stop} << 16));
    std::array<std::uint8_t, 3> rgb{};
    for (std::size_t c = 0; c < 3; ++c) {
        const std::int64_t from = inferno[stop][c], to = inferno[stop + 1][c];
        rgb[c] = static_cast<std::uint8_t>(from + (((to - from) * rest + 0x8000) >> 16));
    }
    return rgb;
}

void put(pipeline::Image& image, int x, int y, const std::array<std::uint8_t, 3>& rgb) {
    for (std::size_t c = 0; c < 3; ++c) image.codes[image.index(x, y, static_cast<int>(c))] = rgb[c];
    image.codes[image.index(x, y, 3)] = 255;
}

}  // namespace

HeatScale::HeatScale(std::uint32_t greatest) noexcept
    : end_{greatest <= 255 ? 255 : ~std::uint32_t{0} >> std::countl_zero(greatest)} {}

std::array<std::uint8_t, 3> HeatScale::color(std::uint32_t distance) const noexcept {
    if (distance == 0) return {0, 0, 0};
    return between_stops((log2_of(std::min(distance, end_)) << 16) / log2_of(end_));
}

double HeatScale::position(std::uint32_t distance) const noexcept {
    return static_cast<double>(log2_of(std::clamp(distance, 1u, end_))) / static_cast<double>(log2_of(end_));
}

std::vector<std::uint32_t> HeatScale::marks() const {
    const int bits = static_cast<int>(std::bit_width(end_));
    const int step = bits > 16 ? (bits + 1) / 2 : (bits + 3) / 4;  // long labels leave room for fewer of them
    std::vector<std::uint32_t> marks;
    for (int bit = 0; bit + step / 2 < bits; bit += step) marks.push_back(std::uint32_t{1} << bit);
    marks.push_back(end_);
    return marks;
}

std::span<const std::array<std::uint8_t, 3>> HeatScale::stops() noexcept { return inferno; }

void draw_legend(pipeline::Image& image, int left, int top, int width, const HeatScale& scale) {
    constexpr int gap_px = 3, bar_px = 8, letters = 2;
    width = std::max(width, least_legend_width_px);
    for (int x = left; x < std::min(left + width, image.width); ++x) {
        const std::uint64_t share =
            (static_cast<std::uint64_t>(x - left) << 16) / static_cast<std::uint64_t>(width - 1);
        for (int y = 0; y < bar_px; ++y) put(image, x, top + gap_px + y, between_stops(share));
    }
    const auto wide = [](const std::string& text) { return letters * letter_width_px * static_cast<int>(text.size()); };
    const auto write = [&](int x, const std::string& text) {
        draw_text(image, x, top + gap_px + bar_px + gap_px, text, letters);
    };
    // Only the end's label has the unit "codes"; the others are drawn if there is room.
    const std::string last = std::to_string(scale.end()) + " codes";
    const int last_x = std::max(left, left + width - wide(last));
    write(last_x, last);
    int free = left;
    for (const std::uint32_t distance : scale.marks()) {
        const std::string text = std::to_string(distance);
        const int at = left + static_cast<int>(scale.position(distance) * (width - 1));
        const int x = std::max(at - wide(text) / 2, left);
        if (x < free || x + wide(text) + letter_width_px > last_x) continue;
        write(x, text);
        free = x + wide(text) + letter_width_px;
    }
}

}  // namespace strata::oracle
