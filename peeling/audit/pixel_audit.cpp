// peeling/audit/pixel_audit.cpp - the counts and comparisons of one pixel (pixel_audit.h).
#include "peeling/audit/pixel_audit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

#include "peeling/programs/composite.h"
#include "pipeline/stages/alpha_test.h"

namespace strata::peeling {

using namespace pipeline;

PixelTraces::PixelTraces(Trace& trace, const rasterizer::Rect& rect, std::size_t elements)
    : trace_{trace}, rect_{rect}, head_(elements, none) {
    for (std::size_t i = trace.size(); i-- > 0;)  // from the end, so that links run forward
        trace[i].pixel = std::exchange(head_[trace[i].pixel], static_cast<std::uint32_t>(i));
}

// Follows the pixel's links. Back layers were composited from the far end, each OVER the one before, so their order is
// reversed.
void PixelTraces::near_to_far(int x, int y, std::size_t sample, std::vector<TraceEntry>& sequence,
                              std::vector<TraceEntry>& backs) const {
    const std::size_t pixel = sample * rect_.area() +
                              static_cast<std::size_t>(y - rect_.y0) * static_cast<std::size_t>(rect_.width()) +
                              static_cast<std::size_t>(x - rect_.x0);
    sequence.clear();
    backs.clear();
    for (std::uint32_t i = head_[pixel]; i != none; i = trace_[i].pixel) {
        if (trace_[i].side == Side::front) sequence.push_back(trace_[i]);
        if (trace_[i].side == Side::back) backs.push_back(trace_[i]);
    }
    sequence.insert(sequence.end(), backs.rbegin(), backs.rend());
}

namespace {

// Keeps the first pixel in row-major order, whatever the order of calls, so that results do not depend on threads.
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

// Equal keys are neighbours in a sorted order.
std::size_t distinct_keys(const FragmentOrder& by_key) {
    std::size_t keys = 0;
    for (std::size_t i = 0; i < by_key.size(); ++i)
        keys += i == 0 || depth_of(by_key[i]) != depth_of(by_key[i - 1]) ? 1 : 0;
    return keys;
}

// True if two orders have equal fragments at every position.
bool are_alike(std::span<const KeyedFragment> fragments, const FragmentOrder& a, const FragmentOrder& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [&](std::uint64_t x, std::uint64_t y) {
        return x == y || fragments[submission_index(x)] == fragments[submission_index(y)];
    });
}

}  // namespace

PixelAudit::PixelAudit(const Frame& frame, const Algorithm& algorithm)
    : algorithm_{algorithm},
      tests_codes_{is_eight_bit_alpha(frame.profile->alpha_test, info(frame.color_format).type)} {
    if (has_order()) found_.order_errors = 0;
}

void PixelAudit::look_at(std::span<const KeyedFragment> visible, const PixelTraces* traces, const AuditedPixel& pixel) {
    if (pixel.at_opaque > 0) add(found_.opaque_ties, pixel.x, pixel.y);
    found_.hidden_by_opaque_ties += pixel.at_opaque;
    const auto fragments = algorithm_.kills_alpha_zero ? with_alpha(visible) : visible;
    sort_by(&KeyedFragment::key, fragments, by_key_);
    const std::size_t keys = distinct_keys(by_key_);
    // Layers count distinct keys, fragments count all: the difference is the number of fragments hidden by ties.
    found_.layers_max = std::max(found_.layers_max, static_cast<int>(keys));
    found_.fragments_max = std::max(found_.fragments_max, static_cast<int>(fragments.size()));
    if (keys < fragments.size()) add(found_.ties, pixel.x, pixel.y);
    // Without an order no tie can be lost, and all pixels count as free of ties.
    if (!has_order()) return compare(fragments, pixel, true);
    kept_ = by_key_;
    apply(algorithm_.ties, kept_);
    found_.lost_by_ties += fragments.size() - kept_.size();
    traces->near_to_far(pixel.x, pixel.y, pixel.sample, sequence_, backs_);
    const std::uint64_t errors = differing_positions(fragments);
    *found_.order_errors += errors;
    if (errors > 0) add(found_.misordered, pixel.x, pixel.y);
    compare(fragments, pixel, are_alike(fragments, kept_, by_key_));
}

// The fragments that pass an alpha test GREATER 0.
std::span<const KeyedFragment> PixelAudit::with_alpha(std::span<const KeyedFragment> fragments) {
    with_alpha_.clear();
    for (const KeyedFragment& f : fragments)
        if (tests_codes_ ? to_unorm8(f.color[3]) > 0 : f.color[3] > 0.0f) with_alpha_.push_back(f);
    return with_alpha_;
}

// Each entry of the longer sequence beyond the end of the shorter one counts as an error.
std::uint64_t PixelAudit::differing_positions(std::span<const KeyedFragment> fragments) const {
    const std::size_t shared = std::min(kept_.size(), sequence_.size());
    std::uint64_t errors = std::max(kept_.size(), sequence_.size()) - shared;
    for (std::size_t i = 0; i < shared; ++i) {
        const KeyedFragment& expected = fragments[submission_index(kept_[i])];
        const TraceEntry& found = sequence_[i];
        // An entry may represent a layer without identifying the fragment; then only its key is compared.
        const bool is_same_fragment = !found.is_fragment || found.primitive == expected.primitive;
        if (found.key != expected.key || !is_same_fragment) ++errors;
    }
    return errors;
}

void PixelAudit::compare(std::span<const KeyedFragment> fragments, const AuditedPixel& pixel,
                         bool ties_change_nothing) {
    sort_almost(&KeyedFragment::exact_code, fragments, by_key_, by_exact_depth_);
    // Sorted by the exact depth instead of the key: a reordering by the key's rounding counts as an error.
    const auto truth = composite(fragments, by_exact_depth_, pixel.background);
    double worst = 0;
    const std::size_t channels = pixel.background[3] == 1.0f ? 3 : 4;
    for (std::size_t c = 0; c < channels; ++c) {
        if (pixel.shown[c] == truth[c]) continue;
        const double off = std::fabs(pixel.shown[c] - truth[c]) * 255.0;
        worst = std::isnan(off) ? std::numeric_limits<double>::infinity() : std::max(worst, off);
    }
    found_.max_difference = std::max(found_.max_difference, worst);
    if (ties_change_nothing) found_.max_difference_without_ties = std::max(found_.max_difference_without_ties, worst);
}

void merge(AuditResult& all, const AuditResult& part) {
    all.layers_max = std::max(all.layers_max, part.layers_max);
    all.fragments_max = std::max(all.fragments_max, part.fragments_max);
    if (part.order_errors) all.order_errors = all.order_errors.value_or(0) + *part.order_errors;
    all.lost_by_ties += part.lost_by_ties;
    add(all.ties, part.ties);
    add(all.misordered, part.misordered);
    add(all.opaque_ties, part.opaque_ties);
    all.hidden_by_opaque_ties += part.hidden_by_opaque_ties;
    all.max_difference = std::max(all.max_difference, part.max_difference);
    all.max_difference_without_ties = std::max(all.max_difference_without_ties, part.max_difference_without_ties);
}

}  // namespace strata::peeling
