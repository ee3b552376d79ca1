// peeling/programs/fixed_passes/atomic_entries.h - per-pixel arrays of k entries in which fragment programs collect the
// k nearest fragments by atomic minimum: a first pass collects depth codes, a second one their colours (atomic_loop,
// hybrid_transparency).
//
// Rule     After the first pass a pixel's entries are its k least depth codes in ascending order, whatever the
//          submission order. Fragments of equal codes share an entry, which keeps the colour of the last one submitted
//          (EqualCodes::share), or take an entry each, in submission order (EqualCodes::apart).
// Source   peeling/reference/algorithms.md 21.
// Tests    tests/peeling/algorithms/atomic_loop_test.cpp
#pragma once
#include <algorithm>
#include <utility>
#include <vector>

#include "peeling/programs/programs.h"
#include "pipeline/region/region.h"

namespace strata::peeling {
inline namespace strict {

enum class EqualCodes : std::uint8_t { share, apart };

// The entries of all pixels of a region: k codes and k colours per pixel. `pixel` is an index in the region.
class AtomicEntries {
  public:
    AtomicEntries(const pipeline::Region& region, int k, EqualCodes equal)
        : k_{static_cast<std::size_t>(k)},
          equal_{equal},
          codes_(region.rect().area() * k_, empty),
          colors_(codes_.size()),
          taken_(codes_.size()) {}

    // The loop of atomicMin in the program of the first pass: a code replaces the first greater one, and the replaced
    // code moves on to the next entry.
    void add_code(std::uint32_t pixel, std::uint32_t code) {
        for (std::size_t e = pixel * k_; e < (pixel + 1) * k_; ++e) {
            const std::uint32_t before = std::exchange(codes_[e], std::min(codes_[e], code));
            if (before == empty || (before == code && equal_ == EqualCodes::share)) return;
            code = std::max(before, code);
        }
    }
    // Stores the colour in the entry of the fragment's code. Returns false if there is none: the fragment belongs to
    // the tail (tail.h).
    bool add_color(std::uint32_t pixel, std::uint32_t code, const pipeline::Rgba& color) {
        for (std::size_t e = pixel * k_; e < (pixel + 1) * k_ && codes_[e] <= code; ++e) {
            if (codes_[e] != code || (equal_ == EqualCodes::apart && taken_[e])) continue;
            taken_[e] = true;
            colors_[e] = color;
            return true;
        }
        return false;
    }
    // Composites the entries from the nearest on, in binary32: C += T (a c), T *= 1 - a, where T is the transmittance.
    // Returns (C, T).
    [[nodiscard]] pipeline::Rgba composite(std::uint32_t pixel) const {
        pipeline::Rgba all{0, 0, 0, 1};
        for (std::size_t e = pixel * k_; e < (pixel + 1) * k_ && codes_[e] != empty; ++e) {
            const float a = colors_[e][3];
            for (pipeline::Rgba::length_type c = 0; c < 3; ++c) all[c] = all[c] + all[3] * (colors_[e][c] * a);
            all[3] = all[3] * (1.0f - a);
        }
        return all;
    }

  private:
    static constexpr std::uint32_t empty = ~0u;  // above every code

    std::size_t k_;
    EqualCodes equal_;
    std::vector<std::uint32_t> codes_;
    std::vector<pipeline::Rgba> colors_;
    std::vector<bool> taken_;
};

}  // namespace strict
}  // namespace strata::peeling
