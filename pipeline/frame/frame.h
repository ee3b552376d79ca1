// pipeline/frame/frame.h - everything that is the same for all regions of one run: device, lists, formats and options.
#pragma once
#include <cstdint>
#include <optional>

#include "pipeline/device/profile.h"
#include "pipeline/frame/run_settings.h"
#include "pipeline/stages/depth_compare.h"
#include "pipeline/vertices/draw_list.h"
#include "rasterizer/coverage/fragment_batch.h"
#include "rasterizer/rules/raster_state.h"

namespace strata::pipeline {

// The arrays and the memory that replay may use for a region's fragments. Texture coordinates are not among its needs,
// because colours are stored after shading.
struct Replay {
    std::uint64_t bytes = 0;            // per region; 0: every pass rasterizes
    rasterizer::FragmentNeeds needs{};  // union of the needs of the algorithm's passes
    std::uint64_t bytes_per_fragment =
        0;  // bytes per fragment of a record: tiles are split until their fragments fit (tile_parts.h); 0: unknown
};

struct Fog;
struct PreparedDraw;
struct ShadowStage;

// Every sample of a pixel is an element of the frame's targets, and what a pass does with a fragment it does at each
// sample that the fragment covers.
struct Frame {
    const DeviceProfile* profile = nullptr;
    const PreparedDraw* opaque = nullptr;
    const PreparedDraw* transparent = nullptr;  // its number of samples is the frame's
    const PreparedDraw* second = nullptr;  // see second_list(); has the same bins as `transparent`; null: `transparent`
    rasterizer::DepthRequest depth;  // the frame's depth buffer (path and format), and the path that programs compare
    CompareEpsilon epsilon;          // added by programs to a stored depth before they compare
    bool compares_at_pixel = false;  // programs compare, once a pixel: not a sample's stored depth
    bool quantize_reference = true;  // false: programs compare a depth that is not rounded like the stored one
    DepthKey key = DepthKey::stored_code;
    Format color_format = Format::rgba8;
    std::optional<Format> published_format;  // of the published target, if it differs
    std::optional<Format> back_format;       // of the colour onto which far layers are blended, if it differs
    Rgba background{0, 0, 0, 1};             // premultiplied
    Termination termination;
    Formulation formulation = Formulation::resolved;
    int max_passes = 0;  // limit of geometry passes; 0: none
    Effects effects = Effects::needed;
    bool blank_tiles_are_equal = false;   // a promise: in a tile without triangles the body's result depends on the
                                          // tile's size but not on its position
    bool needs_frame = false;             // texture lookups may reach any pixel: always runs literally
    const ShadowStage* shadow = nullptr;  // for lists that receive a shadow (pipeline/textures/shadow_stage.h)
    const Fog* fog = nullptr;             // for lists with fog (pipeline/vertices/fog.h)
    Replay replay;
    bool keep_layers = false;
    bool trace = false;
    std::uint64_t trace_bytes = ~std::uint64_t{0};  // limit of a region's trace (pipeline/frame/trace.h)
    std::uint64_t list_bytes =
        ~std::uint64_t{0};  // limit of the fragments of a region that an algorithm without an emulated device stores
    bool checks_targets = false;  // report infinity and NaN in every colour target, not only in the published one
    bool nearest_depth = false;   // also produce the frame's depth image
    LoadedSample loads = LoadedSample::own;       // of geometry passes: of peels
    LoadedSample composites = LoadedSample::own;  // of full-screen passes
    Resolve resolve = Resolve::box;               // of the picture and of layers, which quincunx does not filter
    bool keep_samples = false;                    // also return the picture of every sample
    Format average_count = Format::r16f;          // weighted_average's fragment count: r16f as in the paper, or r32f

    [[nodiscard]] rasterizer::Rect rect() const noexcept;  // the rectangle of its viewport
    [[nodiscard]] int samples() const noexcept;            // of a pixel
    // True if what a program reads at a sample may be what another sample has stored.
    [[nodiscard]] bool loads_others() const noexcept {
        return samples() > 1 && (loads != LoadedSample::own || composites != LoadedSample::own);
    }

    // The list that passes draw repeatedly and that replay records. With a second list, the first one only starts a
    // peel.
    [[nodiscard]] const PreparedDraw* repeated() const noexcept { return second != nullptr ? second : transparent; }

    // The path and format of the depths that this frame compares.
    [[nodiscard]] rasterizer::DepthRequest key_request() const noexcept {
        using rasterizer::DepthPath;
        if (key != DepthKey::shader_z) return depth;
        // A program that writes the logarithm peels by it, too.
        const bool is_log = depth.path == DepthPath::logarithmic;
        return {is_log ? DepthPath::logarithmic : DepthPath::float32, DepthFormat::d32f, depth.reference};
    }
    [[nodiscard]] DepthCompare depth_compare() const noexcept {
        const rasterizer::DepthRequest request = key_request();
        const bool has_reference = request.reference.value_or(request.path) != request.path ||
                                   (compares_at_pixel && key == DepthKey::stored_code);
        return {request.format, epsilon, has_reference, quantize_reference};
    }
    // The formats of the target of a final quad, and of the target onto which layers are blended from behind.
    [[nodiscard]] Format picture_format() const noexcept { return published_format.value_or(color_format); }
    [[nodiscard]] Format behind_format() const noexcept { return back_format.value_or(color_format); }
    // True if the background's alpha is 1: then alpha is 1 everywhere, because drawing never lowers it.
    [[nodiscard]] bool is_opaque() const noexcept { return background[3] == 1.0f; }
    // The list that passes of a peel draw: `second` if the same triangles are transformed by another path.
    [[nodiscard]] const PreparedDraw& second_list() const noexcept {
        return second != nullptr ? *second : *transparent;
    }
    // True if every pass has the same fragments and compares the depth that it stores; resolves require this.
    [[nodiscard]] bool is_invariant() const noexcept { return second == nullptr && depth_compare().is_plain(); }
};

}  // namespace strata::pipeline
