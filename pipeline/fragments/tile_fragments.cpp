// pipeline/fragments/tile_fragments.cpp - records a tile's fragments and reads them back in batches (tile_fragments.h).
#include "pipeline/fragments/tile_fragments.h"

#include <algorithm>
#include <bit>
#include <cassert>

namespace strata::pipeline {

using rasterizer::FragmentBatch;
using rasterizer::FragmentNeeds;
using rasterizer::Lanes;

namespace {

// Kernels write whole vectors, also past the last fragment.
constexpr std::size_t spare_places = 16;

// An array that grows leaves its old memory in the allocator, which keeps it (uninitialized.h). Therefore it reserves
// at once what the limit admits, of which only written pages use memory, up to a number of fragments that few tiles
// have.
constexpr std::size_t most_at_once = std::size_t{1} << 20;

template <class T>
void grow(UninitializedVector<T>& array, std::size_t wanted, std::size_t admitted) {
    if (array.size() < wanted) array.resize(std::max({wanted, 2 * array.size(), std::min(admitted, most_at_once)}));
}

// False for -0, NaN and negative values.
[[nodiscard]] bool is_at_most(float value, float most) noexcept {
    return std::bit_cast<std::uint32_t>(value) <= std::bit_cast<std::uint32_t>(most);
}

// The indices of the alive lanes of a batch.
struct Living {
    Lanes<std::uint16_t> lane;
    std::size_t count = 0;

