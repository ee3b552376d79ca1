// pipeline/fragments/tile_cache.h - colour targets during a pass that blends into them with BlendStorage::cached_tiles:
// blended values stay in binary32 and are rounded when their tile is written back.
//
// Rule     The frame is divided into tiles of 64 x 64 pixels, the cache has 50 slots; tile (x, y) uses slot (x + 5 y)
//          mod 50. Every sample of a frame has tiles and slots of its own. A fragment that passes its tests fetches its
//          tile; in a pass without tests so does a fragment that the program discards. The tile that occupied the slot
//          is written back: each channel is rounded to the target's format. A fetched value is the value of its code; a
//          blended value is neither rounded nor, on 8-bit targets, converted to a code, but clamped to 0..1 before and
//          after the blend. At the end of a pass all tiles are written back.
// Source   pipeline/reference/fragment-stages.md 9.5; mesa-rasterizers.md 3.5.
// Numbers  A value is written back only if a fragment was blended at it since it was fetched, so that no other value
//          changes. In frames of more than 5 x 10 tiles, tiles share slots: a region smaller than the frame then throws
//          NeedsFrame at the first pixel that is blended twice, because fragments outside the region may cause the
//          write-back.
// Tests    tests/pipeline/fragments/tile_cache_test.cpp
#pragma once
#include <array>
#include <optional>
#include <utility>
#include <vector>

#include "pipeline/device/profile.h"
#include "pipeline/frame/pass.h"
#include "pipeline/stages/lane_words.h"
#include "rasterizer/rules/raster_state.h"

namespace strata::pipeline {

// Lanes of a batch at one sample: those in `alive` are blended, those in `fetched` have their tile fetched.
struct CachedLanes {
    const FragmentBatch& batch;
    const ColorLanes& color;
    const Lanes<std::uint32_t>& alive;
    const Lanes<std::uint32_t>& fetched;
    int sample;
};

// The tile of each element of a region, and the slot of each tile.
class CachedTiles {
  public:
    static constexpr int side = 64, slots = 50;

    CachedTiles(const rasterizer::Rect& region, const rasterizer::Rect& frame, std::size_t samples);

    [[nodiscard]] std::size_t count() const noexcept { return samples_ * of_sample(); }
    [[nodiscard]] std::uint32_t tile_of(std::uint32_t element) const noexcept;
    [[nodiscard]] std::size_t slot_of(std::uint32_t tile) const noexcept;
    // True if another tile of the frame uses the same slot.
    [[nodiscard]] bool is_shared(std::uint32_t tile) const noexcept {
        return tiles_of_slot_[slot_of(tile) % slots] > 1;
    }
    [[nodiscard]] std::size_t all_slots() const noexcept { return samples_ * slots; }

  private:
    [[nodiscard]] std::uint32_t of_sample() const noexcept { return across_ * down_; }

    rasterizer::Rect region_;
    std::size_t samples_;
    int x0_, y0_;  // the region's corner, in pixels of the frame
    std::uint32_t across_, down_;
    std::array<std::uint32_t, slots> tiles_of_slot_{};  // number of tiles per slot, of one sample
};

// The storage of a target's codes: one Texels per sample.
struct CachedPlanes {
    Format format;
    std::size_t pixels;
    std::vector<Texels> samples;
};

// One colour target of a pass.
class CachedTarget {
  public:
    CachedTarget(const CachedTiles& tiles, const DeviceProfile& profile, const Blend& blending, CachedPlanes planes);

    // Blends lanes [first, end). Precondition: no two of their tiles share a slot.
    void blend(const CachedLanes& lanes, int first, int end);
    void write_back(std::uint32_t tile);
    void write_back();
    // True if a pixel has been blended since its tile was fetched.
    [[nodiscard]] bool is_held(std::uint32_t pixel, int sample) const noexcept {
        return held_[word(pixel, sample)] != 0;
    }

  private:
    [[nodiscard]] std::size_t word(std::uint32_t pixel, int sample) const noexcept {
        return static_cast<std::size_t>(sample) * planes_.pixels + pixel;
    }
    [[nodiscard]] const Texels& texels(int sample) const noexcept {
        return planes_.samples[static_cast<std::size_t>(sample)];
    }
    // The held pixels of a tile for one sample.
    [[nodiscard]] std::vector<std::uint32_t>& held_of(std::uint32_t tile, std::size_t sample) noexcept {
        return held_pixels_[tile * planes_.samples.size() + sample];
    }
    [[nodiscard]] float value_of(std::uint32_t code) const noexcept;
    void fetch(const CachedLanes& lanes);
    void write(const std::uint32_t* pixels, int count, int sample);

    const CachedTiles& tiles_;
    const DeviceProfile& profile_;
    Blend blending_;
    CachedPlanes planes_;
    FormatInfo format_;
    bool clamps_;                               // UNORM8
    std::vector<std::array<float, 4>> values_;  // of held pixels
    std::vector<std::uint8_t> held_;
    std::vector<std::vector<std::uint32_t>> held_pixels_;
    ColorCodes codes_{};  // of the lanes being blended
};

// All targets of one pass, which are fetched and written back together.
class TileCache {
  public:
    TileCache(const rasterizer::Rect& region, const rasterizer::Rect& frame, std::size_t samples = 1);

    // True if the cache affects a blend: minima and maxima of rounded values are already rounded, and binary32 is not
    // rounded.
    [[nodiscard]] static bool knows(const Blend& blending, Format format) noexcept;
    void hold(std::size_t number, const DeviceProfile& profile, const Blend& blending, CachedPlanes planes) {
        targets_[number].emplace(tiles_, profile, blending, std::move(planes));
    }
    [[nodiscard]] bool holds(std::size_t number) const noexcept { return targets_[number].has_value(); }
    void blend(std::size_t number, const CachedLanes& lanes);
    void close();

  private:
    void take_slot(CachedTarget& target, std::size_t number, std::uint32_t tile);

    CachedTiles tiles_;
    bool is_frame_;  // true if the region is the whole frame
    std::array<std::optional<CachedTarget>, max_color_targets> targets_;
    static constexpr std::uint32_t no_tile = ~0u;
    std::array<std::vector<std::uint32_t>, max_color_targets> owner_;  // per slot
};

}  // namespace strata::pipeline
