// tools/oracle/emulations/of_picture.cpp - mistakes in writing a finished image to a file.
#include <algorithm>
#include <array>

#include "scenes/numbers/srgb_encode.h"
#include "tools/oracle/emulations/catalogue.h"

namespace strata::oracle {

namespace {

bool afterwards(AlteredRun& e, std::function<void(Picture&)> change) {
    e.afterwards.push_back(std::move(change));
    return true;
}

// Pixel (x, y) gets the value of pixel place(x, y, width, height); pixels whose source is outside are unchanged.
template <class PlaceOf>
bool from_elsewhere(AlteredRun& e, PlaceOf place) {
    return afterwards(e, [=](Picture& picture) {
        for (TargetImage& t : picture.targets) {
            const std::vector<std::uint32_t> old = t.codes;
            const auto channels = static_cast<std::size_t>(t.channels);
            for (int y = 0; y < t.height; ++y)
                for (int x = 0; x < t.width; ++x) {
                    const auto [from_x, from_y] = place(x, y, t.width, t.height);
                    if (from_x < 0 || from_y < 0 || from_x >= t.width || from_y >= t.height) continue;
                    const auto at = [&](int px, int py) {
                        return (static_cast<std::size_t>(py) * static_cast<std::size_t>(t.width) +
                                static_cast<std::size_t>(px)) *
                               channels;
                    };
                    std::copy_n(old.begin() + static_cast<std::ptrdiff_t>(at(from_x, from_y)), channels,
                                t.codes.begin() + static_cast<std::ptrdiff_t>(at(x, y)));
                }
        }
    });
}

// Replaces red, green and blue of every colour target by value(channel).
template <class Value>
bool with_colors(AlteredRun& e, Value value) {
    return afterwards(e, [=](Picture& picture) {
        for (TargetImage& t : picture.targets) {
            if (t.meaning != Meaning::color) continue;
            const auto changed = [&](std::uint32_t word) {
                return nearest(t.code, value(oracle::value(t.code, word)));
            };
            // A table for the 256 values of 8-bit codes, each of which occurs often.
            std::array<std::uint32_t, 256> of_byte{};
            for (std::uint32_t word = 0; t.code == Code::unorm8 && word < 256; ++word) of_byte[word] = changed(word);
            const auto channels = static_cast<std::size_t>(t.channels);
            for (std::size_t i = 0; i < t.pixels(); ++i)
                for (std::size_t c = 0; c < std::min<std::size_t>(channels, 3); ++c) {
                    std::uint32_t& word = t.codes[i * channels + c];
                    word = t.code == Code::unorm8 ? of_byte[word] : changed(word);
                }
        }
    });
}

const Mistake picture_mistakes[] = {
    {"flipped_rows", "the right picture upside down: its rows stored from the bottom", ChangedPart::picture,
     [](AlteredRun& e) {
         return from_elsewhere(e, [](int x, int y, int, int height) { return std::pair{x, height - 1 - y}; });
     }},
    {"flipped_columns", "the right picture as in a mirror", ChangedPart::picture,
     [](AlteredRun& e) {
         return from_elsewhere(e, [](int x, int y, int width, int) { return std::pair{width - 1 - x, y}; });
     }},
    {"one_pixel_right", "the right picture moved right by one pixel", ChangedPart::picture,
     [](AlteredRun& e) { return from_elsewhere(e, [](int x, int y, int, int) {
                             return std::pair{x - 1, y};
                         }); }},
    {"one_pixel_down", "the right picture moved down by one pixel", ChangedPart::picture,
     [](AlteredRun& e) { return from_elsewhere(e, [](int x, int y, int, int) {
                             return std::pair{x, y - 1};
                         }); }},
    {"srgb_twice", "colours encoded to sRGB twice", ChangedPart::picture,
     [](AlteredRun& e) {
         return with_colors(e, [](double v) { return double{scenes::encode_srgb(static_cast<float>(v))}; });
     }},
    {"srgb_decoded", "colours decoded from sRGB and not encoded again", ChangedPart::picture,
     [](AlteredRun& e) {
         return with_colors(e, [](double v) { return double{scenes::decode_srgb(static_cast<float>(v))}; });
     }},
    {"stored_in_8_bits", "float colours rounded to 8 bits on their way out", ChangedPart::picture,
     [](AlteredRun& e) {
         return with_colors(e, [](double v) { return oracle::value(Code::unorm8, nearest(Code::unorm8, v)); });
     }},
    {"red_for_blue", "red and blue exchanged", ChangedPart::picture,
     [](AlteredRun& e) {
         return afterwards(e, [](Picture& picture) {
             for (TargetImage& t : picture.targets)
                 for (std::size_t i = 0; t.channels >= 3 && i < t.pixels(); ++i) {
                     std::uint32_t* const texel = &t.codes[i * static_cast<std::size_t>(t.channels)];
                     std::swap(texel[0], texel[2]);
                 }
         });
     }},
    {"alpha_zero", "alpha 0 everywhere: the target was cleared to it and its alpha never written", ChangedPart::picture,
     [](AlteredRun& e) {
         return afterwards(e, [](Picture& picture) {
             for (TargetImage& t : picture.targets)
                 for (std::size_t i = 0; t.channels == 4 && i < t.pixels(); ++i) t.codes[4 * i + 3] = 0;
         });
     }},
};

}  // namespace

std::span<const Mistake> mistakes_of_picture() { return picture_mistakes; }

}  // namespace strata::oracle
