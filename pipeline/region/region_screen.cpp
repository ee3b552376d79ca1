// pipeline/region/region_screen.cpp - which pixels a full-screen pass visits: all of them, or those where a saved layer has a fragment.
//
// Rule     A quad that blends a layer (PassState::layer) leaves pixels without a fragment of it as they are: its source is (0, 0, 0, 0)
//          there. Of codes that is so whatever they are; of floats UNDER and OVER make 0 of -0, and change NaN and denormals: pixels
//          near one of those are visited, too. The others are counted as if they had been. Literal execution visits all.
// Source   execution.md 6.
// Tests    tests/pipeline/region/left_out_test.cpp, tests/peeling/execution_test.cpp
#include <algorithm>
#include <numeric>
#include <type_traits>

#include "pipeline/frame/effects.h"
#include "pipeline/frame/pass_counters.h"
#include "pipeline/region/region.h"
#include "pipeline/region/region_scratch.h"

namespace strata::pipeline {

namespace {

// ~0 where a blend with (0, 0, 0, 0) may change a channel of the word; `flushed`: ~0 if denormals become 0. Widened halves are none.
template <ChannelType type>
[[nodiscard]] Word is_odd(Word word, Word flushed) noexcept {
    if constexpr (type == ChannelType::unorm8) return 0;
    if constexpr (type == ChannelType::half)
        return mask((word & 0x7c00u) == 0x7c00u) | mask((word & 0xffffu) == 0x8000u) |
               mask((word & 0x7c000000u) == 0x7c000000u) | mask((word & 0xffff0000u) == 0x80000000u);
    const Word exponent = word & 0x7f800000u;
    return mask(exponent == 0x7f800000u) | mask(word == 0x80000000u) |
           (flushed & mask(exponent == 0) & mask(word != 0));
}

// A sample of a colour target, and what blending does to denormals.
struct Blended {
    Texels color;
    Word flushed;
};

template <ChannelType type>
[[nodiscard]] bool has_odd(const Blended& to, std::size_t first, std::size_t count) noexcept {
    Word odd = 0;
    for (std::size_t word = 0; type != ChannelType::unorm8 && word < to.color.words(); ++word) {
        const Word* const words = to.color.plane(word).words + first;
        for (std::size_t i = 0; i < count; ++i) odd |= is_odd<type>(words[i], to.flushed);
    }
    return odd != 0;
}

// The pixels to visit, ascending, into `pixels`; how many they are. An odd value is seldom: a batch with one is visited whole.
template <ChannelType type>
std::size_t find_pixels(const Word* depth, const Word* surface, const Blended& to, std::size_t area, Word* pixels) {
    std::size_t found = 0;
    for (std::size_t first = 0; first < area; first += batch_capacity) {
        const std::size_t count = std::min<std::size_t>(area - first, batch_capacity);
        const Word everywhere = mask(has_odd<type>(to, first, count));
        Word some = everywhere;
        for (std::size_t i = 0; i < count; ++i) some |= depth[first + i] ^ surface[first + i];
        for (std::size_t i = 0; some != 0 && i < count; ++i) {
            pixels[found] = static_cast<Word>(first + i);
            found += ((depth[first + i] ^ surface[first + i]) | everywhere) != 0 ? 1 : 0;
        }
    }
    return found;
}

// Nothing but a blend into one target: zeros pass through it without a trace.
bool only_blends(const PassState& state) {
    Blend blend = state.blend[0];
    blend.write_mask = blend_mode::over.write_mask;
    const bool is_tested =
        state.alpha.enabled || state.stencil.enabled || state.depth.enabled || state.depth_unit_count > 0;
    return (blend == blend_mode::under || blend == blend_mode::over) && !is_tested && !state.ordered_rmw &&
           std::ranges::count_if(state.color, &Target::exists) == 1;
}

// Calls body with the type as one.
std::size_t with_color_type(ChannelType type, auto&& body) {
    if (type == ChannelType::half) return body(std::integral_constant<ChannelType, ChannelType::half>{});
    if (type == ChannelType::single) return body(std::integral_constant<ChannelType, ChannelType::single>{});
    return body(std::integral_constant<ChannelType, ChannelType::unorm8>{});
}

}  // namespace

FragmentBatch& Region::screen_batch() noexcept { return scratch_->screen; }

// The pixels that a pass with a layer visits; without an answer all.
std::optional<std::span<const Word>> Region::pixels_of_layer(const PassState& state) {
    if (!state.layer.depth.exists() || extent_ != Extent::tile || frame_.effects != Effects::needed ||
        instruments_.once_more != Effect::none || pass_samples_ != 1 || !only_blends(state))
        return {};
    const Word *const depth = codes_of(state.layer.depth), *const surface = codes_of(state.layer.surface);
    const TargetStorage& color = at(state.color[0]);
    const Blended to{color.texels(0), mask(profile().denormals == DenormalRule::flush)};
    UninitializedVector<Word>& pixels = scratch_->layer_pixels;
    if (pixels.size() < rect_.area()) pixels.resize(rect_.area());
    const auto find = [&]<ChannelType type>(std::integral_constant<ChannelType, type>) {
        return find_pixels<type>(depth, surface, to, rect_.area(), pixels.data());
    };
    const std::size_t found = with_color_type(info(color.format()).type, find);
    for (const auto& targets : {std::span<const Target>{state.textures}, std::span<const Target>{state.reads}})
        for (const Target t : targets)
            if (t.exists())
                record().counters +=
                    of_loads(static_cast<std::uint64_t>(info(at(t).format()).bytes_per_pixel), rect_.area() - found);
    return std::span<const Word>{pixels.data(), found};
}

// As next_screen_batch, of `pixels`.
bool Region::next_layer_batch(std::span<const Word> pixels, FragmentBatch& batch, std::size_t& next) const {
    const std::size_t count = std::min<std::size_t>(pixels.size() - next, batch_capacity);
    std::copy_n(pixels.begin() + static_cast<std::ptrdiff_t>(next), count, batch.pixel.begin());
    find_positions(batch, count);
    next += count;
    batch.count = static_cast<int>(count);
    return count > 0;
}

// The pixels of a full-screen pass, row by row. Window positions fit 16 bits: a frame has at most 16,384 pixels a side.
bool Region::next_screen_batch(FragmentBatch& batch, std::size_t& next) const {
    const std::size_t left = rect_.area() - next;
    const std::size_t count = std::min<std::size_t>(left, batch_capacity);
    const auto width = static_cast<std::size_t>(rect_.width());
    std::iota(batch.pixel.begin(), batch.pixel.begin() + static_cast<std::ptrdiff_t>(count), static_cast<Word>(next));
    for (std::size_t i = 0; i < count;) {
        const std::size_t x = (next + i) % width, y = (next + i) / width, end = std::min(count, i + width - x);
        const auto first_x = static_cast<std::uint16_t>(static_cast<std::size_t>(rect_.x0) + x);
        for (std::size_t k = i; k < end; ++k) batch.x[k] = static_cast<std::uint16_t>(first_x + (k - i));
        std::fill(batch.y.begin() + static_cast<std::ptrdiff_t>(i), batch.y.begin() + static_cast<std::ptrdiff_t>(end),
                  static_cast<std::uint16_t>(static_cast<std::size_t>(rect_.y0) + y));
        i = end;
    }
    next += count;
    batch.count = static_cast<int>(count);
    return count > 0;
}

}  // namespace strata::pipeline
