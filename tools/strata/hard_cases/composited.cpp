#include "tools/strata/hard_cases/composited.h"

#include <algorithm>
#include <bit>
#include <iterator>

#include "peeling/audit/region_trace.h"
#include "peeling/programs/programs.h"
#include "peeling/render.h"
#include "pipeline/formats/unorm8.h"

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

// What only one of two lists has; an element that comes twice in both is in both twice.
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
        // A mark of a layer names its key alone.
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

}  // namespace

std::vector<Sequence> sequences(const std::vector<peeling::RegionTrace>& traces, int width, std::size_t pixels) {
    std::vector<Sequence> all(pixels), backs(pixels);
    for (const peeling::RegionTrace& region : traces) {
        const auto columns = static_cast<std::size_t>(region.rect.width());
        for (const TraceEntry& entry : region.entries) {
            const std::size_t x = static_cast<std::size_t>(region.rect.x0) + entry.pixel % columns;
            const std::size_t y = static_cast<std::size_t>(region.rect.y0) + entry.pixel / columns;
            const std::size_t pixel = y * static_cast<std::size_t>(width) + x;
            if (entry.side == pipeline::Side::front) all[pixel].push_back(entry);
            if (entry.side == pipeline::Side::back) backs[pixel].push_back(entry);
        }
    }
    for (std::size_t p = 0; p < pixels; ++p) all[p].insert(all[p].end(), backs[p].rbegin(), backs[p].rend());
    return all;
}

std::vector<std::vector<VisibleFragment>> visible_fragments(const ComposedFrame& frame) {
    std::vector<std::vector<VisibleFragment>> pixels(frame.fragments.opaque.size());
    for (const CapturedFragment& f : frame.fragments.all)
        if (is_visible(f, frame) && is_layer(f, frame)) pixels[f.pixel].push_back({key_of(f, frame.algorithm), &f});
    return pixels;
}

bool has_tie(const std::vector<VisibleFragment>& pixel) {
    std::vector<std::uint32_t> keys;
    for (const VisibleFragment& f : pixel) keys.push_back(f.key);
    return distinct_of(std::move(keys)).size() < pixel.size();
}

Composited composited(const ComposedFrame& frame) {
    const auto pixels = visible_fragments(frame);
    const std::vector<Sequence> shown = sequences(frame.traces, frame.width, pixels.size());
    Composited found;
    for (std::size_t p = 0; p < pixels.size(); ++p) {
        std::vector<Known> visible;
        for (const VisibleFragment& f : pixels[p]) visible.push_back({f.key, f.fragment->primitive});
        look_at_pixel(visible, shown[p], frame.algorithm.ties, found);
    }
    return found;
}

}  // namespace strata::tools
