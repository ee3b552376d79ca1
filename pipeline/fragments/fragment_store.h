// pipeline/fragments/fragment_store.h - a region's fragments as its first draw saw them, for the draws that follow: what replay stands on.
//
// Rule     Batches are kept whole and in submission order, after texture and MASK: what later stages see of a batch does not
//          depend on whether it was rasterized or recalled. A store that would outgrow its limit forgets everything, and its
//          region rasterizes every pass.
// Layout   The arrays of one batch lie one after the other, packed to its count; batches fill chunks of 256 KiB. Batches as the
//          rasterizer made them cost no second sorting and read back in a straight line.
// Tests    tests/pipeline/fragments/fragment_store_test.cpp, sorted_alpha_test.cpp; tests/peeling/execution_test.cpp
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "pipeline/vertices/primitive_range.h"
#include "rasterizer/base/uninitialized.h"
#include "rasterizer/coverage/fragment_batch.h"

namespace strata::pipeline {

class FragmentStore {
  public:
    // Forgets what it holds and takes in batches with the arrays that `needs` names, as long as they fit into `limit` bytes.
    void start(const rasterizer::FragmentNeeds& needs, std::uint64_t limit);
    void append(const rasterizer::FragmentBatch& batch, const rasterizer::Lanes<std::uint32_t>& alive);
    void finish();  // nothing more will come
    void forget();

    [[nodiscard]] bool may_start() const noexcept { return state_ != State::too_large; }
    // Whether the store is complete and holds every array that `needs` names.
    [[nodiscard]] bool serves(const rasterizer::FragmentNeeds& needs) const noexcept;
    [[nodiscard]] std::size_t batches() const noexcept { return batches_.size(); }
    // From now on batches are recalled without colours and depths that `needs` does not name.
    void recall_only(const rasterizer::FragmentNeeds& needs) noexcept { recalled_ = needs; }
    void recall(std::size_t number, rasterizer::FragmentBatch& batch, rasterizer::Lanes<std::uint32_t>& alive) const {
        recall(number, batch, alive, recalled_);
    }
    // `numbers`: whether somebody looks at primitives and positions.
    enum class Numbers : std::uint8_t { no, yes };
    void recall(std::size_t number, rasterizer::FragmentBatch& batch, rasterizer::Lanes<std::uint32_t>& alive,
                const rasterizer::FragmentNeeds& needs, Numbers numbers = Numbers::yes) const;

    // A fragment's place among all of the store: places rise with arrival.
    [[nodiscard]] static constexpr std::uint32_t place(std::size_t batch, std::size_t lane) noexcept {
        return static_cast<std::uint32_t>(batch << 8 | lane);
    }
    // What a fragment with these arrays takes.
    [[nodiscard]] static std::size_t bytes_of(const rasterizer::FragmentNeeds& needs) noexcept;
    [[nodiscard]] std::size_t count(std::size_t number) const noexcept { return batches_[number].count; }
    [[nodiscard]] bool has_dead(std::size_t number) const noexcept { return batches_[number].has_dead; }
    // The least range that holds the primitives of a batch. In later batches neither of its ends is less.
    [[nodiscard]] const PrimitiveRange& primitives(std::size_t number) const noexcept {
        return batches_[number].primitives;
    }
    // The least and the greatest alpha of a batch. NaN where one of them is negative, -0 or NaN, or where no colours are held.
    [[nodiscard]] std::array<float, 2> alpha_ends(std::size_t number) const noexcept;
    [[nodiscard]] const rasterizer::FragmentNeeds& needs() const noexcept { return needs_; }
    // Whether fragments are compared by another code than they store.
    [[nodiscard]] bool has_references_apart() const noexcept { return references_apart_ != 0; }
    // What `needs` names, and `primitive` where it is asked for, of the fragments at `places` to the first lanes of a batch, in
    // this order. Pixels and their positions are the caller's: it knows them.
    void fetch(std::span<const std::uint32_t> places, const rasterizer::FragmentNeeds& needs, Numbers numbers,
               rasterizer::FragmentBatch& batch) const noexcept;

    [[nodiscard]] std::uint64_t used_bytes() const noexcept { return used_chunks_ * std::uint64_t{chunk_bytes}; }
    [[nodiscard]] std::uint64_t bytes() const noexcept { return chunks_.size() * std::uint64_t{chunk_bytes}; }

    static constexpr std::size_t chunk_bytes = std::size_t{256} << 10;  // memory is taken in whole chunks

  private:
    enum class State : std::uint8_t { empty, filling, complete, too_large };
    struct Packed {
        const std::byte* begin;
        std::uint32_t material;
        std::uint16_t count;
        bool has_dead;  // MASK killed some: `alive` stands before the arrays
        PrimitiveRange primitives;
    };

    template <class Visit>
    static void for_each_array(const rasterizer::FragmentNeeds& needs, auto& batch, Visit&& visit);
    template <class Take>
    void for_each_place(std::span<const std::uint32_t> places, std::uint32_t start, std::uint32_t bytes,
                        const Take& take) const noexcept;

    State state_ = State::empty;
    rasterizer::FragmentNeeds needs_, recalled_;
    std::uint64_t limit_ = 0;
    std::uint32_t references_apart_ = 0;  // bits in which any reference code differs from its fragment's stored one
    std::vector<UninitializedVector<std::byte>> chunks_;  // kept from region to region: memory is asked for once
    std::size_t used_chunks_ = 0, used_bytes_ = 0;        // the latter of the last chunk in use
    std::vector<Packed> batches_;
};

}  // namespace strata::pipeline
