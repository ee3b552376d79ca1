// pipeline/fragments/fragment_waves.h - the fragments that a pass processes, arranged in waves for the fragment
// program.
//
// Rule     A batch contains a pixel at most once, but a pixel may have several fragments. Therefore the first fragments
//          of all pixels form one wave, the second ones the next, and so on.
// Tests    tests/pipeline/fragments/find_fragments_test.cpp
#pragma once
#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "rasterizer/coverage/fragment_batch.h"

namespace strata::pipeline {

class FragmentWaves {
  public:
    // Pixels, and their entries in SortedLists.
    struct Wave {
        std::vector<std::uint32_t> pixel;
        std::vector<std::uint64_t> entry;
    };

    void start() noexcept {
        for (std::size_t w = 0; w < waves_; ++w) of_[w].pixel.clear(), of_[w].entry.clear();
        waves_ = wave_ = next_ = 0;
    }
    // A wave has at most one entry per pixel.
    void add(std::size_t wave, std::size_t pixel, std::uint64_t entry) {
        if (wave >= waves_) [[unlikely]] {
            waves_ = wave + 1;
            if (of_.size() < waves_) of_.resize(waves_);
        }
        of_[wave].pixel.push_back(static_cast<std::uint32_t>(pixel));
        of_[wave].entry.push_back(entry);
    }
    [[nodiscard]] std::size_t waves() const noexcept { return waves_; }
    [[nodiscard]] const Wave& wave(std::size_t number) const noexcept { return of_[number]; }

    // The next part of the current wave, at most as many as a batch has room for; empty after the last wave.
    struct Part {
        std::size_t wave = 0;
        std::span<const std::uint32_t> pixel{};
        std::span<const std::uint64_t> entry{};
    };
    [[nodiscard]] Part next() noexcept {
        while (wave_ < waves_ && next_ == of_[wave_].pixel.size()) ++wave_, next_ = 0;
        if (wave_ == waves_) return {};
        const Wave& all = of_[wave_];
        const std::size_t first = next_;
        next_ = std::min<std::size_t>(all.pixel.size(), first + rasterizer::batch_capacity);
        return {wave_, std::span{all.pixel}.subspan(first, next_ - first),
                std::span{all.entry}.subspan(first, next_ - first)};
    }

  private:
    std::vector<Wave> of_;
    std::size_t waves_ = 0, wave_ = 0, next_ = 0;
};

}  // namespace strata::pipeline
