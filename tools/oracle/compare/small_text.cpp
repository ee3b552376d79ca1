// tools/oracle/compare/small_text.cpp - each letter is 15 bits: five rows of three pixels, the top left one highest.
#include "tools/oracle/compare/small_text.h"

#include <algorithm>
#include <array>

namespace strata::oracle {

namespace {

struct Letter {
    char character;
    unsigned bits;
};

constexpr auto shapes = std::to_array<Letter>(
    {{'a', 0x2bed}, {'b', 0x6bae}, {'c', 0x3923}, {'d', 0x6b6e}, {'e', 0x79a7}, {'f', 0x79a4}, {'g', 0x396b},
     {'h', 0x5bed}, {'i', 0x7497}, {'j', 0x126a}, {'k', 0x5bad}, {'l', 0x4927}, {'m', 0x5f6d}, {'n', 0x6b6d},
     {'o', 0x2b6a}, {'p', 0x6ba4}, {'q', 0x2b73}, {'r', 0x6bad}, {'s', 0x388e}, {'t', 0x7492}, {'u', 0x5b6f},
     {'v', 0x5b6a}, {'w', 0x5b7d}, {'x', 0x5aad}, {'y', 0x5a92}, {'z', 0x72a7}, {'0', 0x7b6f}, {'1', 0x2c97},
     {'2', 0x62a7}, {'3', 0x628e}, {'4', 0x5bc9}, {'5', 0x798e}, {'6', 0x39ef}, {'7', 0x7292}, {'8', 0x7bef},
     {'9', 0x7bce}, {' ', 0x0000}, {'.', 0x0002}, {'_', 0x0007}, {'-', 0x01c0}, {':', 0x0410}, {'/', 0x12a4},
     {'(', 0x2922}, {')', 0x224a}});

unsigned bits_of(char character) {
    const auto found = std::ranges::find(shapes, character, &Letter::character);
    return found == shapes.end() ? 0x7fffu : found->bits;
}

}  // namespace

void draw_text(pipeline::Image& rgba8, int x, int y, std::string_view text, int scale) {
    for (const char character : text) {
        const unsigned bits = bits_of(character);
        for (int row = 0; row < 5 * scale; ++row)
            for (int column = 0; column < 3 * scale; ++column) {
                const int bit = row / scale * 3 + column / scale, px = x + column, py = y + row;
                const bool is_inside = px >= 0 && py >= 0 && px < rgba8.width && py < rgba8.height;
                if ((bits >> (14 - bit) & 1u) == 0 || !is_inside) continue;
                for (int c = 0; c < 4; ++c) rgba8.codes[rgba8.index(px, py, c)] = 255;
            }
        x += letter_width_px * scale;
    }
}

}  // namespace strata::oracle
