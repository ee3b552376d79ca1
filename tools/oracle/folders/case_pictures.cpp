// tools/oracle/folders/case_pictures.cpp - shrinks pictures and heat maps to thumbnails (case_pictures.h).
#include "tools/oracle/folders/case_pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "scenes/images/png_encode.h"
#include "tools/oracle/compare/drawings.h"

namespace strata::oracle {

namespace {

int shrunk_by(int width, int height) { return (std::max(width, height) + thumbnail_px - 1) / thumbnail_px; }
int shrunk_side(int side, int by) { return (side + by - 1) / by; }

// Calls act(x, y) for the pixels of the square that becomes the pixel (column, row).
template <class Act>
void for_square(int column, int row, int by, int width, int height, const Act& act) {
    for (int y = row * by; y < std::min(height, (row + 1) * by); ++y)
        for (int x = column * by; x < std::min(width, (column + 1) * by); ++x) act(x, y);
}

CasePicture small_picture(const Picture& picture, const char* whose) {
    const pipeline::Image image = as_shown(picture);
    return {scenes::png_bytes(shrunk(image, shrunk_by(image.width, image.height))),
            fmt::format("The {}, {}x{}", whose, image.width, image.height)};
}

}  // namespace

pipeline::Image shrunk(const pipeline::Image& image, int by) {
    if (by <= 1) return image;
    pipeline::Image made{image.format, shrunk_side(image.width, by), shrunk_side(image.height, by)};
    for (int row = 0; row < made.height; ++row)
        for (int column = 0; column < made.width; ++column) {
            std::array<std::uint64_t, 4> sums{};
            std::uint64_t pixels = 0;
            for_square(column, row, by, image.width, image.height, [&](int x, int y) {
                ++pixels;
                for (int c = 0; c < 4; ++c) sums[static_cast<std::size_t>(c)] += image.codes[image.index(x, y, c)];
            });
            for (int c = 0; c < 4; ++c)
                made.codes[made.index(column, row, c)] =
                    static_cast<std::uint32_t>((2 * sums[static_cast<std::size_t>(c)] + pixels) / (2 * pixels));
        }
    return made;
}

Comparison shrunk_distances(const Comparison& found, int by) {
    Comparison made{.width = shrunk_side(found.width, by), .height = shrunk_side(found.height, by)};
    for (int row = 0; row < made.height; ++row)
        for (int column = 0; column < made.width; ++column) {
            std::uint32_t greatest = 0;
            for_square(column, row, by, found.width, found.height, [&](int x, int y) {
                const std::size_t pixel =
                    static_cast<std::size_t>(y) * static_cast<std::size_t>(found.width) + static_cast<std::size_t>(x);
                greatest = std::max(greatest, found.distance_of[pixel]);
            });
            made.distance_of.push_back(greatest);
        }
    return made;
}

std::vector<CasePicture> case_pictures(const Picture& reference, const Picture& candidate) {
    return {small_picture(reference, "reference"), small_picture(candidate, "candidate")};
}

std::vector<CasePicture> case_pictures(const Picture& reference, const Picture& candidate, const Comparison& found) {
    std::vector<CasePicture> all = case_pictures(reference, candidate);
    const int by = shrunk_by(found.width, found.height);
    all.push_back(
        {scenes::png_bytes(heat_map(shrunk_distances(found, by))),
         by == 1 ? "How far apart each pixel is: black is equal"
                 : fmt::format("How far apart the worst pixel of each square of {0}x{0} is: black is equal", by)});
    return all;
}

}  // namespace strata::oracle
