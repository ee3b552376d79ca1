// pipeline/frame/pass.h - one pass as values: its state, and what a fragment program reads and writes.
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

// One of Everitt's sequential depth units (Listing 1): a read-only test against a depth target of its own, before the
// depth test proper. The first that fails discards the fragment. STRATA_depth_units, an emulator extension.
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
    std::array<Target, max_reads> reads{};         // what the program may load, at its own pixel and sample 0 only
    bool ordered_rmw = false;                      // reads may overlap what is written (STRATA_ordered_rmw)
    std::uint8_t sample_mask = 0xff;  // multisample rasterization off: a fragment covers every masked sample
    std::array<DepthUnit, max_depth_units> depth_units{};
    int depth_unit_count = 0;
    std::array<Target, 4> textures{};  // depth targets that texture units sample, anywhere in the region
    bool replaces_depth = false;       // the program may leave another depth (Outputs::depth)
    rasterizer::FragmentNeeds needs;   // what the program looks at; the stages add what they need themselves
    std::span<const PrimitiveRange>
        primitives{};             // of a geometry pass: these alone, ascending and disjoint; empty: all
    FragmentSelection selection;  // of a geometry pass: the fragments that decide what it leaves
};

// The values that a program may load: the declared reads, gathered at the fragments' own pixels.
class Loads {
  public:
    // Colour target number `read` of PassState::reads as binary32 channels; missing channels are 0, a missing alpha is
    // 1.
    [[nodiscard]] const ColorLanes& color(int read) const noexcept { return color_[static_cast<std::size_t>(read)]; }
    // Depth target number `read` as codes.
    [[nodiscard]] const Lanes<std::uint32_t>& depth(int read) const noexcept {
        return depth_[static_cast<std::size_t>(read)];
    }

  private:
    friend class Stages;
    std::array<ColorLanes, max_reads> color_;
    std::array<Lanes<std::uint32_t>, max_reads> depth_;
};

// Where a traced fragment joins the sequence that a pixel composites: at its far end (UNDER) or at its near end (OVER).
enum class Side : std::uint8_t { none, front, back };

// The results of a program. Fragments start alive; colours are undefined until written, straight or premultiplied as
// the blend state expects them.
struct Outputs {
    std::array<ColorLanes, max_color_targets> color;
    Lanes<std::uint32_t> alive;  // ~0 or 0; a program discards with &=
    std::uint64_t tally = 0;     // counts whatever the program calls an event

    // For the audit: lane i composites depth key `key[i]` on `side[i]`, if it survives the tests. Used when `traced` is
    // set.
    Lanes<Side> side;
    Lanes<std::uint32_t> key;
    bool traced = false;

    // The codes that depth units and depth test compare and write instead of the batch's own (a quad has none). Used
    // when `replaces_depth` is set; a geometry pass says so beforehand in PassState::replaces_depth.
    Lanes<std::uint32_t> depth;
    bool replaces_depth = false;

    void discard(int i) noexcept { alive[static_cast<std::size_t>(i)] = 0; }
};

// Called with a batch in which no pixel occurs twice. In full-screen passes only `pixel`, `x`, `y` and `count` are set.
template <class P>
concept FragmentProgram = requires(P& p, const FragmentBatch& in, const Loads& own, Outputs& out) {
    p(in, own, out);
};

// A query's answer in one region. It cannot be read: a tile's number is not the frame's. Region::any turns it into a
// branch.
class Count {
  public:
    Count() = default;
    // Several queries may be open at once; what one spans is the sum of its draws.
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
    no,  // further iterations may change its bits
    yes  // they change none of its bits
};

// A pass's depth test in one region: to be made, or passed by every fragment whatever its depth.
enum class DepthOutcome : std::uint8_t { open, passes };

struct Drawn {
    Count passed;   // fragments alive after stencil and depth tests (samples of the mask count one each)
    Count tallied;  // Outputs::tally
};

}  // namespace strata::pipeline
