// tools/lab/hard_cases/composited.cpp - finds fragments that a peel lost, repeated, mixed or misplaced: its traced
// layers against the sorted visible fragments of each pixel (composited.h).
#include "tools/lab/hard_cases/composited.h"

#include <algorithm>
#include <bit>
#include <iterator>

#include "peeling/audit/region_trace.h"
#include "peeling/programs/programs.h"
#include "peeling/render.h"
#include "pipeline/formats/unorm8.h"
#include "tools/lab/hard_cases/composed_pixels.h"

namespace strata::tools {

namespace {

using peeling::TiePolicy;
using pipeline::CapturedFragment;
using pipeline::TraceEntry;

bool is_by_shader_z(const peeling::Algorithm& algorithm) { return algorithm.key == pipeline::DepthKey::shader_z; }

// The key by which the algorithm orders fragments.
std::uint32_t key_of(const CapturedFragment& f, const peeling::Algorithm& algorithm) {
    return is_by_shader_z(algorithm) ? peeling::ordered_code(f.shader_z) : f.code;
}

bool is_visible(const CapturedFragment& f, const ComposedFrame& frame) {
    const std::uint32_t opaque = frame.fragments.opaque[f.pixel];
    return is_by_shader_z(frame.algorithm) ? f.shader_z < std::bit_cast<float>(opaque) : f.code < opaque;
}

bool is_layer(const CapturedFragment& f, const ComposedFrame& frame) {
    if (!frame.algorithm.kills_alpha_zero) return true;
    return frame.tests_codes ? pipeline::to_unorm8(f.color[3]) > 0 : f.color[3] > 0.0f;
}

struct Known {
    std::uint32_t key = 0, primitive = 0;
    friend auto operator<=>(const Known&, const Known&) = default;
};

// The elements that only one of two lists has, as multisets.
template <class T>
void compare_lists(std::vector<T> expected, std::vector<T> shown, Composited& found) {
    std::sort(expected.begin(), expected.end());
    std::sort(shown.begin(), shown.end());
    std::vector<T> lost, repeated;
    std::set_difference(expected.begin(), expected.end(), shown.begin(), shown.end(), std::back_inserter(lost));
    std::set_difference(shown.begin(), shown.end(), expected.begin(), expected.end(), std::back_inserter(repeated));
    found.lost += lost.size();
    found.repeated += repeated.size();
}

std::vector<std::uint32_t> distinct_of(std::vector<std::uint32_t> keys) {
    std::sort(keys.begin(), keys.end());
    keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
    return keys;
}

void compare_sequence(const std::vector<Known>& visible, const Sequence& sequence, TiePolicy ties, Composited& found) {
    std::vector<std::uint32_t> expected_keys, shown_keys;
    std::vector<Known> shown;
    const bool drops = ties == TiePolicy::unique || ties == TiePolicy::merged;
    bool names_fragments = !drops;
    for (const Known& known : visible) expected_keys.push_back(known.key);
    for (std::size_t i = 0; i < sequence.size(); ++i) {
        // A trace entry of a layer has only its key.
        names_fragments = names_fragments && sequence[i].is_fragment;
        shown_keys.push_back(sequence[i].key);
        shown.push_back({sequence[i].key, sequence[i].primitive});
        if (i > 0 && sequence[i].key < sequence[i - 1].key) ++found.misplaced;
    }
    if (names_fragments)
        compare_lists(visible, std::move(shown), found);
    else
        compare_lists(drops ? distinct_of(std::move(expected_keys)) : expected_keys, std::move(shown_keys), found);
}

void look_at_pixel(const std::vector<Known>& visible, const Sequence& sequence, TiePolicy ties, Composited& found) {
    std::vector<std::uint32_t> keys;
    for (const Known& known : visible) keys.push_back(known.key);
    const std::size_t distinct = distinct_of(std::move(keys)).size();
    found.visible += visible.size();
    found.deepest = std::max(found.deepest, static_cast<int>(visible.size()));
    found.layers = std::max(found.layers, static_cast<int>(distinct));
    if (distinct < visible.size()) ++found.tied_pixels;
    found.lost_by_ties += visible.size() - distinct;
    if (ties == TiePolicy::none) return;
    const std::uint64_t before = found.lost + found.repeated + found.misplaced;
    compare_sequence(visible, sequence, ties, found);
    if (found.lost + found.repeated + found.misplaced != before) ++found.wrong_pixels;
}

// Values, each with its pixel.
template <class T>
using ByPixel = std::vector<std::pair<std::size_t, T>>;

// Sorts by pixel; values of one pixel keep their order.
template <class T>
ByPixel<T> sorted(ByPixel<T> all) {
    std::stable_sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    return all;
}

ByPixel<VisibleFragment> visible_by_pixel(const ComposedFrame& frame) {
    ByPixel<VisibleFragment> all;
    for (const CapturedFragment& f : frame.fragments.all)
        if (is_visible(f, frame) && is_layer(f, frame))
            all.push_back({f.pixel, VisibleFragment{key_of(f, frame.algorithm), &f}});
    return sorted(std::move(all));
}

ByPixel<TraceEntry> composited_by_pixel(const ComposedFrame& frame) {
    ByPixel<TraceEntry> all, backs;
    for (const peeling::RegionTrace& region : frame.traces) {
        const auto columns = static_cast<std::size_t>(region.rect.width());
        for (const TraceEntry& entry : region.entries) {
            const std::size_t x = static_cast<std::size_t>(region.rect.x0) + entry.pixel % columns;
            const std::size_t y = static_cast<std::size_t>(region.rect.y0) + entry.pixel / columns;
            const std::size_t pixel = y * static_cast<std::size_t>(frame.width) + x;
            if (entry.side == pipeline::Side::front) all.emplace_back(pixel, entry);
            if (entry.side == pipeline::Side::back) backs.emplace_back(pixel, entry);
        }
    }
    all.insert(all.end(), backs.rbegin(), backs.rend());
    return sorted(std::move(all));
}

}  // namespace

std::vector<ComposedPixel> composed_pixels(const ComposedFrame& frame) {
    const auto visible = visible_by_pixel(frame);
    const auto composited = composited_by_pixel(frame);
    std::vector<ComposedPixel> pixels;
    auto v = visible.begin();
    auto c = composited.begin();
    while (v != visible.end() || c != composited.end()) {
        const bool is_visible_next = c == composited.end() || (v != visible.end() && v->first <= c->first);
        ComposedPixel& at = pixels.emplace_back();
        at.pixel = is_visible_next ? v->first : c->first;
        for (; v != visible.end() && v->first == at.pixel; ++v) at.visible.push_back(v->second);
        for (; c != composited.end() && c->first == at.pixel; ++c) at.sequence.push_back(c->second);
    }
    return pixels;
}

bool has_tie(const std::vector<VisibleFragment>& pixel) {
    std::vector<std::uint32_t> keys;
    for (const VisibleFragment& f : pixel) keys.push_back(f.key);
    return distinct_of(std::move(keys)).size() < pixel.size();
}

Composited composited(const ComposedFrame& frame) {
    Composited found;
    for (const ComposedPixel& at : composed_pixels(frame)) {
        std::vector<Known> visible;
        for (const VisibleFragment& f : at.visible) visible.push_back({f.key, f.fragment->primitive});
        look_at_pixel(visible, at.sequence, frame.algorithm.ties, found);
    }
    return found;
}

}  // namespace strata::tools
