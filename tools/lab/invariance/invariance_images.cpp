#include "tools/lab/invariance/invariance_images.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <filesystem>

#include "rasterizer/base/input_error.h"
#include "scenes/files/image_io.h"

namespace strata::tools {

namespace {

using pipeline::Image;

// An 8-bit code of a value from 0 to 1, clamped and rounded to nearest. Only for viewing: no result depends on it.
std::uint32_t to_code(double value) {
    return static_cast<std::uint32_t>(std::lround(255.0 * std::clamp(value, 0.0, 1.0)));
}

// An opaque rgba8 image whose channel c at (x, y) is color(x, y, c).
template <class Color>
Image draw(int width, int height, Color&& color) {
    Image image(pipeline::Format::rgba8, width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            for (int c = 0; c < 3; ++c) image.codes[image.index(x, y, c)] = color(x, y, c);
            image.codes[image.index(x, y, 3)] = 255;
        }
    return image;
}

// The magnitude of the difference times four: a difference of a quarter is full brightness.
Image magnified(const Image& difference) {
    return draw(difference.width, difference.height, [&](int x, int y, int c) {
        return to_code(4.0 * std::fabs(peeling::channel_value(difference, x, y, c)));
    });
}

// `map` has one byte per pixel, row by row from the top: 0, or bits for a duplicated and a lost layer.
Image error_map(const Image& picture, const std::vector<std::uint8_t>& map) {
    return draw(picture.width, picture.height, [&](int x, int y, int c) {
        const std::uint8_t error =
            map[static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) + static_cast<std::size_t>(x)];
        if (error != 0) {
            const bool is_lit =
                (c == 0 && (error & peeling::layer_duplicated) != 0) || (c == 2 && (error & peeling::layer_lost) != 0);
            return is_lit ? 255u : 0u;
        }
        // The mean of r, g and b at 40 %, so that the marks are conspicuous.
        double grey = 0;
        for (int k = 0; k < 3; ++k) grey += peeling::channel_value(picture, x, y, k) / 3.0;
        return to_code(0.4 * grey);
    });
}

}  // namespace

void write_cell_images(const std::string& folder, std::size_t number, const CellResult& result) {
    // A cell without errors has no files.
    if (result.measured.refusal || result.measured.errors.total() == 0) return;
    const std::filesystem::path images = std::filesystem::path(folder) / "images";
    // The folder may come from someone else: a link would lead the pictures elsewhere.
    if (std::filesystem::is_symlink(images))
        throw InputError(images.string(), "folder", "a folder in its own place", "a link");
    std::filesystem::create_directories(images);
    const auto path = [&](const char* ending) { return (images / fmt::format("{:04}{}", number, ending)).string(); };
    const Image& picture = result.measured.picture;
    const Image difference = peeling::difference(picture, result.measured.truth);
    scenes::write_image(path(".png"), {.color = picture});
    scenes::write_image(path(".difference.png"), {.color = magnified(difference)});
    scenes::write_image(path(".difference.exr"), {.color = difference});
    scenes::write_image(path(".errors.png"), {.color = error_map(picture, result.measured.errors.map)});
}

}  // namespace strata::tools
