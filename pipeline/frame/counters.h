// pipeline/frame/counters.h - the counters of a run: exact integers that depend on neither threads nor tiles.
#pragma once
#include <cstdint>

namespace strata::pipeline {

// Fragments of the geometry passes by their fate, and bytes transferred between stages and targets as if there were no
// cache (loads of programs, tests, blending, clears, copies; full-screen passes included).
struct Counters {
    std::uint64_t fragments_rasterized = 0;
    std::uint64_t discarded = 0;     // by a fragment program
    std::uint64_t alpha_killed = 0;  // alpha test, including a material's MASK cutoff
    std::uint64_t stencil_killed = 0;
    std::uint64_t depth_killed = 0;
    std::uint64_t blended = 0;  // reached the render targets
    std::uint64_t bytes_read = 0, bytes_written = 0;
    friend bool operator==(const Counters&, const Counters&) = default;

    constexpr Counters& operator+=(const Counters& o) noexcept {
        fragments_rasterized += o.fragments_rasterized;
        discarded += o.discarded;
        alpha_killed += o.alpha_killed;
        stencil_killed += o.stencil_killed;
        depth_killed += o.depth_killed;
        blended += o.blended;
        bytes_read += o.bytes_read;
        bytes_written += o.bytes_written;
        return *this;
    }
    [[nodiscard]] friend constexpr Counters operator+(Counters a, const Counters& b) noexcept { return a += b; }
};

struct PassCount {
    int geometry = 0, full_screen = 0, copies = 0;
    friend bool operator==(const PassCount&, const PassCount&) = default;

    PassCount& operator+=(const PassCount& o) noexcept {
        geometry += o.geometry;
        full_screen += o.full_screen;
        copies += o.copies;
        return *this;
    }
};

}  // namespace strata::pipeline
