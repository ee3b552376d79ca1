// pipeline/stages/target_storage.h - the storage of a render target over one region's rectangle.
#pragma once
#include <array>
#include <cassert>
#include <cstdint>
#include <optional>
#include <utility>

#include "pipeline/formats/color_rounding.h"
#include "pipeline/formats/format.h"
#include "pipeline/formats/half.h"
#include "pipeline/formats/image.h"
#include "pipeline/stages/lane_words.h"
#include "pipeline/stages/target.h"
#include "pipeline/vertices/draw_list.h"
#include "rasterizer/base/uninitialized.h"
#include "rasterizer/coverage/fragment_batch.h"

namespace strata::pipeline {

using TargetWords = UninitializedVector<std::uint32_t>;

// Planes of 32-bit words, row-major, so that kernels read and write any pixels of a batch by vector, whatever the
// format. A colour pixel has one word in rgba8, two in rgba16f (r g, b a) and rg32f, four in rgba32f, one in r16f and
// r32f; depth and stencil codes have one word each. rgb10_a2 and r11g11b10f have the words of rgba16f. Samples are
// consecutive, each with its planes. All codes are initially 0.
class TargetStorage {
  public:
    // `memory` is reused from a released target, if there is one.
    TargetStorage(Format format, int samples, std::size_t pixels, TargetWords memory = {});
    [[nodiscard]] TargetWords give_memory() noexcept { return std::move(words_); }

    [[nodiscard]] Format format() const noexcept { return format_; }
    [[nodiscard]] int samples() const noexcept { return samples_; }
    [[nodiscard]] std::size_t pixels() const noexcept { return pixels_; }

    // Lanes i < count of the listed pixels, and scratch past them; scatter changes only lanes with alive[i] != 0 and
    // channels in `mask`.
    void gather(const Lanes<std::uint32_t>& pixel, int count, int sample, ColorCodes& codes) const;
    void scatter(const Lanes<std::uint32_t>& pixel, const Lanes<std::uint32_t>& alive, int count, int sample,
                 unsigned mask, const ColorCodes& codes);

    // add_halves of lane_words.h. Precondition: the format is fp16.
    [[nodiscard]] bool add(const Lanes<std::uint32_t>& pixel, const Lanes<std::uint32_t>& alive, int count, int sample,
                           const ColorLanes& source, bool flushes) {
        return add_halves(texels(sample), {pixel.data(), static_cast<std::size_t>(count)}, alive.data(), source.data(),
                          flushes);
    }

    [[nodiscard]] Texels texels(int sample) const noexcept {
        if (!has_words_) write_zeros();
        Texels result = layout_;
        result.first = {
            const_cast<std::uint32_t*>(words_.data()) + static_cast<std::size_t>(sample) * words_per_sample(), pixels_};
        return result;
    }
    [[nodiscard]] Plane depth_plane(int sample) noexcept { return texels(sample).plane(0); }
    [[nodiscard]] Plane stencil_plane(int sample) noexcept { return texels(sample).plane(stencil_word()); }
    [[nodiscard]] const std::uint32_t* depth(int sample) const noexcept { return texels(sample).plane(0).words; }
    [[nodiscard]] const std::uint32_t* stencil(int sample) const noexcept {
        return texels(sample).plane(stencil_word()).words;
    }

    // The code of one channel of one sample, as in Image. For a d24s8 target this is the depth.
    [[nodiscard]] std::uint32_t code(std::size_t pixel, int channel, int sample) const;
    void fill(const std::array<std::uint32_t, 4>& codes, unsigned sample_mask);  // colour or depth
    void fill_stencil(std::uint8_t value, unsigned sample_mask);

  private:
    [[nodiscard]] std::size_t stencil_word() const noexcept { return format_ == Format::d24s8 ? 1 : 0; }
    [[nodiscard]] std::size_t words_per_sample() const noexcept {
        return (layout_.words() + stencil_word()) * (pixels_ + spare_words);
    }
    void write_zeros() const noexcept;
    void fill_word(std::uint32_t value, std::size_t word, unsigned sample_mask);

    Format format_;
    int samples_;
    std::size_t pixels_;
    Texels layout_;  // without the address
    mutable TargetWords words_;
    mutable bool has_words_ = false;  // false: zeros that have not been written, because most targets are cleared first
};

// The codes that a colour target of this format stores for a colour, per channel; 0 for depth and stencil.
[[nodiscard]] std::array<std::uint32_t, 4> color_codes(Format format, ColorRounding rounding, const Rgba& color);

}  // namespace strata::pipeline
