// pipeline/fragments/tile_cache.cpp - fetches, blends and writes back the tiles of tile_cache.h.
#include "pipeline/fragments/tile_cache.h"

#include <algorithm>
#include <bit>

#include "pipeline/formats/half.h"
#include "pipeline/formats/narrow.h"
#include "pipeline/formats/unorm8.h"
#include "pipeline/formats/unorm8_product.h"
#include "pipeline/stages/blend.h"
#include "pipeline/textures/depth_texels.h"

namespace strata::pipeline {

namespace {

// NaN becomes 0, because every comparison with it is false.
float clamped(float x) noexcept { return x > 0.0f ? std::min(x, 1.0f) : 0.0f; }

}  // namespace

CachedTiles::CachedTiles(const rasterizer::Rect& region, const rasterizer::Rect& frame, std::size_t samples)
    : region_{region},
      samples_{samples},
      x0_{region.x0 - frame.x0},
      y0_{region.y0 - frame.y0},
      across_{static_cast<std::uint32_t>((frame.width() + side - 1) / side)},
      down_{static_cast<std::uint32_t>((frame.height() + side - 1) / side)} {
    for (std::uint32_t tile = 0; tile < of_sample(); ++tile) ++tiles_of_slot_[slot_of(tile)];
}

std::uint32_t CachedTiles::tile_of(std::uint32_t element) const noexcept {
    const auto width = static_cast<std::uint32_t>(region_.width()), area = static_cast<std::uint32_t>(region_.area());
    const std::uint32_t pixel = element % area;
    const std::uint32_t x = pixel % width + static_cast<std::uint32_t>(x0_),
                        y = pixel / width + static_cast<std::uint32_t>(y0_);
    return element / area * of_sample() + y / side * across_ + x / side;
}

std::size_t CachedTiles::slot_of(std::uint32_t tile) const noexcept {
    const std::uint32_t own = tile % of_sample();
    return tile / of_sample() * std::size_t{slots} + (own % across_ + 5 * (own / across_)) % slots;
}

CachedTarget::CachedTarget(const CachedTiles& tiles, const DeviceProfile& profile, const Blend& blending,
                           CachedPlanes planes)
    : tiles_{tiles},
      profile_{profile},
      blending_{blending},
      planes_{std::move(planes)},
      format_{info(planes_.format)},
      clamps_{format_.type == ChannelType::unorm8},
      values_(planes_.pixels * planes_.samples.size()),
      held_(planes_.pixels * planes_.samples.size()),
      held_pixels_(tiles.count() * planes_.samples.size()) {
    if (clamps_)
        for (int c = 0; c < 4; ++c) blending_.constant[c] = clamped(blending_.constant[c]);
}

float CachedTarget::value_of(std::uint32_t code) const noexcept {
    if (!clamps_) return half_value(static_cast<std::uint16_t>(code), profile_.half_rounding);
    return code_value(code, profile_.unorm_rounding);
}

// Reads the values of the target's codes, or the held values, as bits of binary32.
void CachedTarget::fetch(const CachedLanes& lanes) {
    const auto count = static_cast<std::size_t>(lanes.batch.count);
    gather_codes(texels(lanes.sample), {lanes.batch.pixel.data(), count}, codes_.data());
    for (std::size_t i = 0; i < count; ++i) {
        const std::uint32_t pixel = lanes.batch.pixel[i];
        const bool held = is_held(pixel, lanes.sample);
        for (std::size_t c = 0; c < static_cast<std::size_t>(format_.channels); ++c) {
            const float value = held ? values_[word(pixel, lanes.sample)][c] : value_of(codes_[c][i]);
            codes_[c][i] = std::bit_cast<std::uint32_t>(value);
        }
    }
}

void CachedTarget::blend(const CachedLanes& lanes, int first, int end) {
    const auto from = static_cast<std::size_t>(first), to = static_cast<std::size_t>(end);
    fetch(lanes);
    ColorLanes source = lanes.color;
    for (std::size_t c = 0; clamps_ && c < 4; ++c)
        for (std::size_t i = from; i < to; ++i) source[c][i] = clamped(source[c][i]);
    pipeline::blend(blending_, ChannelType::single, profile_, format_.channels, source, codes_, lanes.batch.count);
    for (std::size_t i = from; i < to; ++i) {
        if (lanes.alive[i] == 0) continue;
        const std::uint32_t pixel = lanes.batch.pixel[i];
        const std::size_t at = word(pixel, lanes.sample);
        for (std::size_t c = 0; c < static_cast<std::size_t>(format_.channels); ++c) {
            const float value = std::bit_cast<float>(codes_[c][i]);
            values_[at][c] = clamps_ ? clamped(value) : value;
        }
        if (held_[at] == 0) held_of(tiles_.tile_of(pixel), static_cast<std::size_t>(lanes.sample)).push_back(pixel);
        held_[at] = 1;
    }
}

void CachedTarget::write_back(std::uint32_t tile) {
    for (std::size_t sample = 0; sample < planes_.samples.size(); ++sample) {
        auto& pixels = held_of(tile, sample);
        for (std::size_t first = 0; first < pixels.size(); first += batch_capacity)
            write(&pixels[first], static_cast<int>(std::min<std::size_t>(pixels.size() - first, batch_capacity)),
                  static_cast<int>(sample));
        pixels.clear();
    }
}

void CachedTarget::write(const std::uint32_t* pixels, int count, int sample) {
    Lanes<std::uint32_t> all{}, places{};  // full length, because kernels read whole vectors
    std::copy_n(pixels, count, places.begin());
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
        const std::size_t at = word(pixels[i], sample);
        held_[at] = 0;
        all[i] = ~0u;
        for (std::size_t c = 0; c < static_cast<std::size_t>(format_.channels); ++c)
            codes_[c][i] = clamps_ ? to_unorm8(values_[at][c], profile_.unorm_rounding)
                                   : to_half(values_[at][c], profile_.half_rounding);
    }
    scatter_codes(texels(sample), {places.data(), static_cast<std::size_t>(count)}, all.data(), blending_.write_mask,
                  codes_.data());
}

