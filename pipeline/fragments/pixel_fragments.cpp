// pipeline/fragments/pixel_fragments.cpp - sorts the fragments of all samples by triangle and pixel, so that those of
// one follow one another (pixel_fragments.h).
#include "pipeline/fragments/pixel_fragments.h"

#include <algorithm>
#include <utility>

#include "pipeline/stages/stage_lanes.h"

namespace strata::pipeline {

namespace {

constexpr std::uint32_t pixel_of(std::uint64_t place) noexcept { return static_cast<std::uint32_t>(place) & 0xfffffff; }

}  // namespace

// A region has at most 2^28 pixels.
void PixelFragments::add_as(const FragmentBatch& batch, const Lanes<std::uint32_t>& covered,
                            const Lanes<std::uint32_t>& kept, std::uint32_t piece, std::uint32_t number) {
    const auto width = static_cast<std::uint32_t>(region_.width()), x0 = static_cast<std::uint32_t>(region_.x0),
               y0 = static_cast<std::uint32_t>(region_.y0);
    for (std::size_t i = 0; i < static_cast<std::size_t>(batch.count); ++i) {
        if (covered[i] == 0) continue;
        const std::uint32_t pixel = (batch.y[i] - y0) * width + batch.x[i] - x0;
        fragments_.push_back({std::uint64_t{batch.primitive[i]} << 32 | piece << 28 | pixel,
                              number,
                              kept[i] != 0,
                              batch.x[i],
                              batch.y[i],
                              batch.reference_code[i],
                              batch.code[i],
                              batch.shader_z[i],
                              batch.reference_z[i],
                              {batch.color[0][i], batch.color[1][i], batch.color[2][i], batch.color[3][i]}});
    }
}

void PixelFragments::add_colors(const FragmentBatch& batch, const Lanes<std::uint32_t>& kept, std::uint32_t piece,
                                std::size_t sample) {
    add_as(batch, every_lane, kept, piece, first_color + static_cast<std::uint32_t>(sample));
}

void PixelFragments::start(const SampleFragment& fragment) {
    FragmentBatch& batch = pixels_.batch;
    const auto k = static_cast<std::size_t>(batch.count++);
    const std::uint32_t pixel = pixel_of(fragment.place);
    batch.pixel[k] = pixel;
    batch.x[k] = fragment.x;
    batch.y[k] = fragment.y;
    batch.primitive[k] = static_cast<std::uint32_t>(fragment.place >> 32);
    batch.shader_z[k] = fragment.shader_z;
    batch.code[k] = batch.reference_code[k] = fragment.code;
    batch.reference_z[k] = fragment.reference_z;
    for (std::size_t c = 0; c < 4; ++c) batch.color[c][k] = fragment.color[c];
    pixels_.covered[k] = 0;
    pixels_.kept[0][k] = fragment.is_kept ? 1 : 0;
    pixels_.kept[1][k] = fragment.is_kept ? 0xff : 0;
    last_batch_[pixel] = number_;
}

void PixelFragments::join(const std::function<void(PixelBatch&)>& sink) {
    std::ranges::sort(fragments_, {}, [](const SampleFragment& f) { return std::pair{f.place, f.number}; });
    FragmentBatch& batch = pixels_.batch;
    const auto end_batch = [&] {
        if (batch.count > 0) sink(pixels_);
        batch.count = 0;
        ++number_;
    };
    for (std::size_t i = 0; i < fragments_.size();) {
        const SampleFragment& first = fragments_[i];
        if (batch.count == batch_capacity || last_batch_[pixel_of(first.place)] == number_) end_batch();
        start(first);
        const auto k = static_cast<std::size_t>(batch.count - 1);
        for (; i < fragments_.size() && fragments_[i].place == first.place; ++i) {
            const SampleFragment& f = fragments_[i];
            if (f.number >= first_color) {
                const std::uint32_t sample = f.number - first_color;
                for (std::size_t c = 0; c < 4; ++c) pixels_.sample_color[sample][c][k] = f.color[c];
                const auto bit = static_cast<std::uint8_t>(1u << sample);
                pixels_.kept[1][k] =
                    static_cast<std::uint8_t>(f.is_kept ? pixels_.kept[1][k] | bit : pixels_.kept[1][k] & ~bit);
                continue;
            }
            pixels_.covered[k] |= static_cast<std::uint8_t>(1u << f.number);
            pixels_.sample_code[f.number][k] = f.sample_code;
        }
    }
    end_batch();
    fragments_.clear();
}

}  // namespace strata::pipeline
