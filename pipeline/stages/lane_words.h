// pipeline/stages/lane_words.h - reads, writes, tests and counts the stored values of a target at the pixels of a
// batch.
//
// Rule     A sample is stored in planes of 32-bit words, one or more words per pixel; a channel uses 8, 16 or 32 bits,
//          starting at the lowest. gather: codes[c][i] = channel c at pixel[i]. scatter: replaces the channels in
//          `mask` for alive lanes. test_depth: depth_test.h on the stored codes; dead lanes change nothing.
// Numbers  A plane has spare_words unused words after its last pixel: kernels load and store whole vectors there for
//          lanes past `count` and for dead ones. Lanes past `count` in a batch's own arrays are scratch. No pixel
//          occurs twice in a batch, so the order of the lanes does not matter.
// Tests    tests/pipeline/stages/simd_stages_test.cpp
#pragma once
#include <cstddef>
#include <cstdint>

#include "pipeline/formats/lane_mask.h"
#include "pipeline/stages/depth_test.h"
#include "rasterizer/coverage/fragment_batch.h"

namespace strata::pipeline {

using Word = std::uint32_t;
// One channel of a batch. Masks have the same type: 0 or ~0 per lane.
using CodeLanes = rasterizer::Lanes<Word>;

// One vector of AVX-512, the widest instruction set.
inline constexpr std::size_t spare_words = 16;

// One word per pixel of a region, row by row, followed by spare words.
struct Plane {
    Word* words = nullptr;
    // words[pixels] is the first spare one.
    std::size_t pixels = 0;
};

// The position of a channel in its pixel's words; `bits` is the mask of one code, unshifted.
struct Field {
    std::size_t word;
    int shift;
    std::uint32_t bits;
};

// One sample of a target: consecutive planes, the first at `words`.
struct Texels {
    Plane first;
    int channels = 1, bits_per_channel = 32;

    [[nodiscard]] constexpr Field field(int channel) const noexcept {
        const int bit = channel * bits_per_channel;
        return {static_cast<std::size_t>(bit / 32), bit % 32, ~0u >> (32 - bits_per_channel)};
    }
    // Words per pixel, and thereby planes per sample: at most four.
    [[nodiscard]] constexpr std::size_t words() const noexcept { return field(channels - 1).word + 1; }
    // Planes are consecutive, each with its spare words.
    [[nodiscard]] constexpr Plane plane(std::size_t word) const noexcept {
        return {first.words + word * (first.pixels + spare_words), first.pixels};
    }
};

// The pixels of a batch's lanes.
struct PixelLanes {
    const Word* pixel = nullptr;
    std::size_t count = 0;
};

// Number of alive fragments that reached a depth test, and of those that passed.
struct DepthResult {
    std::uint64_t arriving = 0, passed = 0;
};

// The kernels (stages_simd.cpp); their definitions follow. `codes` has one array per channel.
[[nodiscard]] std::uint64_t count_lanes(const Word* alive, std::size_t count) noexcept;
void gather_codes(const Texels& from, const PixelLanes& at, CodeLanes* codes) noexcept;
void scatter_codes(const Texels& to, const PixelLanes& at, const Word* alive, unsigned mask,
                   const CodeLanes* codes) noexcept;
// Clears `alive` where the test fails; writes the codes that pass if the state writes depth.
DepthResult test_depth(const DepthTest& state, DepthFormat format, Plane plane, const PixelLanes& at, const Word* code,
                       Word* alive) noexcept;

// One loop for the additive blends of weighted averages and sums: adds `source` to each fp16 channel of the texels in
// alive lanes, as blend_float.h does with both factors 1, rounded to nearest even. Returns false and does nothing on
// instruction sets without half conversion; the caller then gathers, blends and scatters, which is the definition.
[[nodiscard]] bool add_halves(const Texels& to, const PixelLanes& at, const Word* alive,
                              const rasterizer::Lanes<float>* source, bool flushes) noexcept;

inline namespace strict {
namespace scalar {

// An alive lane is ~0: one of its bits is counted.
[[nodiscard]] inline std::uint64_t count_lanes(const Word* alive, std::size_t count) noexcept {
    Word living = 0;
    for (std::size_t i = 0; i < count; ++i) living += alive[i] & 1u;
    return living;
}

inline void gather_codes(const Texels& from, const PixelLanes& at, CodeLanes* codes) noexcept {
    for (int c = 0; c < from.channels; ++c) {
        const Field f = from.field(c);
        const Word* const words = from.plane(f.word).words;
        for (std::size_t i = 0; i < at.count; ++i) codes[c][i] = words[at.pixel[i]] >> f.shift & f.bits;
    }
}

inline void scatter_codes(const Texels& to, const PixelLanes& at, const Word* alive, unsigned mask,
                          const CodeLanes* codes) noexcept {
    for (int c = 0; c < to.channels; ++c) {
        if ((mask >> c & 1u) == 0) continue;
        const Field f = to.field(c);
        Word* const words = to.plane(f.word).words;
        for (std::size_t i = 0; i < at.count; ++i) {
            Word& word = words[at.pixel[i]];
            word = select(alive[i] & f.bits << f.shift, codes[c][i] << f.shift, word);
        }
    }
}

inline DepthResult test_depth(const DepthTest& state, DepthFormat format, Plane plane, const PixelLanes& at,
                              const Word* code, Word* alive) noexcept {
    rasterizer::Lanes<Word> stored, pass;
    for (std::size_t i = 0; i < at.count; ++i) stored[i] = plane.words[at.pixel[i]];
    depth_test(state, format, code, stored.data(), pass.data(), static_cast<int>(at.count));
    const std::uint64_t arriving = count_lanes(alive, at.count);
    for (std::size_t i = 0; i < at.count; ++i) alive[i] &= pass[i];
    if (writes_depth(state))
        for (std::size_t i = 0; i < at.count; ++i) plane.words[at.pixel[i]] = select(alive[i], code[i], stored[i]);
    return {arriving, count_lanes(alive, at.count)};
}

}  // namespace scalar
}  // namespace strict
}  // namespace strata::pipeline
