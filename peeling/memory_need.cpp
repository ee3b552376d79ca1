// peeling/memory_need.cpp - estimates the memory of a frame from a rehearsal at the size of one tile (memory_need.h).
#include "peeling/memory_need.h"

#include <algorithm>
#include <array>
#include <vector>

#include "peeling/registry.h"
#include "peeling/render.h"
#include "pipeline/device/profile.h"
#include "pipeline/region/region.h"
#include "pipeline/region/region_shortcuts.h"
#include "pipeline/vertices/draw_list.h"
#include "rasterizer/base/parallel.h"

namespace strata::peeling {

using namespace pipeline;

namespace {

constexpr int side_px = 64;  // of the rehearsal frame: the default tile size
constexpr int block_px = 8;  // of the blocks whose density is measured
constexpr std::uint64_t word_bytes = 4;
// vertex_bytes: a transformed vertex with its share of set-up. triangle_bytes: a set-up triangle, and its entries in
// the bins of a few tiles.
constexpr std::uint64_t vertex_bytes = 32, triangle_bytes = 64;
// captured_bytes: a recorded fragment with its depth, its colour and its sorted words. listed_bytes: a fragment in a
// pixel's list. audited_bytes: a fragment's trace entry and its list entry in the audit.
constexpr std::uint64_t captured_bytes = 80, listed_bytes = 32, audited_bytes = 64;

// Fragments per pixel: the mean of the region, and the mean of its densest block.
struct Density {
    double mean = 0, most = 0;
};

// Coverage of the rehearsal frame's pixels at sample 0; its tile may run in parts, and a part more than once.
class Coverage {
  public:
    void put(Region& region) {
        std::vector<std::uint32_t> own(region.elements());
        RegionShortcuts{region}.count_coverage(own);
        const auto width = static_cast<std::size_t>(region.rect().width());
        for (std::size_t i = 0; i < region.rect().area(); ++i)
            fragments_[(static_cast<std::size_t>(region.rect().y0) + i / width) * side +
                       static_cast<std::size_t>(region.rect().x0) + i % width] = own[i];
    }
    [[nodiscard]] Density density() const {
        constexpr auto block = static_cast<std::size_t>(block_px);
        std::array<std::uint64_t, side * side / (block * block)> blocks{};
        std::uint64_t all = 0;
        for (std::size_t i = 0; i < fragments_.size(); ++i) {
            blocks[i / side / block * (side / block) + i % side / block] += fragments_[i];
            all += fragments_[i];
        }
        return {static_cast<double>(all) / static_cast<double>(fragments_.size()),
                static_cast<double>(std::ranges::max(blocks)) / static_cast<double>(block * block)};
    }

  private:
    static constexpr auto side = static_cast<std::size_t>(side_px);
    std::array<std::uint32_t, side * side> fragments_{};
};

struct Rehearsal {
    bool is_refused = false, is_tiled = false, is_replayed = false;
    std::uint64_t target_words = 0;  // per pixel
    std::uint64_t layers = 0;
    Density density;
    int channels = 4;
};

// Renders the frame at the size of one tile. Whether it is tiled follows from the full frame's execution, because a
// whole frame needs other targets than a tile.
Rehearsal rehearse(const FrameRequest& request, const Algorithm& algorithm) {
    Rehearsal found;
    RenderOptions small = request.options;
    small.width = small.height = side_px;
    small.window_origin = {0, 0};
    small.tile_size = side_px;
    small.threads = 1;
    small.audit = false;
    Coverage coverage;
    Algorithm watched = algorithm;
    watched.body = [&, body = body_of(algorithm, {request.options.algorithm, {}})](Region& region) {
        body(region);
        found.target_words = std::max(found.target_words, RegionShortcuts{region}.target_words());
        coverage.put(region);
    };
    Renderer renderer{request.with(small)};
    const RenderResult result = renderer.render(watched);
    found.is_refused = result.outcome == Outcome::refused;
    found.is_tiled = result.frame.work.tile_size != 0;
    found.is_replayed = found.is_tiled && algorithm.draws_again();
    found.density = coverage.density();
    found.layers = result.frame.layers.size();
    found.channels = result.frame.color.channels();
    return found;
}

// The memory of the fragments of `pixels` pixels that are processed together, at most `limit`.
std::uint64_t fragment_bytes(const Rehearsal& found, std::uint64_t pixels, std::uint64_t bytes_each,
                             std::uint64_t limit) {
    // A tile may be the densest part of the view; a whole frame has the mean density.
    const double density = found.is_tiled ? found.density.most : found.density.mean;
    const double bytes = density * static_cast<double>(pixels) * static_cast<double>(bytes_each);
    return bytes < static_cast<double>(limit) ? static_cast<std::uint64_t>(bytes) : limit;
}

}  // namespace

MemoryNeed memory_need(const FrameRequest& request, const Algorithm& algorithm) {
    const RenderOptions& options = request.options;
    const Rehearsal found = rehearse(request, algorithm);
    MemoryNeed need;
    if (found.is_refused) return need;
    const auto samples = static_cast<std::uint64_t>(options.sampling.samples);
    const std::uint64_t pixels =
        std::uint64_t{static_cast<unsigned>(options.width)} * static_cast<unsigned>(options.height);
    const auto channels = static_cast<std::uint64_t>(found.channels);
    const bool keeps_samples = samples > 1 && (options.audit || options.keep_samples);
    need.pictures =
        pixels * word_bytes * (channels * (keeps_samples ? samples + 1 : 1) + (options.nearest_depth ? 1 : 0));

    const auto tile = static_cast<std::uint64_t>(tile_size_of(options, algorithm));
    const std::uint64_t region = found.is_tiled ? tile * tile : pixels;
    const std::uint64_t at_once =
        found.is_tiled ? std::min<std::uint64_t>(static_cast<std::uint64_t>(thread_count(options.threads)),
                                                 (pixels + region - 1) / region)
                       : 1;
    need.targets = at_once * samples * region * word_bytes * (found.target_words + (options.nearest_depth ? 1 : 0));
    // The layers of the regions, and those of the frame that are assembled from them.
    need.layers = 2 * found.layers * pixels * word_bytes * (channels + 1);

    const std::uint64_t list_limit = std::max(options.fragment_memory, least_audit_memory);
    const auto kept = [&](std::uint64_t bytes_each, std::uint64_t limit) {
        return fragment_bytes(found, samples * at_once * region, bytes_each, limit);
    };
    if (options.audit) need.fragments += kept(audited_bytes, list_limit);
    if (algorithm.is_oracle) need.fragments += kept(listed_bytes, list_limit);
    if (found.is_replayed) need.fragments += kept(captured_bytes, options.fragment_memory);
    for (const Instance& instance : request.list.instances) {
        const Mesh& mesh = request.list.meshes[instance.mesh];
        need.triangles += mesh.positions.size() * vertex_bytes + mesh.indices.size() / 3 * triangle_bytes;
    }
    need.triangles *= samples;
    return need;
}

}  // namespace strata::peeling
