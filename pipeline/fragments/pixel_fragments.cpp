// pipeline/fragments/pixel_fragments.cpp - sorts the fragments of all samples by triangle and pixel, so that those of
// one follow one another (pixel_fragments.h).
#include "pipeline/fragments/pixel_fragments.h"

#include <algorithm>
#include <utility>

namespace strata::pipeline {

void PixelFragments::add_as(const FragmentBatch& batch, const Lanes<std::uint32_t>& alive, std::size_t number) {
    for (std::size_t i = 0; i < static_cast<std::size_t>(batch.count); ++i) {
        if (alive[i] == 0) continue;
        const std::uint64_t place =
            std::uint64_t{batch.primitive[i]} << 32 | std::uint32_t{batch.y[i]} << 16 | batch.x[i];
        fragments_.push_back({place,
                              static_cast<std::uint32_t>(number),
                              batch.reference_code[i],
                              batch.code[i],
                              batch.shader_z[i],
                              batch.reference_z[i],
                              {batch.color[0][i], batch.color[1][i], batch.color[2][i], batch.color[3][i]}});
    }
}

void PixelFragments::start(const SampleFragment& fragment, std::uint32_t pixel) {
    FragmentBatch& batch = pixels_.batch;
    const auto k = static_cast<std::size_t>(batch.count++);
    batch.pixel[k] = pixel;
    batch.x[k] = static_cast<std::uint16_t>(fragment.place);
    batch.y[k] = static_cast<std::uint16_t>(fragment.place >> 16);
    batch.primitive[k] = static_cast<std::uint32_t>(fragment.place >> 32);
    batch.shader_z[k] = fragment.shader_z;
    batch.code[k] = batch.reference_code[k] = fragment.code;
    batch.reference_z[k] = fragment.reference_z;
    for (std::size_t c = 0; c < 4; ++c) batch.color[c][k] = fragment.color[c];
    pixels_.covered[k] = 0;
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
    const auto width = static_cast<std::uint32_t>(region_.width());
    for (std::size_t i = 0; i < fragments_.size();) {
        const SampleFragment& first = fragments_[i];
        const std::uint32_t x = static_cast<std::uint16_t>(first.place),
                            y = static_cast<std::uint16_t>(first.place >> 16),
                            pixel = (y - static_cast<std::uint32_t>(region_.y0)) * width + x -
                                    static_cast<std::uint32_t>(region_.x0);
        if (batch.count == batch_capacity || last_batch_[pixel] == number_) end_batch();
        start(first, pixel);
        const auto k = static_cast<std::size_t>(batch.count - 1);
        for (; i < fragments_.size() && fragments_[i].place == first.place; ++i) {
            const SampleFragment& f = fragments_[i];
            if (f.number >= first_color) {
                for (std::size_t c = 0; c < 4; ++c) pixels_.sample_color[f.number - first_color][c][k] = f.color[c];
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
