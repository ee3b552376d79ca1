// pipeline/frame/trace.h - the sequence of fragments and layers that each pixel of a region composited, within a memory
// limit.
//
// Rule     A trace that would exceed its memory is discarded, marked as incomplete and not continued, because a partial
//          trace is useless.
// Layout   Chunks of 16 KiB, reused from region to region, so that no entry moves and memory is allocated once.
// Tests    tests/pipeline/region/trace_test.cpp
#pragma once
#include <algorithm>
#include <cstdint>
#include <memory>
#include <vector>

#include "pipeline/frame/pass.h"

namespace strata::pipeline {

// One step of a pixel's compositing; see Outputs::side.
struct TraceEntry {
    std::uint32_t pixel = 0, key = 0, primitive = 0;
    Side side = Side::none;
    bool is_fragment = false;  // true: `primitive` is valid; false: a layer, which has only a key
};

class Trace {
  public:
    // Discards all entries; then stores up to `bytes` of entries.
    void start(std::uint64_t bytes) noexcept {
        limit_ = static_cast<std::size_t>(std::min<std::uint64_t>(bytes / sizeof(TraceEntry), most_entries));
        clear();
    }
    void clear() noexcept {
        is_complete_ = true;
        size_ = 0;
        room_ = std::min(limit_, chunks_.size() * chunk_entries);
    }
    // False if the trace would have exceeded its memory; it is then empty.
    [[nodiscard]] bool is_complete() const noexcept { return is_complete_; }

    void push_back(const TraceEntry& entry) {
        if (size_ == room_ && !grow()) return;
        (*this)[size_++] = entry;
    }
    // Discards the entries from index `size` on. Precondition: `size` is at most size().
    void shorten(std::size_t size) noexcept { size_ = std::min(size_, size); }

    [[nodiscard]] std::size_t size() const noexcept { return size_; }
    [[nodiscard]] TraceEntry& operator[](std::size_t i) noexcept {
        return chunks_[i / chunk_entries][i % chunk_entries];
    }
    [[nodiscard]] const TraceEntry& operator[](std::size_t i) const noexcept {
        return chunks_[i / chunk_entries][i % chunk_entries];
    }

  private:
    static constexpr std::size_t chunk_entries = 1024;
    static constexpr std::size_t most_entries = ~std::uint32_t{0};  // indices have 32 bits
    static_assert(sizeof(TraceEntry) == 16);

    [[nodiscard]] bool grow() {
        if (size_ >= limit_) {
            is_complete_ = false;
            size_ = room_ = limit_ = 0;
            return false;
        }
        chunks_.push_back(std::make_unique<TraceEntry[]>(chunk_entries));
        room_ = std::min(limit_, chunks_.size() * chunk_entries);
        return true;
    }

    std::size_t limit_ = most_entries;
    std::size_t size_ = 0, room_ = 0;  // room_: number of entries for which memory is allocated
    bool is_complete_ = true;
    std::vector<std::unique_ptr<TraceEntry[]>> chunks_;
};

}  // namespace strata::pipeline
