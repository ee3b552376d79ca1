// pipeline/target.h - render targets: a handle, and the storage of one region's rectangle.
#pragma once
#include <array>
#include <cassert>
#include <cstdint>
#include <optional>
#include <vector>

#include "pipeline/format.h"
#include "pipeline/image.h"
#include "rasterizer/fragment_batch.h"

namespace strata::pipeline {

using rasterizer::batch_capacity;
using rasterizer::FragmentBatch;
using rasterizer::Lanes;

// A handle into its region's storage: copy it, swap it, compare it. The same number in every region.
struct Target {
    int id = -1;
    [[nodiscard]] constexpr bool exists() const noexcept { return id >= 0; }
    friend constexpr bool operator==(Target, Target) = default;
};

struct ClearValue {
    std::array<float, 4> color{0, 0, 0, 0};
    float depth = 1.0f;
    std::uint8_t stencil = 0;
};

using ColorCodes = std::array<Lanes<std::uint32_t>, 4>;  // per channel: u8 codes, half bits or binary32 bits, zero-extended
using ColorLanes = std::array<Lanes<float>, 4>;

// One sample plane after another, each row-major; a colour pixel's channels lie together. Only the vectors that the format
// needs are filled.
class TargetStorage {
  public:
    TargetStorage(Format format, int samples, std::size_t pixels);

    [[nodiscard]] Format format() const noexcept { return format_; }
    [[nodiscard]] int samples() const noexcept { return samples_; }
    [[nodiscard]] std::size_t pixels() const noexcept { return pixels_; }

    // Lanes i < count of the listed pixels; scatter touches lanes with alive[i] != 0 and channels in `mask` only.
    void gather(const Lanes<std::uint32_t>& pixel, int count, int sample, ColorCodes& codes) const;
    void scatter(const Lanes<std::uint32_t>& pixel, const Lanes<std::uint32_t>& alive, int count, int sample,
                 unsigned mask, const ColorCodes& codes);

    [[nodiscard]] std::uint32_t* depth(int sample) noexcept { return words_.data() + plane(sample); }
    [[nodiscard]] const std::uint32_t* depth(int sample) const noexcept { return words_.data() + plane(sample); }
    [[nodiscard]] std::uint8_t* stencil(int sample) noexcept { return bytes_.data() + plane(sample); }
    [[nodiscard]] const std::uint8_t* stencil(int sample) const noexcept { return bytes_.data() + plane(sample); }

    // The code of one channel of one sample, as Image holds it. A d24s8 target answers with its depth.
    [[nodiscard]] std::uint32_t code(std::size_t pixel, int channel, int sample) const;
    void fill(const std::array<std::uint32_t, 4>& codes, unsigned sample_mask);  // colour or depth
    void fill_stencil(std::uint8_t value, unsigned sample_mask);

  private:
    [[nodiscard]] std::size_t plane(int sample) const noexcept { return static_cast<std::size_t>(sample) * pixels_; }

    Format format_;
    int samples_;
    std::size_t pixels_;
    std::vector<std::uint8_t> bytes_;   // unorm8 colours; stencil
    std::vector<std::uint16_t> halves_;
    std::vector<std::uint32_t> words_;  // binary32 colours; depth codes
};

}  // namespace strata::pipeline
