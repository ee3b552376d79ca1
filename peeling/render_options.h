// peeling/render_options.h - what a caller may choose for a frame: its size and formats, depths and orders, and how it
// is run.
#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "peeling/sort.h"
#include "pipeline/device/vertex_path.h"
#include "pipeline/formats/format.h"
#include "pipeline/frame/run_settings.h"
#include "pipeline/stages/depth_compare.h"
#include "pipeline/vertices/draw_list.h"
#include "rasterizer/base/simd.h"
#include "rasterizer/rules/raster_state.h"

namespace strata::pipeline {
struct VertexAlteration;  // pipeline/vertices/prepare.h
}

namespace strata::peeling {

struct Algorithm;

inline constexpr int tile_sizes[] = {8, 16, 32, 64, 128};
inline constexpr std::uint64_t least_audit_memory = std::uint64_t{16} << 20;

// How the first pass of a peel computes its positions (default: as the view says), and how further ones do (default:
// alike).
struct VertexPaths {
    std::optional<pipeline::VertexPath> first{}, second{};
    friend bool operator==(const VertexPaths&, const VertexPaths&) = default;
};

// The result bits depend on all fields but execution, fragment_memory, tile_size, threads, simd and effects. audit,
// keep_layers and nearest_depth add results without changing the picture.
struct RenderOptions {
    int width = 1024, height = 1024;
    std::optional<pipeline::DepthFormat> depth{};       // default: d32f where the profile has it, else d24
    std::optional<rasterizer::DepthPath> depth_path{};  // default: the profile's
    std::optional<rasterizer::DepthPath>
        reference_path{};                        // the depth that passes compare; default: the one that they store
    pipeline::CompareEpsilon compare_epsilon{};  // added to a stored depth before it is compared
    bool quantize_reference =
        true;  // false: compare a depth that is not rounded like the stored one; true: as the profile
    VertexPaths vertex_paths{};
    const pipeline::DrawList* second_list = nullptr;  // the same surfaces split otherwise, for all passes but the first
    std::optional<bool> second_depth_clamp{};         // and their depth clamp
    std::optional<pipeline::Format> color_format{};   // default: rgba8; rgba32f on a profile with exact depth ("ideal")
    std::optional<pipeline::Format> result_format{};  // of the picture; default: color_format
    std::optional<pipeline::Format> back_format{};    // of dual's back and its layers; default: color_format
    std::optional<float> alpha{};                     // draws everything as transparent, its own alpha times this
    pipeline::Rgba background{0, 0, 0, 1};  // premultiplied, as every picture is whose background lets light through
    pipeline::Termination termination{};
    pipeline::Formulation formulation = pipeline::Formulation::resolved;
    Sort sort{};  // the order in which triangles are submitted
    std::vector<std::string>
        sorted{};  // meshes or materials that arrive front to back, for hybrid; beside those that the scene names
    int max_passes = 0;
    pipeline::Execution execution = pipeline::Execution::replay;
    // Bytes that replay may hold in captured fragments; and the audit as many, but no fewer than least_audit_memory.
    std::uint64_t fragment_memory = std::uint64_t{256} << 20;
    std::optional<int> tile_size{};  // pixels; default: tile_size_of
    int threads = 0;
    Simd simd = Simd::best;  // of all kernels of this renderer
    pipeline::Effects effects = pipeline::Effects::needed;
    pipeline::Format average_count = pipeline::Format::r16f;
    bool counters = false;  // count fragments by their fates, and bytes: the frame then runs literally
    bool keep_layers = false;
    bool audit = true;          // order_errors and the other comparisons with the a_buffer
    bool nearest_depth = true;  // make the Z image
    // The viewport's corner on its surface, in pixels; positions move with it exactly.
    std::array<int, 2> window_origin{0, 0};
    // Conventions, as the picture shows them: raster_state.h makes them those of memory. The viewport is set from
    // width, height and window_origin.
    rasterizer::RasterState raster{};
    const pipeline::VertexAlteration* vertex_alteration = nullptr;  // outlives the renderer; null: none
};

// The side of the tiles of `algorithm`'s frame, in pixels: what was asked for, or else 64; 128 where one pass is all
// and the frame has many tiles: triangles are divided among fewer. (More passes keep more a pixel, and want it in the
// caches.) Whether fragments are visited once, by the algorithm's resolve, and what is kept of them lasts for a tile.
[[nodiscard]] bool is_closed(const RenderOptions& options, const Algorithm& algorithm) noexcept;
[[nodiscard]] int tile_size_of(const RenderOptions& options, const Algorithm& algorithm) noexcept;

}  // namespace strata::peeling
