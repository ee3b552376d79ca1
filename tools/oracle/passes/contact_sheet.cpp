#include "tools/oracle/passes/contact_sheet.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "scenes/files/image_formats.h"
#include "tools/oracle/compare/small_text.h"

namespace strata::oracle {

namespace {

using pipeline::ChannelType;
using pipeline::Image;

// Larger images are subsampled, smaller ones enlarged: with less than 96 pixels a column has no room for its name.
constexpr int most_width_px = 160, least_width_px = 96, space_px = 4, letter_scale = 2;
constexpr int caption_px = letter_scale * letter_height_px + 4, left_px = 128;

// The value of sample 0.
double value_of(const Image& image, int x, int y, int c) {
    const std::uint32_t code = image.codes[image.index(x, y, c)];
    const ChannelType type = pipeline::info(image.format).type;
    if (type == ChannelType::stencil) return code;
    if (type == ChannelType::depth) return rasterizer::depth_value(code, pipeline::depth_format(image.format));
    return double{scenes::channel_value(type, code)};
}

struct Range {
    double least = INFINITY, greatest = -INFINITY;
    [[nodiscard]] double share(double v) const { return greatest > least ? (v - least) / (greatest - least) : 0.0; }
};

Range range_of(const Image& image) {
    Range range;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            const double v = value_of(image, x, y, 0);
            if (!std::isfinite(v)) continue;
            range.least = std::min(range.least, v);
            range.greatest = std::max(range.greatest, v);
        }
    return range;
}

std::uint32_t byte_of(double v) {
    return std::isnan(v) ? 0u : static_cast<std::uint32_t>(std::clamp(v, 0.0, 1.0) * 255 + 0.5);
}

std::array<std::uint32_t, 3> shown(const Image& image, const Range& range, int x, int y) {
    const auto v = [&](int c) { return value_of(image, x, y, c); };
    if (image.channels() == 4) return {byte_of(v(0)), byte_of(v(1)), byte_of(v(2))};
    // Cleared min-max depths are (-1, -1): nothing is left to peel, and the pixel is black.
    if (image.channels() == 2)
        return v(1) < -v(0) ? std::array{0u, 0u, 0u} : std::array{byte_of(-v(0)), byte_of(v(1)), 0u};
    const double share = range.share(v(0));
    const std::uint32_t grey = byte_of(pipeline::is_depth(image.format) ? 1.0 - share : share);
    return {grey, grey, grey};
}

// Every step-th pixel of every step-th row, or each pixel enlarged to a square.
Image fitted(const Image& image) {
    const int step = (image.width + most_width_px - 1) / most_width_px;
    const int square =
        std::clamp((least_width_px + image.width - 1) / image.width, 1, std::max(1, most_width_px / image.height));
    Image cell{pipeline::Format::rgba8, (image.width + step - 1) / step * square,
               (image.height + step - 1) / step * square};
    const Range range = image.channels() == 1 ? range_of(image) : Range{};
    for (int y = 0; y < cell.height; ++y)
        for (int x = 0; x < cell.width; ++x) {
            const auto rgb = shown(image, range, x / square * step, y / square * step);
            for (std::size_t c = 0; c < 3; ++c) cell.codes[cell.index(x, y, static_cast<int>(c))] = rgb[c];
            cell.codes[cell.index(x, y, 3)] = 255;
        }
    return cell;
}

void fill(Image& image, int x0, int y0, int x1, int y1, std::uint32_t grey) {
    for (int y = y0; y < y1; ++y)
        for (int x = x0; x < x1; ++x)
            for (int c = 0; c < 4; ++c) image.codes[image.index(x, y, c)] = c == 3 ? 255 : grey;
}

}  // namespace

void ContactSheet::add(const PassReport& pass) {
    add(fmt::format("{} {}", pass.number, pass.kind == ReportedPassKind::full_screen ? "quad" : name(pass.kind)),
        pass.targets, pass.writes);
}

void ContactSheet::add(const std::string& caption, const std::vector<NamedImage>& targets,
                       const std::vector<std::string>& framed) {
    Row row{caption, {}};
    for (const NamedImage& target : targets) {
        const bool is_written = std::ranges::find(framed, target.name) != framed.end();
        row.cells.push_back({target.name, fitted(target.image), is_written});
        width_ = std::max(width_, row.cells.back().picture.width);
        height_ = std::max(height_, row.cells.back().picture.height);
        if (std::ranges::find(columns_, target.name) == columns_.end()) columns_.push_back(target.name);
    }
    rows_.push_back(std::move(row));
}

Image ContactSheet::image() const {
    const int column_px = width_ + space_px, row_px = height_ + space_px;
    Image sheet{pipeline::Format::rgba8, left_px + column_px * static_cast<int>(columns_.size()),
                caption_px + row_px * static_cast<int>(rows_.size())};
    fill(sheet, 0, 0, sheet.width, sheet.height, 48);
    for (std::size_t c = 0; c < columns_.size(); ++c)
        draw_text(sheet, left_px + column_px * static_cast<int>(c), 2,
                  columns_[c].substr(0, static_cast<std::size_t>(column_px / (letter_scale * letter_width_px))),
                  letter_scale);
    int top = caption_px;
    for (const Row& row : rows_) {
        draw_text(sheet, 2, top + 2, row.caption, letter_scale);
        for (const Thumbnail& cell : row.cells) {
            const auto column = static_cast<int>(std::ranges::find(columns_, cell.target) - columns_.begin());
            const int left = left_px + column_px * column;
            if (cell.is_written)
                fill(sheet, left - 2, top - 2, std::min(left + cell.picture.width + 2, sheet.width),
                     std::min(top + cell.picture.height + 2, sheet.height), 224);
            for (int y = 0; y < cell.picture.height; ++y)
                std::copy_n(cell.picture.codes.begin() + static_cast<std::ptrdiff_t>(cell.picture.index(0, y)),
                            4 * cell.picture.width,
                            sheet.codes.begin() + static_cast<std::ptrdiff_t>(sheet.index(left, top + y)));
        }
        top += row_px;
    }
    return sheet;
}

}  // namespace strata::oracle
