// peeling/audit/pixel_audit.h - one pixel after the other against the exact A-buffer: what an algorithm did with its
// fragments.
//
// Rule     The sequence that a pixel composited (its trace) is compared, place by place, with its visible fragments in
//          the order of the algorithm's tie policy; its colour with all of them composited in binary64, sorted by the
//          exact depth.
// Source   audit.md 1 to 5.
// Tests    tests/peeling/audit/audit_test.cpp
#pragma once
#include <array>
#include <span>
#include <vector>

#include "peeling/algorithms/algorithm.h"
#include "peeling/audit/audit_result.h"
#include "peeling/programs/tie_order.h"
#include "pipeline/frame/frame.h"
#include "pipeline/frame/trace.h"

namespace strata::peeling {

// Takes a finished trace apart: its entries are then linked by pixel, in the order in which they came.
class PixelTraces {
  public:
    // `rect` is the traced region's. A pixel takes 4 bytes, an entry none beside its own.
    PixelTraces(pipeline::Trace& trace, const rasterizer::Rect& rect);

    // Fills `sequence` with what a pixel shows from near to far: what was composited UNDER in order, then what was
    // composited OVER, last first. `backs` is room for the latter.
    void near_to_far(int x, int y, std::vector<pipeline::TraceEntry>& sequence,
                     std::vector<pipeline::TraceEntry>& backs) const;

  private:
    static constexpr std::uint32_t none = ~std::uint32_t{0};
    const pipeline::Trace& trace_;
    rasterizer::Rect rect_;
    std::vector<std::uint32_t> head_;  // of each pixel: its first entry; an entry's `pixel` is the next one
};

struct AuditedPixel {
    int x = 0, y = 0;
    std::array<double, 4> shown{};  // the picture's colour
    pipeline::Rgba background{};    // the opaque scene's
    std::uint32_t at_opaque = 0;    // fragments at the very depth of the opaque surface
};

class PixelAudit {
  public:
    PixelAudit(const pipeline::Frame& frame, const Algorithm& algorithm);

    // `traces` are null for an algorithm without an order.
    void look_at(std::span<const KeyedFragment> visible, const PixelTraces* traces, const AuditedPixel& pixel);

    [[nodiscard]] const AuditResult& found() const noexcept { return found_; }
    [[nodiscard]] bool has_order() const noexcept { return algorithm_.ties != TiePolicy::none; }

  private:
    [[nodiscard]] std::span<const KeyedFragment> with_alpha(std::span<const KeyedFragment> fragments);
    [[nodiscard]] std::uint64_t places_that_differ(std::span<const KeyedFragment> fragments) const;
    void compare(std::span<const KeyedFragment> fragments, const AuditedPixel& pixel, bool ties_change_nothing);

    const Algorithm& algorithm_;
    bool tests_codes_;  // the alpha test compares 8-bit codes
    AuditResult found_;
    std::vector<KeyedFragment> with_alpha_;  // of the present pixel, like all that follows
    FragmentOrder by_key_, kept_, by_exact_depth_;
    std::vector<pipeline::TraceEntry> sequence_, backs_;
};

// Adds what another part of the frame found; the order of calls does not matter.
void merge(AuditResult& all, const AuditResult& part);

}  // namespace strata::peeling
