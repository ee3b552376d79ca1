// pipeline/fragments/tile_fragments.h - the fragments of a tile: recorded once, in submission order, and read by every
// pass of a peel.
//
// Rule     Fragments have indices 0, 1, 2, ... in submission order, after texture and MASK; fragments killed by MASK
//          have none. With several samples per pixel a "pixel" is an element of the region, and the fragments of each
//          sample are in submission order, those of sample 0 first. Their values are in arrays by index. A record that
//          would exceed its limit is discarded, and its region rasterizes every pass.
// Layout   One array per value; the channels of a colour are stored together, because passes fetch fragments at
//          scattered indices. A coverage mask of samples would be one more array: nothing else here depends on the
//          number of depths per pixel.
// Source   pipeline/reference/execution.md 5.3 and 7.1.
// Tests    tests/pipeline/fragments/tile_fragments_test.cpp; tests/peeling/execution/execution_test.cpp
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "rasterizer/base/uninitialized.h"
#include "rasterizer/coverage/fragment_batch.h"

namespace strata::pipeline {

class TileFragments {
  public:
    // Discards the record and starts one of the values that `needs` names, limited to `limit` bytes.
    void start(const rasterizer::FragmentNeeds& needs, std::uint64_t limit);
    // Adds the alive fragments of a batch.
    void append(const rasterizer::FragmentBatch& batch, const rasterizer::Lanes<std::uint32_t>& alive);
    // For kernels that write values directly (record_rows.h): arrays with room up to `capacity`, null for values that
    // are not recorded, and the number of entries in use. `more_space` accepts the entries written to `from` and
    // returns room for at least one more vector.
    using Color = std::array<float, 4>;
    struct Space {
        std::uint32_t *pixel = nullptr, *primitive = nullptr, *code = nullptr;
        float* shader_z = nullptr;
        Color* color = nullptr;
        std::size_t size = 0, capacity = 0;
    };
    [[nodiscard]] Space more_space(const Space& from);
    void close(std::size_t size);
    // Adds `by` to the pixels of the fragments from index `first` on.
    void move_pixels(std::size_t first, std::uint32_t by) noexcept {
        for (std::size_t i = first; i < size_; ++i) pixel_[i] += by;
    }
    void finish();  // ends the record
    void forget() noexcept;

    [[nodiscard]] bool may_start() const noexcept { return state_ == State::empty || state_ == State::complete; }
    // True if the record is complete and has all values that `needs` names.
    [[nodiscard]] bool serves(const rasterizer::FragmentNeeds& needs) const noexcept;
    // True if such values can be recorded: coordinates, facing and secondary colours cannot.
    [[nodiscard]] static bool records(const rasterizer::FragmentNeeds& needs) noexcept {
        return !needs.texcoord && !needs.facing && !needs.has_extras();
    }
    // Bytes per fragment with these values.
    [[nodiscard]] static std::uint64_t bytes_of(const rasterizer::FragmentNeeds& needs) noexcept;

    [[nodiscard]] std::size_t size() const noexcept { return size_; }
    [[nodiscard]] std::uint64_t bytes() const noexcept { return size_ * bytes_of(needs_); }
    [[nodiscard]] const rasterizer::FragmentNeeds& needs() const noexcept { return needs_; }
    // Arrays by index; a value that is not recorded must not be read.
    [[nodiscard]] std::span<const std::uint32_t> pixel() const noexcept { return {pixel_.data(), size_}; }
    [[nodiscard]] std::span<const std::uint32_t> primitive() const noexcept { return {primitive_.data(), size_}; }
    [[nodiscard]] std::span<const std::uint32_t> code() const noexcept { return {code_.data(), size_}; }
    [[nodiscard]] std::span<const std::uint32_t> exact_code() const noexcept { return {exact_code_.data(), size_}; }
    [[nodiscard]] std::span<const float> shader_z() const noexcept { return {shader_z_.data(), size_}; }
    [[nodiscard]] std::span<const Color> color() const noexcept { return {color_.data(), size_}; }
    [[nodiscard]] std::span<const double> reference_z() const noexcept { return {reference_z_.data(), size_}; }
    [[nodiscard]] std::span<const std::uint32_t> reference_code() const noexcept {
        return {reference_code_.data(), size_};
    }
    // The largest difference by which a compared code exceeds the same fragment's stored code.
    [[nodiscard]] std::uint32_t reference_lead() const noexcept { return reference_lead_; }
    // True if every colour is in [0, 1024], every alpha in [0, 1] and none is -0: MAX of such values does not depend on
    // the order.
    [[nodiscard]] bool has_plain_colors();

    // Writes the values that `needs` names, of the fragments with indices `places`, to the first lanes of a batch in
    // this order. The caller sets pixels and their positions.
    void fetch(std::span<const std::uint32_t> places, const rasterizer::FragmentNeeds& needs,
               rasterizer::FragmentBatch& batch) const noexcept;

    // Reads the record in batches, in submission order, each pixel at most once per batch. `stamp` has one entry per
    // pixel, initially 0, and belongs to the reader.
    struct Reading {
        std::size_t next = 0;
        std::uint32_t batch = 0;
        std::vector<std::uint32_t> stamp;
    };
    [[nodiscard]] std::span<const std::uint32_t> next_indices(Reading& reading,
                                                              rasterizer::Lanes<std::uint32_t>& places) const;

  private:
    enum class State : std::uint8_t { empty, filling, complete, too_large };

    void make_room(std::size_t more);
    [[nodiscard]] bool fits(std::size_t size);

    State state_ = State::empty;
    rasterizer::FragmentNeeds needs_;
    std::uint64_t limit_ = 0;
    std::size_t size_ = 0;
    std::uint32_t reference_lead_ = 0;
    enum class Colors : std::uint8_t { unknown, plain, other } colors_ = Colors::unknown;
    UninitializedVector<std::uint32_t> pixel_, primitive_, code_, exact_code_, reference_code_;
    UninitializedVector<float> shader_z_;
    UninitializedVector<double> reference_z_;
    UninitializedVector<Color> color_;
};

}  // namespace strata::pipeline
