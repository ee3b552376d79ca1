// pipeline/fragments/fragment_store.cpp - packing of batches and unpacking, by one list of arrays (execution.md 5.3).
//
// Numbers  All arrays of a fragment take 129 bytes together, so a batch of 256 takes 33,024 bytes at most and fits into a
//          fresh chunk. Packed arrays have no alignment: they are copied as bytes.
#include "pipeline/fragments/fragment_store.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cstring>
#include <limits>
#include <utility>

namespace strata::pipeline {

using rasterizer::FragmentBatch;
using rasterizer::FragmentNeeds;
using rasterizer::Lanes;

namespace {

using Colors = std::array<Lanes<float>, 4>;

// Whether `array` of a batch holds colours or depths that `needs` does not name. Few passes look at the other arrays, and
// none of the many passes of a peel: they are taken wherever they are held.
bool is_left_out(const FragmentBatch& batch, const FragmentNeeds& needs, const void* array) noexcept {
    const bool is_reference = array == &batch.reference_z || array == &batch.reference_code;
    return (array == &batch.color && !needs.color) || (array == &batch.code && !needs.code) ||
           (array == &batch.shader_z && !needs.shader_z) || (is_reference && !needs.reference);
}

// What a fragment takes of an array. The channels of a colour lie together: passes that fetch fragments from here and there find
// them in one place.
template <class T>
constexpr std::uint32_t bytes_in(const Lanes<T>&) noexcept {
    return sizeof(T);
}
constexpr std::uint32_t bytes_in(const Colors&) noexcept { return 4 * sizeof(float); }

template <class T>
void pack(const Lanes<T>& array, std::size_t count, std::byte* to) noexcept {
    std::memcpy(to, array.data(), count * sizeof(T));
}
void pack(const Colors& colors, std::size_t count, std::byte* to) noexcept {
    for (std::size_t i = 0; i < count; ++i) {
        const std::array one{colors[0][i], colors[1][i], colors[2][i], colors[3][i]};
        std::memcpy(to + i * sizeof(one), one.data(), sizeof(one));
    }
}

// One fragment's, to lane i.
template <class T>
void take(const std::byte* from, std::size_t i, Lanes<T>& array) noexcept {
    std::memcpy(&array[i], from, sizeof(T));
}
void take(const std::byte* from, std::size_t i, Colors& colors) noexcept {
    std::array<float, 4> one;
    std::memcpy(one.data(), from, sizeof(one));
    for (std::size_t c = 0; c < 4; ++c) colors[c][i] = one[c];
}

template <class T>
void unpack(const std::byte* from, std::size_t count, Lanes<T>& array) noexcept {
    std::memcpy(array.data(), from, count * sizeof(T));
}
void unpack(const std::byte* from, std::size_t count, Colors& colors) noexcept {
    for (std::size_t i = 0; i < count; ++i) take(from + i * bytes_in(colors), i, colors);
}

}  // namespace

// Visits the arrays of `batch` that `needs` names, in the order in which they are packed.
template <class Visit>
void FragmentStore::for_each_array(const FragmentNeeds& needs, auto& batch, Visit&& visit) {
    visit(batch.pixel);
    visit(batch.x);
    visit(batch.y);
    visit(batch.primitive);
    if (needs.shader_z) visit(batch.shader_z);
    if (needs.code) visit(batch.code);
    if (needs.exact_code) visit(batch.exact_code);
    if (needs.color) visit(batch.color);
    if (needs.texcoord)
        for (auto& coordinate : batch.texcoord) visit(coordinate);
    if (needs.reference) {
        visit(batch.reference_z);
        visit(batch.reference_code);
    }
    if (needs.facing) visit(batch.front_facing);
    for (std::size_t u = 0; needs.units != 0 && u < rasterizer::texture_units; ++u)
        for (std::size_t c = 0; c < 4; ++c)
            if (rasterizer::names(needs.units, u, c)) visit(batch.unit[u][c]);
}

std::size_t FragmentStore::bytes_of(const FragmentNeeds& needs) noexcept {
    static const FragmentBatch shape{};         // only the types of its arrays are looked at
    std::size_t bytes = sizeof(std::uint32_t);  // `alive`, whether it is kept or not
    for_each_array(needs, shape, [&](const auto& array) { bytes += bytes_in(array); });
    return bytes;
}

void FragmentStore::start(const FragmentNeeds& needs, std::uint64_t limit) {
    forget();
    needs_ = recalled_ = needs;
    limit_ = limit;
    references_apart_ = 0;
    state_ = State::filling;
}

// Chunks stay allocated: the next region fills them again.
void FragmentStore::forget() {
    state_ = State::empty;
    used_chunks_ = used_bytes_ = 0;
    batches_.clear();
}

// A store that grew too large stays so until it is forgotten: the region does not try to fill it again.
void FragmentStore::finish() {
    if (state_ == State::filling) state_ = State::complete;
}

void FragmentStore::append(const FragmentBatch& batch, const Lanes<std::uint32_t>& alive) {
    if (state_ != State::filling) return;
    const auto count = static_cast<std::size_t>(batch.count);
    if (used_chunks_ == 0 || used_bytes_ + count * bytes_of(needs_) > chunk_bytes) {
        // The limit counts whole chunks. One batch too much ends the store: half of a list cannot be replayed.
        if ((used_chunks_ + 1) * chunk_bytes > limit_) {
            forget();
            state_ = State::too_large;
            return;
        }
        if (used_chunks_ == chunks_.size()) chunks_.emplace_back(std::size_t{chunk_bytes});
        ++used_chunks_;
        used_bytes_ = 0;
    }
    std::byte* at = chunks_[used_chunks_ - 1].data() + used_bytes_;
    std::uint32_t living = ~0u, least = ~0u, greatest = 0;  // loops that become vectors
    for (std::size_t i = 0; i < count; ++i) {
        living &= alive[i];
        least = std::min(least, batch.primitive[i]);
        greatest = std::max(greatest, batch.primitive[i]);
    }
    const bool has_dead = living == 0;
    for (std::size_t i = 0; needs_.reference && needs_.code && i < count; ++i)
        references_apart_ |= batch.reference_code[i] ^ batch.code[i];
    const auto append_array = [&](const auto& array) {
        pack(array, count, at);
        at += count * bytes_in(array);
    };
    // In most batches MASK kills nothing: `alive` is kept only where it is not all ~0.
    if (has_dead) append_array(alive);
    batches_.push_back({at, batch.material, static_cast<std::uint16_t>(count), has_dead, {least, greatest + 1}});
    for_each_array(needs_, batch, append_array);
    used_bytes_ = static_cast<std::size_t>(at - chunks_[used_chunks_ - 1].data());
}

bool FragmentStore::serves(const FragmentNeeds& needs) const noexcept {
    const auto has = [](bool held, bool needed) { return held || !needed; };
    return state_ == State::complete && has(needs_.shader_z, needs.shader_z) && has(needs_.code, needs.code) &&
           has(needs_.exact_code, needs.exact_code) && has(needs_.color, needs.color) &&
           has(needs_.texcoord, needs.texcoord) && has(needs_.facing, needs.facing) &&
           has(needs_.reference, needs.reference) && (needs.units & ~needs_.units) == 0;
}

void FragmentStore::recall(std::size_t number, FragmentBatch& batch, Lanes<std::uint32_t>& alive,
                           const FragmentNeeds& needs, Numbers numbers) const {
    assert(state_ == State::complete && number < batches_.size());
    const Packed& packed = batches_[number];
    const std::byte* at = packed.begin;
    const auto is_skipped = [&](const void* array) {
        return numbers == Numbers::no && (array == &batch.primitive || array == &batch.x || array == &batch.y);
    };
    const auto recall_array = [&](auto& array) {
        if (!is_skipped(&array) && !is_left_out(batch, needs, &array)) unpack(at, packed.count, array);
        at += packed.count * bytes_in(array);
    };
    batch.count = packed.count;
    batch.material = packed.material;
    if (packed.has_dead)
        unpack(at - packed.count * bytes_in(alive), packed.count, alive);
    else
        std::fill_n(alive.begin(), packed.count, ~0u);
    for_each_array(needs_, batch, recall_array);
}

// Floats of no sign rise with their bits, and NaN lies above all of them; those with a sign are negative numbers as integers, too.
std::array<float, 2> FragmentStore::alpha_ends(std::size_t number) const noexcept {
    constexpr float unknown = std::numeric_limits<float>::quiet_NaN();
    if (!needs_.color) return {unknown, unknown};
    static const FragmentBatch shape{};
    const Packed& packed = batches_[number];
    const std::byte* alpha = packed.begin + 3 * sizeof(float);
    bool is_before = true;
    for_each_array(needs_, shape, [&](const auto& array) {
        is_before &= static_cast<const void*>(&array) != &shape.color;
        if (is_before) alpha += packed.count * bytes_in(array);
    });
    constexpr std::int32_t infinity = 0x7f800000;
    std::int32_t least = std::numeric_limits<std::int32_t>::max(), greatest = 0;
    for (std::size_t i = 0; i < packed.count; ++i) {
        std::int32_t bits;
        std::memcpy(&bits, alpha + i * bytes_in(shape.color), sizeof(bits));
        least = std::min(least, bits);
        greatest = std::max(greatest, bits);
    }
    if (least < 0 || greatest > infinity) return {unknown, unknown};
    return {std::bit_cast<float>(least), std::bit_cast<float>(greatest)};
}

// Calls `take` with the number of each place and where its fragment lies in the array that begins where fragments have `start` bytes
// before it, and has `bytes` of each. Memory is asked for all places of a batch before any is taken: stores seldom fit into the second
// cache, and fragments lie here and there.
template <class Take>
void FragmentStore::for_each_place(std::span<const std::uint32_t> places, std::uint32_t start, std::uint32_t bytes,
                                   const Take& take) const noexcept {
    std::array<const std::byte*, rasterizer::batch_capacity> at;
    const Packed* const batches = batches_.data();
    for (std::size_t i = 0; i < places.size(); ++i) {
        const Packed& packed = batches[places[i] >> 8];
        at[i] = packed.begin + (packed.count * start + (places[i] & 0xff) * bytes);
        __builtin_prefetch(at[i]);
    }
    for (std::size_t i = 0; i < places.size(); ++i) take(i, at[i]);
}

// Array by array: where a batch's array begins follows from its count and from the bytes that a fragment has before it.
void FragmentStore::fetch(std::span<const std::uint32_t> places, const FragmentNeeds& needs, Numbers numbers,
                          FragmentBatch& batch) const noexcept {
    const auto is_skipped = [&](const void* array) {
        return array == &batch.pixel || array == &batch.x || array == &batch.y ||
               (array == &batch.primitive && numbers == Numbers::no) || is_left_out(batch, needs, array);
    };
    std::uint32_t before = 0;
    for_each_array(needs_, batch, [&](auto& array) {
        const std::uint32_t start = std::exchange(before, before + bytes_in(array));
        if (is_skipped(&array)) return;
        for_each_place(places, start, bytes_in(array),
                       [&array](std::size_t i, const std::byte* from) { take(from, i, array); });
    });
}

}  // namespace strata::pipeline
