// peeling/render_options.h - the options of a frame: size, formats, depths, orders and execution.
#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "peeling/multisampling.h"
#include "peeling/programs/algorithm_options.h"
#include "peeling/sort.h"
#include "pipeline/device/vertex_path.h"
#include "pipeline/formats/format.h"
#include "pipeline/frame/run_settings.h"
#include "pipeline/stages/depth_compare.h"
#include "pipeline/vertices/draw_list.h"
#include "pipeline/vertices/fog.h"
#include "rasterizer/base/simd.h"
#include "rasterizer/rules/raster_state.h"

namespace strata::pipeline {
struct VertexAlteration;  // pipeline/vertices/prepare.h
}

namespace strata::peeling {

struct Algorithm;

inline constexpr int tile_sizes[] = {8, 16, 32, 64, 128};
inline constexpr std::uint64_t least_audit_memory = std::uint64_t{16} << 20;

// How the first pass of a peel computes its positions (default: as the view says), and how later passes do (default: as
// the first).
struct VertexPaths {
    std::optional<pipeline::VertexPath> first{}, second{};
    friend bool operator==(const VertexPaths&, const VertexPaths&) = default;
};

// The result's bits depend on all fields except execution, fragment_memory, tile_size, threads, simd and effects.
// audit, keep_layers, keep_samples and nearest_depth add results without changing the image.
struct RenderOptions {
    int width = 1024, height = 1024;
    std::optional<pipeline::DepthFormat> depth{};           // default: d32f where the profile has it, else d24
    std::optional<rasterizer::DepthPath> depth_path{};      // default: the profile's
    std::optional<rasterizer::DepthPath> reference_path{};  // the depth that passes compare; default: the stored one
    pipeline::CompareEpsilon compare_epsilon{};             // added to a stored depth before the comparison
    bool quantize_reference =
        true;  // false: the compared depth is not rounded like the stored one; true: as the profile
    VertexPaths vertex_paths{};
    const pipeline::DrawList* second_list = nullptr;  // for passes after the first: surfaces split differently
    std::optional<bool> second_depth_clamp{};         // the depth clamp of passes after the first
    std::optional<pipeline::Format> color_format{};   // default: rgba8; rgba32f on a profile with exact depth ("ideal")
    std::optional<pipeline::Format> result_format{};  // of the final image; default: color_format
    std::optional<pipeline::Format> back_format{};    // of dual's back and of its layers; default: color_format
    std::optional<float> alpha{};           // draws all materials as transparent, with their own alpha times this
    pipeline::Rgba background{0, 0, 0, 1};  // premultiplied, like images over an alpha below 1
    std::optional<pipeline::Fog> fog{};     // of all surfaces, not of the background
    std::optional<std::vector<pipeline::Light>> lights{};  // default: the list's
    pipeline::LightModel light_model{};                    // where there are lights
    pipeline::Termination termination{};
    pipeline::Formulation formulation = pipeline::Formulation::resolved;
    Sort sort{};                        // the order in which triangles are submitted
    std::vector<std::string> sorted{};  // meshes or materials in front-to-back order, for hybrid; adds to the scene's
    std::vector<std::string> offset_only{};  // meshes or materials that raster.polygon_offset moves; empty: all
    int max_passes = 0;
    pipeline::Execution execution = pipeline::Execution::replay;
    // Memory limit of replay for recorded fragments, in bytes. The audit has the same limit, but at least
    // least_audit_memory.
    std::uint64_t fragment_memory = std::uint64_t{256} << 20;
    std::optional<int> tile_size{};  // pixels; default: tile_size_of
    int threads = 0;
    Simd simd = Simd::best;  // of all kernels of this renderer
    pipeline::Effects effects = pipeline::Effects::needed;
    pipeline::Format average_count = pipeline::Format::r16f;
    AlgorithmOptions algorithm{};  // options of single algorithms
    bool counters = false;         // count fragments by outcome, and bytes: the frame then runs literally
    bool keep_layers = false;
    bool keep_samples = false;  // the picture of every sample
    bool audit = true;          // order_errors and the other comparisons with a_buffer
    bool nearest_depth = true;  // also render the depth image
    // The viewport's corner on its surface, in pixels; positions are translated by it exactly.
    std::array<int, 2> window_origin{0, 0};
    // Conventions as the image shows them; raster_state.h converts them to those of memory. The viewport is set from
    // width, height and window_origin.
    rasterizer::RasterState raster{};
    // With one sample, raster.sample is its point, and without that fragments are evaluated at the pixel's centre.
    Multisampling sampling{};
    const pipeline::VertexAlteration* vertex_alteration = nullptr;  // must outlive the renderer; may be null
};

// True if the algorithm's lists are those of pixels, which have several samples.
[[nodiscard]] bool has_pixel_lists(const Algorithm& algorithm, const RenderOptions& options) noexcept;
// True if the algorithm's resolve reads the fragments once, so that their memory is needed only for the tiles in
// progress.
[[nodiscard]] bool is_closed(const RenderOptions& options, const Algorithm& algorithm) noexcept;
[[nodiscard]] int tile_size_of(const RenderOptions& options, const Algorithm& algorithm) noexcept;
// The tile size of the algorithm's frame in pixels: the requested one, else 64, or 128 for an algorithm of one pass in
// a frame with many tiles, where triangles are divided among fewer tiles. (More passes keep more data per pixel, which
// should fit into the caches.)

}  // namespace strata::peeling
