#include "peeling/audit/audit.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "peeling/audit/image_error.h"
#include "peeling/programs/composite.h"
#include "peeling/programs/fragment_lists.h"
#include "peeling/programs/tie_order.h"
#include "pipeline/region/region.h"
#include "pipeline/stages/alpha_test.h"
#include "rasterizer/base/float_environment.h"
#include "rasterizer/base/parallel.h"

namespace strata::peeling {

using namespace pipeline;

namespace {

// A region's trace, pixel by pixel, in the order in which things happened.
struct PixelTraces {
    std::vector<std::uint32_t> start;
    std::vector<TraceEntry> entries;

    PixelTraces(const std::vector<TraceEntry>& trace, std::size_t pixels)
        : start(pixels + 1, 0), entries(trace.size()) {
        for (const TraceEntry& e : trace) ++start[e.pixel + 1];
        for (std::size_t p = 1; p < start.size(); ++p) start[p] += start[p - 1];
        std::vector<std::uint32_t> next(start.begin(), start.end() - 1);
        for (const TraceEntry& e : trace) entries[next[e.pixel]++] = e;
    }

    // What the pixel shows from near to far: what was composited UNDER in order, then what was composited OVER, last first.
    [[nodiscard]] std::vector<TraceEntry> near_to_far(std::uint32_t pixel) const {
        std::vector<TraceEntry> sequence;
        for (std::uint32_t i = start[pixel]; i < start[pixel + 1]; ++i)
            if (entries[i].side == Side::front) sequence.push_back(entries[i]);
        for (std::uint32_t i = start[pixel + 1]; i-- > start[pixel];)
            if (entries[i].side == Side::back) sequence.push_back(entries[i]);
        return sequence;
    }
};

std::uint64_t places_that_differ(const std::vector<KeyedFragment>& expected, const std::vector<TraceEntry>& found) {
    const std::size_t shared = std::min(expected.size(), found.size());
    std::uint64_t errors = std::max(expected.size(), found.size()) - shared;
    for (std::size_t i = 0; i < shared; ++i) {
        const bool same_fragment = !found[i].is_fragment || found[i].primitive == expected[i].primitive;
        if (found[i].key != expected[i].key || !same_fragment) ++errors;
    }
    return errors;
}

void add(PixelCount& count, int x, int y) {
    if (count.pixels++ == 0 || std::tie(y, x) < std::tie(count.first_y, count.first_x))
        count.first_x = x, count.first_y = y;
}

void add(PixelCount& count, const PixelCount& other) {
    if (other.pixels == 0) return;
    const std::uint64_t pixels = count.pixels + other.pixels;
    add(count, other.first_x, other.first_y);
    count.pixels = pixels;
}

class RegionAudit {
  public:
    RegionAudit(const Frame& frame, const Algorithm& algorithm, const FrameResult& result, std::size_t r)
        : algorithm_{algorithm},
          result_{result},
          region_{
              frame,
              {result.traces[r].rect, result.traces[r].tile, result.work.tile_size == 0 ? Extent::frame : Extent::tile},
              books_},
          lists_{visible_fragments(region_, Bookkeeping::silent)},
          traces_{result.traces[r].entries, region_.rect().area()} {}

    AuditResult run() {
        if (has_order()) found_.order_errors = 0;
        for (std::uint32_t pixel = 0; pixel < region_.rect().area(); ++pixel) look_at(pixel);
        return found_;
    }

  private:
    [[nodiscard]] bool has_order() const { return algorithm_.ties != TiePolicy::none; }

    void look_at(std::uint32_t pixel) {
        const rasterizer::Rect rect = region_.rect();
        const int x = rect.x0 + static_cast<int>(pixel) % rect.width(),
                  y = rect.y0 + static_cast<int>(pixel) / rect.width();
        const auto fragments = lists_.of(pixel);
        if (algorithm_.kills_alpha_zero) return look_at(with_alpha(fragments), pixel, x, y);
        look_at(fragments, pixel, x, y);
    }

    // What an alpha test GREATER 0 leaves.
    [[nodiscard]] std::vector<KeyedFragment> with_alpha(std::span<const KeyedFragment> fragments) const {
        const Frame& frame = region_.frame();
        const bool eight_bit = is_eight_bit_alpha(frame.profile->alpha_test, info(frame.color_format).type);
        std::vector<KeyedFragment> kept;
        for (const KeyedFragment& f : fragments)
            if (eight_bit ? to_unorm8(f.color[3]) > 0 : f.color[3] > 0.0f) kept.push_back(f);
        return kept;
    }

    void look_at(std::span<const KeyedFragment> fragments, std::uint32_t pixel, int x, int y) {
        const auto keys = in_policy_order(fragments, TiePolicy::unique).size();
        const auto kept = has_order() ? in_policy_order(fragments, algorithm_.ties) : std::vector<KeyedFragment>{};
        const std::size_t lost = has_order() ? fragments.size() - kept.size() : 0;
        found_.layers_max = std::max(found_.layers_max, static_cast<int>(keys));
        found_.fragments_max = std::max(found_.fragments_max, static_cast<int>(fragments.size()));
        found_.lost_by_ties += lost;
        if (keys < fragments.size()) add(found_.ties, x, y);
        if (has_order()) {
            const std::uint64_t errors = places_that_differ(kept, traces_.near_to_far(pixel));
            *found_.order_errors += errors;
            if (errors > 0) add(found_.misordered, x, y);
        }
        compare(fragments, pixel, x, y, !has_order() || kept == in_policy_order(fragments, TiePolicy::first));
    }

    void compare(std::span<const KeyedFragment> fragments, std::uint32_t pixel, int x, int y,
                 bool ties_change_nothing) {
        const auto truth = composite(by_exact_depth(fragments), region_.color(region_.opaque_color(), pixel));
        const rasterizer::Rect frame = region_.frame().rect();
        double worst = 0;
        for (int c = 0; c < 3; ++c) {
            const double value = channel_value(result_.color, x - frame.x0, y - frame.y0, c);
            worst = std::max(worst, std::fabs(value - truth[static_cast<std::size_t>(c)]) * 255.0);
        }
        found_.max_difference = std::max(found_.max_difference, worst);
        if (ties_change_nothing)
            found_.max_difference_without_ties = std::max(found_.max_difference_without_ties, worst);
    }

    const Algorithm& algorithm_;
    const FrameResult& result_;
    RegionBooks books_;
    Region region_;
    FragmentLists lists_;
    PixelTraces traces_;
    AuditResult found_;
};

}  // namespace

AuditResult audit(const Frame& frame, const Algorithm& algorithm, const FrameResult& result, int threads) {
    const FloatEnvironment ours;
    std::vector<AuditResult> parts(result.traces.size());
    parallel_for(parts.size(), threads, [&](std::size_t r) {
        parts[r] = RegionAudit{frame, algorithm, result, r}.run();
    });
    AuditResult all;
    for (const AuditResult& part : parts) {
        all.layers_max = std::max(all.layers_max, part.layers_max);
        all.fragments_max = std::max(all.fragments_max, part.fragments_max);
        if (part.order_errors) all.order_errors = all.order_errors.value_or(0) + *part.order_errors;
        all.lost_by_ties += part.lost_by_ties;
        add(all.ties, part.ties);
        add(all.misordered, part.misordered);
        all.max_difference = std::max(all.max_difference, part.max_difference);
        all.max_difference_without_ties = std::max(all.max_difference_without_ties, part.max_difference_without_ties);
    }
    return all;
}

}  // namespace strata::peeling
