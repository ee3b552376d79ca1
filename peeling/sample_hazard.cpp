// peeling/sample_hazard.cpp - counts, sample by sample, the layers that a peel lost, doubled or
// misplaced: from a trace of each sample's frame and the sample's own fragments (sample_hazard.h).
#include "peeling/sample_hazard.h"

#include <algorithm>
#include <map>
#include <set>

#include "peeling/algorithms/algorithm.h"
#include "peeling/audit/path_pairs.h"
#include "peeling/audit/peel_errors.h"
#include "peeling/audit/region_trace.h"
#include "peeling/invariance.h"

namespace strata::peeling {

using namespace pipeline;

namespace {

FrameFragments fragments_of(const FrameRequest& request, const Algorithm& algorithm,
                            rasterizer::Interpolation interpolation) {
    RenderOptions at = request.options;
    at.raster.interpolation = interpolation;
    return keyed(Renderer{request.with(at)}.fragments(algorithm), algorithm.key);
}

// The visible fragments of each sample: layer and key, sorted by pixel.
std::vector<std::vector<LayerFragment>> layers_of(const FrameRequest& request, const Algorithm& algorithm) {
    const FrameFragments true_ones = fragments_of(request, algorithm, rasterizer::Interpolation::sample);
    const FrameFragments drawn_ones = fragments_of(request, algorithm, request.options.raster.interpolation);
    std::vector<std::vector<LayerFragment>> all(static_cast<std::size_t>(request.options.sampling.samples));
    for (std::size_t sample = 0; sample < all.size(); ++sample) {
        const FrameFragments truth = true_ones.of_sample(sample), drawn = drawn_ones.of_sample(sample);
        for (const PathPair& pair : pair_up(truth.all, drawn.all).pairs)
            if (pair.stored < truth.opaque[pair.pixel])
                all[sample].push_back({pair.pixel, pair.primitive, pair.stored, pair.reference});
    }
    return all;
}

// The primitives of each pixel at one sample, in order of submission.
using Primitives = std::vector<std::vector<std::uint32_t>>;

Primitives primitives_of(const std::vector<LayerFragment>& fragments, std::size_t pixels) {
    Primitives primitives(pixels);
    for (const LayerFragment& f : fragments) primitives[f.pixel].push_back(f.primitive);
    return primitives;
}

SampleEdge edge_of(const std::vector<Primitives>& samples, std::size_t pixel) {
    SampleEdge kind = SampleEdge::inside;
    for (const Primitives& sample : samples) {
        if (sample[pixel].size() != samples[0][pixel].size()) return SampleEdge::silhouette;
        if (sample[pixel] != samples[0][pixel]) kind = SampleEdge::inner_edge;
    }
    return kind;
}

// The traces of one sample, as of a frame of that sample alone.
std::vector<RegionTrace> traces_of(const std::vector<RegionTrace>& traces, std::size_t sample) {
    std::vector<RegionTrace> own;
    for (const RegionTrace& trace : traces) {
        const std::size_t area = trace.rect.area();
        RegionTrace& kept = own.emplace_back(RegionTrace{trace.rect, {}});
        for (TraceEntry entry : trace.entries) {
            if (entry.pixel / area != sample) continue;
            entry.pixel = static_cast<std::uint32_t>(entry.pixel % area);
            kept.entries.push_back(entry);
        }
    }
    return own;
}

// Without all but the first of the fragments that tie at a depth: an algorithm may composite each of them, and a layer
// is doubled only if one fragment is.
std::vector<RegionTrace> without_ties(std::vector<RegionTrace> traces) {
    for (RegionTrace& trace : traces) {
        std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> first;  // primitive by pixel and key
        std::erase_if(trace.entries, [&](const TraceEntry& entry) {
            return entry.is_fragment &&
                   first.try_emplace({entry.pixel, entry.key}, entry.primitive).first->second != entry.primitive;
        });
    }
    return traces;
}

// Each pixel's composited keys from near to far.
std::vector<std::vector<std::uint32_t>> sequences_of(const std::vector<RegionTrace>& traces,
                                                     const RenderOptions& options) {
    const auto width = static_cast<std::size_t>(options.width);
    std::vector<std::vector<std::uint32_t>> near(width * static_cast<std::size_t>(options.height)), far(near.size());
    for (const RegionTrace& trace : traces)
        for (const TraceEntry& entry : trace.entries) {
            const auto columns = static_cast<std::size_t>(trace.rect.width());
            const std::size_t pixel = (static_cast<std::size_t>(trace.rect.y0) + entry.pixel / columns) * width +
                                      static_cast<std::size_t>(trace.rect.x0) + entry.pixel % columns;
            (entry.side == Side::back ? far : near)[pixel].push_back(entry.key);
        }
    for (std::size_t p = 0; p < near.size(); ++p) near[p].insert(near[p].end(), far[p].rbegin(), far[p].rend());
    return near;
}

// Layers of one pixel that were composited behind a farther one; a layer's first time counts.
std::uint64_t misplaced(std::span<const LayerFragment> pixel, const std::vector<std::uint32_t>& keys) {
    std::set<std::uint32_t> seen;
    std::uint64_t count = 0;
    for (const std::uint32_t key : keys) {
        const auto found = std::ranges::find(pixel, key, &LayerFragment::key);
        if (found == pixel.end()) continue;
        if (!seen.contains(found->layer) && !seen.empty() && *seen.rbegin() > found->layer) ++count;
        seen.insert(found->layer);
    }
    return count;
}

// The part of one sample: counts, and the pixels where something is wrong.
std::vector<bool> add_sample(SampleHazard& hazard, const RenderOptions& options,
                             const std::vector<LayerFragment>& layers, const std::vector<RegionTrace>& traces) {
    const PeelErrors errors = peel_errors(layers, traces, options.width, options.height);
    const auto sequences = sequences_of(traces, options);
    std::vector<bool> wrong(errors.map.size());
    for (std::size_t p = 0; p < wrong.size(); ++p) wrong[p] = errors.map[p] != 0;
    for (std::size_t begin = 0; begin < layers.size();) {
        const std::uint32_t pixel = layers[begin].pixel;
        std::size_t end = begin;
        while (end < layers.size() && layers[end].pixel == pixel) ++end;
        const std::uint64_t count = misplaced(std::span{layers}.subspan(begin, end - begin), sequences[pixel]);
        hazard.misplaced += count;
        if (count > 0) wrong[pixel] = true;
        ++hazard.samples;
        begin = end;
    }
    hazard.layers += errors.layers;
    hazard.lost += errors.lost;
    hazard.doubled += errors.duplicated;
    return wrong;
}

// A program runs once for each sample of a fragment, or once for all that the fragment covers of a pixel.
std::uint64_t program_count(const std::vector<Primitives>& samples, bool is_once_a_pixel) {
    std::uint64_t count = 0;
    for (std::size_t p = 0; p < samples[0].size(); ++p) {
        std::set<std::uint32_t> together;
        for (const Primitives& sample : samples) {
            together.insert(sample[p].begin(), sample[p].end());
            if (!is_once_a_pixel) count += sample[p].size();
        }
        if (is_once_a_pixel) count += together.size();
    }
    return count;
}

}  // namespace

std::vector<SampleEdge> sample_edges(const FrameRequest& request, const Algorithm& algorithm) {
    const RenderOptions& options = request.options;
    const std::size_t pixels = static_cast<std::size_t>(options.width) * static_cast<std::size_t>(options.height);
    std::vector<Primitives> primitives;
    for (const std::vector<LayerFragment>& layers : layers_of(request, algorithm))
        primitives.push_back(primitives_of(layers, pixels));
    std::vector<SampleEdge> edges(pixels);
    for (std::size_t p = 0; p < pixels; ++p) edges[p] = edge_of(primitives, p);
    return edges;
}

SampleHazard measure_samples(const FrameRequest& request, const Algorithm& algorithm) {
    const RenderOptions& options = request.options;
    SampleHazard hazard;
    if (options.sampling.loads_others() && algorithm.traces_own_targets) {
        hazard.refusal = Refusal{"layer counts when it loads another sample", "",
                                 "use dual_independent, which compares in the same way", algorithm.name};
        return hazard;
    }
    Renderer renderer{request};
    std::vector<RegionTrace> traces;
    RenderResult result = renderer.render_traced(algorithm, traces);
    hazard.refusal = result.refusal;
    if (hazard.refusal) return hazard;
    hazard.passes = result.frame.passes.geometry;
    hazard.picture = std::move(result.frame.color);
    std::vector<Primitives> primitives;
    std::vector<std::vector<bool>> wrong;
    const std::size_t pixels = static_cast<std::size_t>(options.width) * static_cast<std::size_t>(options.height);
    int limit = 0;
    const std::vector<std::vector<LayerFragment>> layers = layers_of(request, algorithm);
    for (std::size_t s = 0; s < layers.size(); ++s) {
        primitives.push_back(primitives_of(layers[s], pixels));
        wrong.push_back(add_sample(hazard, options, layers[s], without_ties(traces_of(traces, s))));
        for (const auto& pixel : primitives.back()) limit = std::max(limit, 2 * static_cast<int>(pixel.size()) + 2);
    }
    for (std::size_t p = 0; p < pixels; ++p) {
        const auto count = static_cast<std::uint64_t>(
            std::ranges::count_if(wrong, [p](const std::vector<bool>& sample) { return sample[p]; }));
        if (count == 0) continue;
        switch (edge_of(primitives, p)) {
            case SampleEdge::silhouette: hazard.at_silhouettes += count; break;
            case SampleEdge::inner_edge: hazard.at_inner_edges += count; break;
            case SampleEdge::inside: hazard.inside += count; break;
        }
    }
    hazard.programs = program_count(primitives, options.raster.interpolation != rasterizer::Interpolation::sample);
    hazard.ended = hazard.passes < limit;
    return hazard;
}

}  // namespace strata::peeling
