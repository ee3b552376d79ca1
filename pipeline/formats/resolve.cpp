// pipeline/formats/resolve.cpp - computes one image from the images of several samples (resolve.h).
#include "pipeline/formats/resolve.h"

#include <algorithm>
#include <array>
#include <bit>
#include <utility>

#include "pipeline/formats/convert.h"
#include "pipeline/formats/narrow.h"
#include "pipeline/formats/packed.h"
#include "pipeline/formats/unorm8_product.h"
#include "rasterizer/base/float_environment.h"

namespace strata::pipeline {
namespace {

constexpr std::size_t codes_at_once = 1024;

// Calls visit(first, count) for consecutive blocks of `size` codes.
template <class Visit>
void for_blocks_of_codes(std::size_t size, const Visit& visit) {
    for (std::size_t first = 0; first < size; first += codes_at_once)
        visit(first, std::min(codes_at_once, size - first));
}

}  // namespace

void ColorResolve::add(Image sample) {
    const FloatEnvironment ours;
    const bool is_first = sum_.codes.empty();
    if (is_first) sum_.format = sample.format;
    if (adds_codes() && is_first) {
        sum_ = std::move(sample);
        return;
    }
    if (is_first) sum_ = Image(sample.format, sample.width, sample.height);
    std::uint32_t* const sums = sum_.codes.data();
    const std::uint32_t* const codes = sample.codes.data();
    if (adds_codes()) {
        for (std::size_t i = 0; i < sample.codes.size(); ++i) sums[i] += codes[i];
        return;
    }
    std::array<float, codes_at_once> values;
    const ChannelType type = info(sample.format).type;
    for_blocks_of_codes(sample.codes.size(), [&](std::size_t first, std::size_t count) {
        if (is_packed(sample.format))
            for (std::size_t i = 0; i < count; ++i)
                values[i] = packed_value(sample.format, static_cast<int>((first + i) % 4), codes[first + i], rounding_);
        else if (type == ChannelType::unorm8)
            for (std::size_t i = 0; i < count; ++i) values[i] = code_value(codes[first + i], rounding_.unorm);
        else
            scalar::decode(type, codes + first, values.data(), count);
        for (std::size_t i = 0; i < count; ++i)
            sums[first + i] = std::bit_cast<std::uint32_t>(std::bit_cast<float>(sums[first + i]) + values[i]);
    });
}

Image ColorResolve::picture() && {
    const FloatEnvironment ours;
    const auto n = static_cast<std::uint32_t>(samples_);
    std::uint32_t* const sums = sum_.codes.data();
    const std::size_t size = sum_.codes.size();
    if (adds_codes()) {
        const int bits = std::countr_zero(n);  // a power of two
        for (std::size_t i = 0; i < size; ++i) sums[i] = (sums[i] + n / 2) >> bits;
    } else {
        std::array<float, codes_at_once> values;
        const float share = 1.0f / static_cast<float>(samples_);
        for_blocks_of_codes(size, [&](std::size_t first, std::size_t count) {
            for (std::size_t i = 0; i < count; ++i) values[i] = std::bit_cast<float>(sums[first + i]) * share;
            if (is_packed(sum_.format))
                for (std::size_t i = 0; i < count; ++i)
                    sums[first + i] = packed_code(sum_.format, static_cast<int>((first + i) % 4), values[i], rounding_);
            else
                scalar::encode(info(sum_.format).type, rounding_, values.data(), sums + first, count);
        });
    }
    if (is_narrow(sum_.format))
        for (std::size_t i = 0; i < size; ++i) sums[i] = narrowed(sum_.format, static_cast<int>(i % 4), sums[i]);
    return std::move(sum_);
}

Image quincunx(const Image& corner, const Image& centre) {
    Image picture = Image::for_overwrite(centre.format, centre.width, centre.height);
    for (int y = 0; y < centre.height; ++y) {
        const int below = std::min(y + 1, centre.height - 1);
        for (int x = 0; x < centre.width; ++x)
            for (int c = 0; c < centre.channels(); ++c) {
                const int right = std::min(x + 1, centre.width - 1);
                const auto at = [&](int column, int row) { return corner.codes[corner.index(column, row, c)]; };
                const std::uint32_t corners = at(x, y) + at(right, y) + at(x, below) + at(right, below);
                const std::uint32_t code = (4 * centre.codes[centre.index(x, y, c)] + corners + 4) / 8;
                picture.codes[picture.index(x, y, c)] = narrowed(centre.format, c, code);
            }
    }
    return picture;
}

void add_nearest(Image sample, Image& nearest) {
    if (nearest.codes.empty()) {
        nearest = std::move(sample);
        return;
    }
    for (std::size_t i = 0; i < sample.codes.size(); ++i)
        nearest.codes[i] = std::min(nearest.codes[i], sample.codes[i]);
}

}  // namespace strata::pipeline