    Living(const FragmentBatch& batch, const Lanes<std::uint32_t>& alive) noexcept {
        for (std::size_t i = 0; i < static_cast<std::size_t>(batch.count); ++i) {
            lane[count] = static_cast<std::uint16_t>(i);
            count += alive[i] & 1u;
        }
    }
    template <class T>
    void copy(const Lanes<T>& from, T* to) const noexcept {
        for (std::size_t k = 0; k < count; ++k) to[k] = from[lane[k]];
    }
};

template <class T>
void take(std::span<const std::uint32_t> places, const T* from, Lanes<T>& to) noexcept {
    for (std::size_t i = 0; i < places.size(); ++i) to[i] = from[places[i]];
}

}  // namespace

void TileFragments::start(const FragmentNeeds& needs, std::uint64_t limit) {
    assert(records(needs));
    forget();
    needs_ = needs;
    limit_ = limit;
    state_ = State::filling;
}

// The memory is kept for the next tile.
void TileFragments::forget() noexcept {
    state_ = State::empty;
    size_ = 0;
    reference_lead_ = 0;
    colors_ = Colors::unknown;
}

// A record that exceeded its limit stays invalid until it is discarded, so its region does not try to record again.
void TileFragments::finish() {
    if (state_ == State::filling) state_ = State::complete;
}

std::uint64_t TileFragments::bytes_of(const FragmentNeeds& needs) noexcept {
    constexpr std::uint64_t word = sizeof(std::uint32_t);
    const auto words = [](bool is_held, std::uint64_t count) { return is_held ? word * count : 0; };
    return 2 * word + words(needs.code, 1) + words(needs.exact_code, 1) + words(needs.shader_z, 1) +
           words(needs.color, 4) + words(needs.reference, 3);
}

bool TileFragments::serves(const FragmentNeeds& needs) const noexcept {
    return state_ == State::complete && (needs_ | needs) == needs_;
}

void TileFragments::make_room(std::size_t more) {
    const std::size_t wanted = size_ + more + spare_places;
    const auto admitted = static_cast<std::size_t>(limit_ / bytes_of(needs_)) + more + spare_places;
    grow(pixel_, wanted, admitted);
    grow(primitive_, wanted, admitted);
    if (needs_.code) grow(code_, wanted, admitted);
    if (needs_.exact_code) grow(exact_code_, wanted, admitted);
    if (needs_.shader_z) grow(shader_z_, wanted, admitted);
    if (needs_.color) grow(color_, wanted, admitted);
    if (needs_.reference) grow(reference_z_, wanted, admitted), grow(reference_code_, wanted, admitted);
}

bool TileFragments::fits(std::size_t size) {
    if (size * bytes_of(needs_) <= limit_) return true;
    forget();
    state_ = State::too_large;
    return false;
}

// A record that has exceeded its limit returns the same memory again and again: what is written there is not used.
TileFragments::Space TileFragments::more_space(const Space& from) {
    constexpr std::size_t at_once = 4096;
    close(from.size);
    make_room(at_once);
    return {.pixel = pixel_.data(),
            .primitive = primitive_.data(),
            .code = needs_.code ? code_.data() : nullptr,
            .shader_z = needs_.shader_z ? shader_z_.data() : nullptr,
            .color = needs_.color ? color_.data() : nullptr,
            .size = size_,
            .capacity = size_ + at_once};
}

void TileFragments::close(std::size_t size) {
    if (state_ == State::filling && fits(size)) size_ = size;
}

void TileFragments::append(const FragmentBatch& batch, const Lanes<std::uint32_t>& alive) {
    if (state_ != State::filling) return;
    const Living living{batch, alive};
    if (!fits(size_ + living.count)) return;
    make_room(living.count);
    living.copy(batch.pixel, pixel_.data() + size_);
    living.copy(batch.primitive, primitive_.data() + size_);
    if (needs_.code) living.copy(batch.code, code_.data() + size_);
    if (needs_.exact_code) living.copy(batch.exact_code, exact_code_.data() + size_);
    if (needs_.shader_z) living.copy(batch.shader_z, shader_z_.data() + size_);
    for (std::size_t k = 0; needs_.color && k < living.count; ++k)
        for (std::size_t c = 0; c < 4; ++c) color_[size_ + k][c] = batch.color[c][living.lane[k]];
    if (needs_.reference) {
        living.copy(batch.reference_z, reference_z_.data() + size_);
        living.copy(batch.reference_code, reference_code_.data() + size_);
    }
    for (std::size_t k = size_; needs_.reference && needs_.code && k < size_ + living.count; ++k)
        reference_lead_ = std::max(reference_lead_, reference_code_[k] - std::min(reference_code_[k], code_[k]));
    size_ += living.count;
}

bool TileFragments::has_plain_colors() {
    if (colors_ == Colors::unknown) {
        const bool is_plain = needs_.color && std::ranges::all_of(color(), [](const Color& color) {
                                  return is_at_most(color[0], 1024.0f) && is_at_most(color[1], 1024.0f) &&
                                         is_at_most(color[2], 1024.0f) && is_at_most(color[3], 1.0f);
                              });
        colors_ = is_plain ? Colors::plain : Colors::other;
    }
    return colors_ == Colors::plain;
}

void TileFragments::fetch(std::span<const std::uint32_t> places, const FragmentNeeds& needs,
                          FragmentBatch& batch) const noexcept {
    take(places, primitive_.data(), batch.primitive);
    if (needs.code) take(places, code_.data(), batch.code);
    if (needs.exact_code) take(places, exact_code_.data(), batch.exact_code);
    if (needs.shader_z) take(places, shader_z_.data(), batch.shader_z);
    for (std::size_t i = 0; needs.color && i < places.size(); ++i)
        for (std::size_t c = 0; c < 4; ++c) batch.color[c][i] = color_[places[i]][c];
    if (needs.reference) {
        take(places, reference_z_.data(), batch.reference_z);
        take(places, reference_code_.data(), batch.reference_code);
    }
}

std::span<const std::uint32_t> TileFragments::next_indices(Reading& reading, Lanes<std::uint32_t>& places) const {
    ++reading.batch;
    std::size_t count = 0;
    while (reading.next < size_ && count < places.size()) {
        std::uint32_t& last = reading.stamp[pixel_[reading.next]];
        if (last == reading.batch) break;
        last = reading.batch;
        places[count++] = static_cast<std::uint32_t>(reading.next++);
    }
    return {places.data(), count};
}

}  // namespace strata::pipeline
