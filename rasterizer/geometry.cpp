#include "rasterizer/geometry.h"

#include <algorithm>
#include <cassert>
#include <numeric>

#include "rasterizer/float_environment.h"
#include "rasterizer/parallel.h"
#include "rasterizer/setup.h"

namespace strata::rasterizer {
namespace {

constexpr std::size_t chunk_triangles = 4096;

struct Chunk {
    std::vector<SetupTriangle> triangles;
    SetupCounters counters;
};

// Where each run's triangles begin in the soup's listing; one entry more than there are runs.
[[nodiscard]] std::vector<std::uint32_t> run_starts(const TriangleSoup& soup) {
    std::vector<std::uint32_t> start{0};
    for (const TriangleRun& run : soup.runs) start.push_back(start.back() + run.index_count / 3);
    return start;
}

[[nodiscard]] SourceTriangle source_triangle(const TriangleSoup& soup, std::span<const std::uint32_t> starts,
                                             std::uint32_t number, std::uint32_t primitive) {
    const auto after = std::upper_bound(starts.begin(), starts.end(), number);
    const auto run_number = static_cast<std::size_t>(after - starts.begin()) - 1;
    const TriangleRun& run = soup.runs[run_number];
    const std::size_t first = run.first_index + std::size_t{3} * (number - starts[run_number]);
    const auto vertex = [&](std::size_t i) {
        assert(soup.indices[first + i] < soup.vertices.size() && "indices name vertices of the soup");
        return &soup.vertices[soup.indices[first + i]];
    };
    return {{vertex(0), vertex(1), vertex(2)}, number, primitive, &run};
}

void add(SetupCounters& sum, const SetupCounters& part) {
    if (sum.non_finite == 0) sum.first_non_finite = part.first_non_finite;
    sum.triangles_in += part.triangles_in;
    sum.culled += part.culled;
    sum.clipped += part.clipped;
    sum.outside += part.outside;
    sum.degenerate += part.degenerate;
    sum.non_finite += part.non_finite;
}

// The chunks' triangles in one array, in order; each chunk is freed as soon as it is copied.
[[nodiscard]] std::vector<SetupTriangle> concatenated(std::vector<Chunk>& chunks) {
    std::size_t count = 0;
    for (const Chunk& chunk : chunks) count += chunk.triangles.size();
    std::vector<SetupTriangle> all;
    all.reserve(count);
    for (Chunk& chunk : chunks) {
        all.insert(all.end(), chunk.triangles.begin(), chunk.triangles.end());
        std::vector<SetupTriangle>{}.swap(chunk.triangles);
    }
    return all;
}

}  // namespace

Geometry set_up(const TriangleSoup& soup, const RasterState& state, const RasterRules& rules, int threads) {
    const FloatEnvironment ours;
    const TriangleSetup setup{state, rules};
    const std::vector<std::uint32_t> starts = run_starts(soup);
    const std::size_t count = soup.order.empty() ? starts.back() : soup.order.size();
    std::vector<Chunk> chunks((count + chunk_triangles - 1) / chunk_triangles);
    parallel_for(chunks.size(), threads, [&](std::size_t c) {
        const std::size_t end = std::min(count, (c + 1) * chunk_triangles);
        chunks[c].triangles.reserve(end - c * chunk_triangles);
        for (std::size_t i = c * chunk_triangles; i < end; ++i) {
            const auto primitive = static_cast<std::uint32_t>(i);
            const std::uint32_t number = soup.order.empty() ? primitive : soup.order[i];
            setup.add(source_triangle(soup, starts, number, primitive), chunks[c].triangles, chunks[c].counters);
        }
    });
    Geometry geometry;
    geometry.state = state;
    geometry.rules = rules;
    for (const Chunk& chunk : chunks) add(geometry.counters, chunk.counters);
    geometry.triangles = concatenated(chunks);
    geometry.all_triangles.resize(geometry.triangles.size());
    std::iota(geometry.all_triangles.begin(), geometry.all_triangles.end(), 0u);
    return geometry;
}

}  // namespace strata::rasterizer
