// tools/lab/hard_cases/moves/hard_result.cpp - reads which fragments a renderer composited in which layer of each
// pixel, from the trace of its run, and counts the differences of two such results (hard_result.h). A key is the depth
// by which an algorithm orders fragments; -1 is the layer of a fragment that it never composited. Colours are not
// compared where fragments are gained or lost, since they then differ by whole layers.
#include "tools/lab/hard_cases/moves/hard_result.h"

#include <algorithm>
#include <cmath>

#include "peeling/audit/image_error.h"
#include "peeling/audit/region_trace.h"
#include "peeling/render.h"
#include "tools/lab/hard_cases/composed_pixels.h"
#include "tools/lab/hard_cases/hard_run.h"

namespace strata::tools {

using namespace pipeline;

namespace {

// Pairs the fragments of two pixels, both sorted by primitive. Those that only one of them composites are counted in
// `alone`.
std::vector<std::array<const ResultFragment*, 2>> stayed(const ResultPixel& before, const ResultPixel& after,
                                                         std::array<std::uint64_t, 2>& alone) {
    std::vector<std::array<const ResultFragment*, 2>> both;
    auto a = before.fragments.begin(), b = after.fragments.begin();
    while (a != before.fragments.end() || b != after.fragments.end()) {
        const bool has_a = a != before.fragments.end(), has_b = b != after.fragments.end();
        const bool takes_a = has_a && (!has_b || a->primitive <= b->primitive);
        const bool takes_b = has_b && (!has_a || b->primitive <= a->primitive);
        const bool shown_a = takes_a && a->layer >= 0, shown_b = takes_b && b->layer >= 0;
        if (shown_a && shown_b) both.push_back({&*a, &*b});
        if (shown_a && !shown_b) ++alone[0];
        if (shown_b && !shown_a) ++alone[1];
        if (takes_a) ++a;
        if (takes_b) ++b;
    }
    return both;
}

// The layer number of each key and fragment in a sequence; the first occurrence is used.
struct Layers {
    std::vector<std::pair<std::uint32_t, int>> by_key;        // layers identified by their key
    std::vector<std::pair<std::uint32_t, int>> by_primitive;  // layers identified by a fragment
};

Layers layers_of(const Sequence& sequence) {
    Layers layers;
    int layer = -1;
    for (std::size_t i = 0; i < sequence.size(); ++i) {
        if (i == 0 || sequence[i].key != sequence[i - 1].key) ++layer;
        auto& known = sequence[i].is_fragment ? layers.by_primitive : layers.by_key;
        known.emplace_back(sequence[i].is_fragment ? sequence[i].primitive : sequence[i].key, layer);
    }
    return layers;
}

// A layer of a key contains the first submitted fragment only, or all fragments of the key.
int layer_of(const Layers& layers, const std::vector<VisibleFragment>& visible, std::size_t i, bool merges) {
    const auto find = [](const auto& known, std::uint32_t name) {
        const auto found = std::find_if(known.begin(), known.end(), [&](const auto& k) { return k.first == name; });
        return found == known.end() ? -1 : found->second;
    };
    const int own = find(layers.by_primitive, visible[i].fragment->primitive);
    if (own >= 0) return own;
    const auto is_same = [&](const VisibleFragment& f) { return f.key == visible[i].key; };
    const bool is_first =
        std::find_if(visible.begin(), visible.end(), is_same) - visible.begin() == static_cast<std::ptrdiff_t>(i);
    return is_first || merges ? find(layers.by_key, visible[i].key) : -1;
}

double depth_of(const VisibleFragment& f, DepthFormat format) {
    return rasterizer::depth_value(f.fragment->code, format);
}

std::array<double, 3> color_at(const Image& image, std::size_t pixel) {
    const auto x = static_cast<int>(pixel % static_cast<std::size_t>(image.width));
    const auto y = static_cast<int>(pixel / static_cast<std::size_t>(image.width));
    std::array<double, 3> color{};
    for (int c = 0; c < 3; ++c) color[static_cast<std::size_t>(c)] = peeling::channel_value(image, x, y, c);
    return color;
}

}  // namespace

Changes& Changes::operator+=(const Changes& other) {
    gained += other.gained;
    lost += other.lost;
    reordered += other.reordered;
    color += other.color;
    depth = std::max(depth, other.depth);
    return *this;
}

Changes changes(const ResultPixel& before, const ResultPixel& after) {
    std::array<std::uint64_t, 2> alone{};
    const auto both = stayed(before, after, alone);
    Changes found{.gained = alone[1], .lost = alone[0]};
    for (std::size_t i = 0; i < both.size(); ++i) {
        found.depth = std::max(found.depth, std::fabs(both[i][1]->depth - both[i][0]->depth));
        for (std::size_t k = i + 1; k < both.size(); ++k)
            if ((both[i][0]->layer <=> both[k][0]->layer) != (both[i][1]->layer <=> both[k][1]->layer))
                ++found.reordered;
    }
    if (found.gained + found.lost > 0) return found;
    for (std::size_t c = 0; c < 3; ++c)
        found.color = std::fmax(found.color, std::fabs(after.color[c] - before.color[c]) * 255);
    return found;
}

bool matches(const ResultPixel& pixel, const ResultPixel& exact, FragmentOrderMatch what) {
    std::array<std::uint64_t, 2> alone{};
    const auto both = stayed(exact, pixel, alone);
    if (alone[0] + alone[1] > 0 || pixel.layers != exact.layers) return false;
    for (std::size_t i = 0; i < both.size() && what == FragmentOrderMatch::in_order; ++i)
        for (std::size_t k = i + 1; k < both.size(); ++k)
            if ((both[i][0]->layer <=> both[k][0]->layer) != (both[i][1]->layer <=> both[k][1]->layer)) return false;
    return true;
}

RenderedPixels render(peeling::Renderer& renderer, const peeling::Algorithm& algorithm, int width) {
    RenderedPixels rendered;
    std::vector<peeling::RegionTrace> traces;
    const peeling::RenderResult result = renderer.render_traced(algorithm, traces);
    if (result.refusal) {
        rendered.refusal = result.refusal->feature;
        return rendered;
    }
    const peeling::FrameFragments fragments = renderer.fragments(algorithm);
    const bool is_ordered = algorithm.ties != peeling::TiePolicy::none;
    const bool merges = algorithm.ties == peeling::TiePolicy::merged;
    rendered.pixels.resize(fragments.opaque.size());
    for (std::size_t p = 0; p < rendered.pixels.size(); ++p) rendered.pixels[p].color = color_at(result.frame.color, p);
    for (const ComposedPixel& at :
         composed_pixels({algorithm, width, renderer.color_format() == Format::rgba8, fragments, traces})) {
        const Layers layers = layers_of(at.sequence);
        ResultPixel& pixel = rendered.pixels[at.pixel];
        pixel.layers = static_cast<int>(is_ordered ? at.sequence.size() : at.visible.size());
        for (std::size_t i = 0; i < at.visible.size(); ++i)
            pixel.fragments.push_back({at.visible[i].fragment->primitive,
                                       is_ordered ? layer_of(layers, at.visible, i, merges) : 0,
                                       depth_of(at.visible[i], renderer.depth_format())});
        std::sort(pixel.fragments.begin(), pixel.fragments.end());
    }
    rendered.reports_misplaced = std::any_of(result.frame.diagnostics.begin(), result.frame.diagnostics.end(),
                                             [](const Diagnostic& d) { return explains_misplaced(d.fault); });
    return rendered;
}

RenderedPixels result_of_depths(peeling::Renderer& renderer, const peeling::Algorithm& algorithm) {
    RenderedPixels rendered;
    const peeling::FrameFragments fragments = renderer.fragments(algorithm);
    rendered.pixels.resize(fragments.opaque.size());
    for (const ComposedPixel& at : composed_pixels({algorithm, 1, true, fragments, {}})) {
        const std::vector<VisibleFragment>& visible = at.visible;
        std::vector<std::uint32_t> keys;
        for (const VisibleFragment& f : visible) keys.push_back(f.key);
        std::sort(keys.begin(), keys.end());
        keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
        ResultPixel& pixel = rendered.pixels[at.pixel];
        pixel.layers = static_cast<int>(keys.size());
        for (std::size_t i = 0; i < visible.size(); ++i) {
            const auto is_same = [&](const VisibleFragment& f) { return f.key == visible[i].key; };
            const bool is_first =
                std::none_of(visible.begin(), visible.begin() + static_cast<std::ptrdiff_t>(i), is_same);
            const auto layer = std::lower_bound(keys.begin(), keys.end(), visible[i].key) - keys.begin();
            pixel.fragments.push_back({visible[i].fragment->primitive, is_first ? static_cast<int>(layer) : -1,
                                       depth_of(visible[i], renderer.depth_format())});
        }
        std::sort(pixel.fragments.begin(), pixel.fragments.end());
    }
    return rendered;
}

}  // namespace strata::tools