void CachedTarget::write_back() {
    for (std::uint32_t tile = 0; tile < tiles_.count(); ++tile) write_back(tile);
}

TileCache::TileCache(const rasterizer::Rect& region, const rasterizer::Rect& frame, std::size_t samples)
    : tiles_{region, frame, samples}, is_frame_{region == frame} {
    for (auto& owners : owner_) owners.assign(tiles_.all_slots(), no_tile);
}

bool TileCache::knows(const Blend& blending, Format format) noexcept {
    using enum BlendEquation;
    const auto rounds = [](const BlendTerm& term) {
        return term.equation == add || term.equation == subtract || term.equation == reverse_subtract;
    };
    const ChannelType type = info(format).type;
    return blending.blends() && !is_packed(format) &&
           (type == ChannelType::half || (type == ChannelType::unorm8 && !is_narrow(format))) &&
           (rounds(blending.color) || rounds(blending.alpha));
}

// Writes back the tile that occupies the slot.
void TileCache::take_slot(CachedTarget& target, std::size_t number, std::uint32_t tile) {
    std::uint32_t& owner = owner_[number][tiles_.slot_of(tile)];
    if (owner != no_tile && owner != tile) target.write_back(owner);
    owner = tile;
}

// Lanes are in submission order; within a triangle rows go from top to bottom, and so do tiles that share a slot.
void TileCache::blend(std::size_t number, const CachedLanes& lanes) {
    CachedTarget& target = *targets_[number];
    const FragmentBatch& batch = lanes.batch;
    const auto waits_elsewhere = [&](std::uint32_t pixel) {
        return target.is_held(pixel, lanes.sample) && tiles_.is_shared(tiles_.tile_of(pixel));
    };
    for (std::size_t i = 0; !is_frame_ && i < static_cast<std::size_t>(batch.count); ++i)
        if (lanes.alive[i] != 0 && waits_elsewhere(batch.pixel[i])) throw NeedsFrame{};
    int first = 0;
    for (int lane = 0; lane < batch.count; ++lane) {
        const auto i = static_cast<std::size_t>(lane);
        if (lanes.fetched[i] == 0) continue;
        const std::uint32_t tile = tiles_.tile_of(batch.pixel[i]), owner = owner_[number][tiles_.slot_of(tile)];
        if (owner == tile) continue;
        if (owner != no_tile && first < lane) {
            target.blend(lanes, first, lane);
            first = lane;
        }
        take_slot(target, number, tile);
    }
    target.blend(lanes, first, batch.count);
}

// Owners are kept: the next pass's targets have no held values in their tiles, so nothing would be written back.
void TileCache::close() {
    for (std::size_t number = 0; number < targets_.size(); ++number) {
        if (!targets_[number]) continue;
        targets_[number]->write_back();
        targets_[number].reset();
    }
}

}  // namespace strata::pipeline
