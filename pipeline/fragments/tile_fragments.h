// pipeline/fragments/tile_fragments.h - the fragments of a tile: recorded once, in submission order, and read by every
// pass of a peel.
//
// Rule     A fragment is a place: 0, 1, 2, ... in submission order, after texture and MASK; what MASK kills has none.
//          Its values stand in arrays by place. A record that would outgrow its limit forgets everything, and its
//          region rasterizes every pass.
// Layout   One array a value; the channels of a colour together, for passes fetch fragments from here and there. A
//          coverage mask of samples would be one array more: nothing else here depends on how many depths a pixel has.
// Source   execution.md 5.3 and 7.1.
// Tests    tests/pipeline/fragments/tile_fragments_test.cpp; tests/peeling/execution_test.cpp
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
    // Forgets what it holds and takes in the values that `needs` names, as long as they fit into `limit` bytes.
    void start(const rasterizer::FragmentNeeds& needs, std::uint64_t limit);
    // The living fragments of a batch.
    void append(const rasterizer::FragmentBatch& batch, const rasterizer::Lanes<std::uint32_t>& alive);
    // For kernels that write values by themselves (record_rows.h): arrays with places up to `capacity`, null where a
    // value is not held, and how many are taken. `more_space` takes what `from` has got, and gives room for at least
    // one more vector.
    using Color = std::array<float, 4>;
    struct Space {
        std::uint32_t *pixel = nullptr, *primitive = nullptr, *code = nullptr;
        float* shader_z = nullptr;
        Color* color = nullptr;
        std::size_t size = 0, capacity = 0;
    };
    [[nodiscard]] Space more_space(const Space& from);
    void close(std::size_t size);
    void finish();  // nothing more will come
    void forget() noexcept;

    [[nodiscard]] bool may_start() const noexcept { return state_ == State::empty || state_ == State::complete; }
    // Whether it is complete and holds all that `needs` names.
    [[nodiscard]] bool serves(const rasterizer::FragmentNeeds& needs) const noexcept;
    // Whether such values are recorded at all: coordinates and facing are not.
    [[nodiscard]] static bool records(const rasterizer::FragmentNeeds& needs) noexcept {
        return !needs.texcoord && !needs.facing && needs.units == 0;
    }
    // What a fragment with these values takes.
    [[nodiscard]] static std::uint64_t bytes_of(const rasterizer::FragmentNeeds& needs) noexcept;

    [[nodiscard]] std::size_t size() const noexcept { return size_; }
    [[nodiscard]] std::uint64_t bytes() const noexcept { return size_ * bytes_of(needs_); }
    [[nodiscard]] const rasterizer::FragmentNeeds& needs() const noexcept { return needs_; }
    // By place; values that are not held are not to be looked at.
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
    // The most by which a compared code exceeds its fragment's own.
    [[nodiscard]] std::uint32_t reference_lead() const noexcept { return reference_lead_; }
    // Whether every colour is in [0, 1024] and every alpha in [0, 1], none of them -0: MAX of such values knows no
    // order.
    [[nodiscard]] bool has_plain_colors();

    // The values that `needs` names of the fragments at `places` to the first lanes of a batch, in this order; pixels
    // and their positions are the caller's.
    void fetch(std::span<const std::uint32_t> places, const rasterizer::FragmentNeeds& needs,
               rasterizer::FragmentBatch& batch) const noexcept;

    // Takes them in batches, in submission order, no pixel twice in one. `stamp`, one a pixel, are 0 at first and the
    // reader's own.
    struct Reading {
        std::size_t next = 0;
        std::uint32_t batch = 0;
        std::vector<std::uint32_t> stamp;
    };
    [[nodiscard]] std::span<const std::uint32_t> next_places(Reading& reading,
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
