// pipeline/fragments/arena.h - memory that a region takes in pieces and gives back as a whole; kept from region to region.
#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

#include "rasterizer/base/uninitialized.h"

namespace strata::pipeline {

// Used by one thread at a time. Pieces stay where they are until reset: memory is never moved, and a piece that does
// not fit into the last block opens a new one.
class Arena {
  public:
    // Uninitialised; for plain values only. Lives until reset.
    template <class T>
    requires std::is_trivially_copyable_v<T>
    [[nodiscard]] std::span<T> take(std::size_t count) {
        const std::size_t bytes = (count * sizeof(T) + alignment - 1) / alignment * alignment;
        if (blocks_.empty() || used_ + bytes > blocks_.back().size) grow(bytes);
        T* const begin = reinterpret_cast<T*>(blocks_.back().begin() + used_);
        used_ += bytes;
        return {begin, count};
    }

    // Everything is free again. What took several blocks gets one of their size the next time.
    void reset() {
        std::size_t total = 0;
        for (const Block& block : blocks_) total += block.size;
        if (blocks_.size() > 1) {
            blocks_.clear();
            blocks_.emplace_back(total);
        }
        used_ = 0;
    }

  private:
    // 64 bytes: a cache line, and the widest vector. A block has at least 1 MiB, so that most regions need only one.
    static constexpr std::size_t alignment = 64, least_block = std::size_t{1} << 20;

    // The memory is longer than asked for by one alignment: an allocator promises less than 64 bytes.
    struct Block {
        explicit Block(std::size_t bytes) : size{bytes}, memory(bytes + alignment) {}
        [[nodiscard]] std::byte* begin() {
            const auto address = reinterpret_cast<std::uintptr_t>(memory.data());
            return memory.data() + (alignment - address % alignment) % alignment;
        }
        std::size_t size;
        UninitializedVector<std::byte> memory;
    };

    void grow(std::size_t bytes) {
        blocks_.emplace_back(std::max(bytes, least_block));
        used_ = 0;
    }

    std::vector<Block> blocks_;
    std::size_t used_ = 0;  // of the last block
};

}  // namespace strata::pipeline
