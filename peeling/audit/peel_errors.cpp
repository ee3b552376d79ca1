// peeling/audit/peel_errors.cpp - compares the layers of each pixel with its trace.
#include "peeling/audit/peel_errors.h"

#include <algorithm>

#include "peeling/audit/region_trace.h"

namespace strata::peeling {

namespace {

// The depths that each pixel composited, in any order.
struct CompositedKeys {
    std::vector<std::size_t> start;
    std::vector<std::uint32_t> keys;

    CompositedKeys(std::span<const RegionTrace> traces, std::size_t width, std::size_t height)
        : start(width * height + 1, 0) {
        // Pixel indices of trace entries are relative to the region; they are converted to the frame.
        const auto for_each = [&](auto&& body) {
            for (const RegionTrace& trace : traces) {
                const auto columns = static_cast<std::size_t>(trace.rect.width());
                for (const pipeline::TraceEntry& entry : trace.entries) {
                    const std::size_t x = static_cast<std::size_t>(trace.rect.x0) + entry.pixel % columns;
                    const std::size_t y = static_cast<std::size_t>(trace.rect.y0) + entry.pixel / columns;
                    body(y * width + x, entry.key);
                }
            }
        };
        // A counting sort by pixel: counts, their sums as start offsets, then the keys at their offsets.
        for_each([&](std::size_t pixel, std::uint32_t) { ++start[pixel + 1]; });
        for (std::size_t p = 1; p < start.size(); ++p) start[p] += start[p - 1];
        keys.resize(start.back());
        std::vector<std::size_t> next(start.begin(), start.end() - 1);
        for_each([&](std::size_t pixel, std::uint32_t key) { keys[next[pixel]++] = key; });
    }
    [[nodiscard]] std::span<const std::uint32_t> of(std::size_t pixel) const {
        return std::span{keys}.subspan(start[pixel], start[pixel + 1] - start[pixel]);
    }
};

// Ascending, so that a layer is found by binary search.
std::vector<std::uint32_t> distinct_layers(std::span<const LayerFragment> pixel) {
    std::vector<std::uint32_t> layers;
    for (const LayerFragment& f : pixel) layers.push_back(f.layer);
    std::sort(layers.begin(), layers.end());
    layers.erase(std::unique(layers.begin(), layers.end()), layers.end());
    return layers;
}

// `pixel` is one pixel's fragments, `keys` the keys composited there.
void look_at(PeelErrors& errors, std::span<const LayerFragment> pixel, std::span<const std::uint32_t> keys, int width) {
    const std::vector<std::uint32_t> layers = distinct_layers(pixel);
    // How often each layer was composited.
    std::vector<int> times(layers.size(), 0);
    for (const std::uint32_t key : keys) {
        const auto first =
            std::find_if(pixel.begin(), pixel.end(), [key](const LayerFragment& f) { return f.key == key; });
        if (first == pixel.end())
            continue;  // no fragment of the truth has this depth here: another pass transformed
                       // it differently
        ++times[static_cast<std::size_t>(std::lower_bound(layers.begin(), layers.end(), first->layer) -
                                         layers.begin())];
    }
    const auto duplicated =
        static_cast<std::uint64_t>(std::count_if(times.begin(), times.end(), [](int n) { return n > 1; }));
    const auto lost = static_cast<std::uint64_t>(std::count(times.begin(), times.end(), 0));
    errors.layers += layers.size();
    errors.layers_max = std::max(errors.layers_max, static_cast<int>(layers.size()));
    errors.duplicated += duplicated;
    errors.lost += lost;
    if (duplicated + lost == 0) return;
    const std::uint32_t p = pixel.front().pixel;
    errors.map[p] = static_cast<std::uint8_t>((duplicated > 0 ? layer_duplicated : 0) | (lost > 0 ? layer_lost : 0));
    // Pixels are visited in row-major order, so the first counted is the first in the frame.
    if (errors.touched.pixels++ > 0) return;
    errors.touched.first_x = static_cast<int>(p) % width;
    errors.touched.first_y = static_cast<int>(p) / width;
}

}  // namespace

PeelErrors peel_errors(std::span<const LayerFragment> fragments, std::span<const RegionTrace> traces, int width,
                       int height) {
    const auto columns = static_cast<std::size_t>(width), rows = static_cast<std::size_t>(height);
    const CompositedKeys composited(traces, columns, rows);
    PeelErrors errors;
    errors.map.assign(columns * rows, 0);
    for (std::size_t begin = 0; begin < fragments.size();) {
        std::size_t end = begin;
        while (end < fragments.size() && fragments[end].pixel == fragments[begin].pixel) ++end;
        look_at(errors, fragments.subspan(begin, end - begin), composited.of(fragments[begin].pixel), width);
        begin = end;
    }
    return errors;
}

}  // namespace strata::peeling
