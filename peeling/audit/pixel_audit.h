// peeling/audit/pixel_audit.h - compares single pixels with the exact A-buffer of their fragments.
//
// Rule     The sequence that a pixel composited (its trace) is compared, position by position, with its visible
//          fragments in the order of the algorithm's tie policy. Its colour is compared with all of them composited in
//          binary64, sorted by the exact depth.
// Source   peeling/reference/audit.md 1 to 5.
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

// Links the entries of a finished trace by pixel, in trace order; the trace is consumed.
class PixelTraces {
  public:
    // `rect` is the traced region's. Takes 4 bytes per element; the entries are linked in place.
    PixelTraces(pipeline::Trace& trace, const rasterizer::Rect& rect, std::size_t elements);

    // Fills `sequence` with the composited layers from near to far: those composited UNDER, in order, then those
    // composited OVER, last first. `backs` is scratch space for the latter.
    void near_to_far(int x, int y, std::size_t sample, std::vector<pipeline::TraceEntry>& sequence,
                     std::vector<pipeline::TraceEntry>& backs) const;

  private:
    static constexpr std::uint32_t none = ~std::uint32_t{0};
    const pipeline::Trace& trace_;
    rasterizer::Rect rect_;
    std::vector<std::uint32_t> head_;  // per element, its first entry; an entry's `pixel` is the index of the next
};

struct AuditedPixel {
    int x = 0, y = 0;
    std::size_t sample = 0;
    std::array<double, 4> shown{};  // the image's colour
    pipeline::Rgba background{};    // the opaque scene's colour
    std::uint32_t at_opaque = 0;    // fragments at exactly the depth of the opaque surface
};

class PixelAudit {
  public:
    PixelAudit(const pipeline::Frame& frame, const Algorithm& algorithm);

    // `traces` is null for an algorithm without an order.
    void look_at(std::span<const KeyedFragment> visible, const PixelTraces* traces, const AuditedPixel& pixel);

    [[nodiscard]] const AuditResult& found() const noexcept { return found_; }
    [[nodiscard]] bool has_order() const noexcept { return algorithm_.ties != TiePolicy::none; }

  private:
    [[nodiscard]] std::span<const KeyedFragment> with_alpha(std::span<const KeyedFragment> fragments);
    [[nodiscard]] std::uint64_t differing_positions(std::span<const KeyedFragment> fragments) const;
    void compare(std::span<const KeyedFragment> fragments, const AuditedPixel& pixel, bool ties_change_nothing);

    const Algorithm& algorithm_;
    bool tests_codes_;  // the alpha test compares 8-bit codes
    AuditResult found_;
    std::vector<KeyedFragment> with_alpha_;  // of the current pixel, like the members below
    FragmentOrder by_key_, kept_, by_exact_depth_;
    std::vector<pipeline::TraceEntry> sequence_, backs_;
};

// Adds the results of another part of the frame; the order of calls does not matter.
void merge(AuditResult& all, const AuditResult& part);

}  // namespace strata::peeling
