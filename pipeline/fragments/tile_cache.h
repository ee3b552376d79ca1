// pipeline/fragments/tile_cache.h - colour targets while a pass blends into them, as BlendStorage::cached_tiles has it:
// binary32, rounded when a tile is put back.
//
// Rule     The frame has tiles of 64 x 64 pixels, the cache 50 places; tile (x, y) goes to place (x + 5 y) mod 50. A
//          fragment that passes its tests fetches its tile; in a pass without tests so does one that a program
//          discards. The tile that had the place is put back: each channel rounded to the target's format. What is
//          fetched is the value of a code; what is blended is neither rounded nor, on 8-bit targets, made a code, but
//          clamped to 0..1 before and after the blend. The end of a pass puts everything back.
// Source   fragment-stages.md 9.5; mesa-rasterizers.md 3.5.
// Numbers  A value is put back only where a fragment was blended since it was fetched, so that nothing else changes.
//          Tiles share a place in frames of more than 5 x 10 tiles: there a region that is not the frame throws
//          NeedsFrame at the first pixel that is blended twice, for what puts its tile back lies elsewhere.
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

// Lanes of a batch at one sample: those that are alive are blended, those that are fetched have their tile fetched.
struct CachedLanes {
    const FragmentBatch& batch;
    const ColorLanes& color;
    const Lanes<std::uint32_t>& alive;
    const Lanes<std::uint32_t>& fetched;
    int sample;
};

// Where each pixel of a region has its tile, and which place that takes.
class CachedTiles {
  public:
    static constexpr int side = 64, places = 50;

    CachedTiles(const rasterizer::Rect& region, const rasterizer::Rect& frame);

    [[nodiscard]] std::size_t count() const noexcept { return static_cast<std::size_t>(across_) * down_; }
    [[nodiscard]] std::uint32_t tile_of(std::uint32_t pixel) const noexcept;
    [[nodiscard]] std::size_t place_of(std::uint32_t tile) const noexcept;
    // Whether another tile of the frame wants that tile's place.
    [[nodiscard]] bool is_shared(std::uint32_t tile) const noexcept { return wanted_[place_of(tile)] > 1; }

  private:
    rasterizer::Rect region_;
    int x0_, y0_;  // of the region, in pixels of the frame
    std::uint32_t across_, down_;
    std::array<std::uint32_t, places> wanted_{};  // how many tiles want a place
};

// Where a target's codes lie: a Texels for each sample.
struct CachedPlanes {
    Format format;
    std::size_t pixels;
    std::vector<Texels> samples;
};

// One colour target of a pass.
class CachedTarget {
  public:
    CachedTarget(const CachedTiles& tiles, const DeviceProfile& profile, const Blend& blending, CachedPlanes planes);

    // Lanes [first, end) are blended; no place is wanted by two tiles of them.
    void blend(const CachedLanes& lanes, int first, int end);
    void put_back(std::uint32_t tile);
    void put_back();
    // Whether a pixel has been blended since its tile was fetched.
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
    // The pixels of a tile that are held, of one sample.
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
    std::vector<std::array<float, 4>> values_;  // of pixels that are held
    std::vector<std::uint8_t> held_;
    std::vector<std::vector<std::uint32_t>> held_pixels_;
    ColorCodes codes_{};  // of the lanes under way
};

// All targets of one pass, which fetch and put back together.
class TileCache {
  public:
    TileCache(const rasterizer::Rect& region, const rasterizer::Rect& frame);

    // Whether a blend sees the cache: minima and maxima of what is rounded are the rounded ones, and binary32 is not.
    [[nodiscard]] static bool knows(const Blend& blending, Format format) noexcept;
    void hold(std::size_t number, const DeviceProfile& profile, const Blend& blending, CachedPlanes planes) {
        targets_[number].emplace(tiles_, profile, blending, std::move(planes));
    }
    [[nodiscard]] bool holds(std::size_t number) const noexcept { return targets_[number].has_value(); }
    void blend(std::size_t number, const CachedLanes& lanes);
    void close();

  private:
    void take_place(CachedTarget& target, std::size_t number, std::uint32_t tile);

    CachedTiles tiles_;
    bool is_frame_;  // the region
    std::array<std::optional<CachedTarget>, max_color_targets> targets_;
    static constexpr std::uint32_t no_tile = ~0u;
    std::array<std::array<std::uint32_t, CachedTiles::places>, max_color_targets> owner_;
};

}  // namespace strata::pipeline
