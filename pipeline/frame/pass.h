// pipeline/frame/pass.h - one pass as values: its state, and the inputs and outputs of a fragment program.
#pragma once
#include <array>
#include <concepts>
#include <cstdint>
#include <span>

#include "pipeline/device/state.h"
#include "pipeline/frame/selection.h"
#include "pipeline/stages/target.h"
#include "pipeline/vertices/primitive_range.h"

namespace strata::pipeline {

inline constexpr int max_color_targets = 8, max_reads = 8, max_depth_units = 4;

// One of Everitt's sequential depth units (Listing 1): a read-only test against its own depth target, before the depth
// test. The first one that fails discards the fragment. STRATA_depth_units, an emulator extension.
struct DepthUnit {
    Target depth;
    CompareFunc func = CompareFunc::always;
};

// State of one pass, checked against the profile before its first fragment.
struct PassState {
    AlphaTest alpha;
    StencilTest stencil;
    DepthTest depth;
    Target depth_target, stencil_target;
    std::array<Target, max_color_targets> color{};
    std::array<Blend, max_color_targets> blend{};  // unequal equations or factors need has_independent_blend
    std::array<Target, max_reads> reads{};         // readable by the program, only at its own pixel and sample 0
    bool ordered_rmw = false;                      // reads may overlap written targets (STRATA_ordered_rmw)
    std::uint8_t sample_mask = 0xff;  // multisample rasterization off: a fragment covers every masked sample
    std::array<DepthUnit, max_depth_units> depth_units{};
    int depth_unit_count = 0;
    std::array<Target, 4> textures{};  // depth targets that texture units sample at any pixel of the region
    bool replaces_depth = false;       // the program may output another depth (Outputs::depth)
    // For a geometry pass of a frame with per-pixel shading: the program runs once for each pixel of a triangle, after
    // the depth test of every sample (fragment-stages.md 13.9).
    bool once_a_pixel = false;
    rasterizer::FragmentNeeds needs;  // values that the program reads; the stages add their own needs
    std::span<const PrimitiveRange>
        primitives{};             // for a geometry pass: only these, ascending and disjoint; empty: all
    FragmentSelection selection;  // for a geometry pass: the fragments that decide its result
};

// The values that a program may load: the declared reads, gathered at the fragments' own pixels.
class Loads {
  public:
    // Colour target `read` of PassState::reads as binary32 channels; missing channels are 0, a missing alpha is 1.
    [[nodiscard]] const ColorLanes& color(int read) const noexcept { return color_[static_cast<std::size_t>(read)]; }
    // Depth target `read` as codes.
    [[nodiscard]] const Lanes<std::uint32_t>& depth(int read) const noexcept {
        return depth_[static_cast<std::size_t>(read)];
    }

  private:
    friend class Stages;
    std::array<ColorLanes, max_reads> color_;
    std::array<Lanes<std::uint32_t>, max_reads> depth_;
};

// Where a traced fragment is inserted in the composited sequence of its pixel: at the far end (UNDER) or at the near
// end (OVER).
enum class Side : std::uint8_t { none, front, back };

// The results of a program. Fragments start alive; colours are undefined until written, straight or premultiplied as
// the blend state requires.
struct Outputs {
    std::array<ColorLanes, max_color_targets> color;
    Lanes<std::uint32_t> alive;  // ~0 or 0; a program discards with &=
    std::uint64_t tally = 0;     // number of events, as defined by the program

    // For the audit: lane i composites depth key `key[i]` on `side[i]` if it survives the tests. Used if `traced` is
    // set.
    Lanes<Side> side;
    Lanes<std::uint32_t> key;
    bool traced = false;

    // The codes that depth units and depth test compare and write instead of the batch's own (a quad has none). Used if
    // `replaces_depth` is set; a geometry pass must declare it in PassState::replaces_depth.
    Lanes<std::uint32_t> depth;
    bool replaces_depth = false;

    // In a pass once a pixel: bit s is set if the fragment covers sample s and passes its test there. The program may
    // choose other samples: colours are written to those that are set after it.
    Lanes<std::uint8_t> samples;

    void discard(int i) noexcept { alive[static_cast<std::size_t>(i)] = 0; }
};

// Called with a batch in which no pixel occurs twice. In full-screen passes only `pixel`, `x`, `y` and `count` are set.
// With several samples per pixel, `pixel` is an element of the region: sample * rect().area() + pixel. In a pass once a
// pixel it is the pixel's index, and `code` the depth at the pixel's point of evaluation.
template <class P>
concept FragmentProgram = requires(P& p, const FragmentBatch& in, const Loads& loads, Outputs& out) {
    p(in, loads, out);
};

// A query's count in one region. It cannot be read, because a tile's count is not the frame's. Region::any turns it
// into a branch.
class Count {
  public:
    Count() = default;
    // Several queries may be open at once; the count of a span is the sum of its draws.
    friend Count operator+(Count a, Count b) noexcept { return Count{a.own_ + b.own_}; }

  private:
    friend class Region;
    friend class Stages;
    friend class Loop;
    friend class RegionShortcuts;
    explicit Count(std::uint64_t own) noexcept : own_{own} {}
    std::uint64_t own_ = 0;
};

// An algorithm's promise about a region whose own count is zero.
enum class Idle : std::uint8_t {
    no,  // further iterations may change the region's bits
    yes  // they do not change its bits
};

// A pass's depth test in one region: to be executed, or known to pass for every fragment whatever its depth.
enum class DepthOutcome : std::uint8_t { open, passes };

struct DrawCounts {
    Count passed;   // fragments alive after stencil and depth tests (each sample of the mask counts as one)
    Count tallied;  // Outputs::tally
};

}  // namespace strata::pipeline
