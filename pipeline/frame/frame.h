// pipeline/frame/frame.h - everything that is the same for all regions of one run: the machine, the lists, the formats,
// the options.
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

// The arrays and the memory that replay may take for a region's fragments. Texture coordinates are not among its needs:
// colours are kept shaded.
struct Replay {
    std::uint64_t bytes = 0;            // a region; 0: every pass rasterizes
    rasterizer::FragmentNeeds needs{};  // what the algorithm's passes look at, all together
    std::uint64_t bytes_a_fragment =
        0;  // what one takes there: tiles are cut until theirs fit (tile_parts.h); 0: nothing is said
};

struct PreparedDraw;
struct ShadowStage;

struct Frame {
    const DeviceProfile* profile = nullptr;
    const PreparedDraw* opaque = nullptr;
    const PreparedDraw* transparent = nullptr;
    const PreparedDraw* second = nullptr;  // what second_list() is, binned alike; null: `transparent`
    rasterizer::DepthRequest depth;  // the frame's depth buffer: path and format, and the path that programs compare
    CompareEpsilon epsilon;          // what programs add to a stored depth before they compare
    bool quantize_reference = true;  // false: they compare a depth that is not rounded like the stored one
    DepthKey key = DepthKey::stored_code;
    Format color_format = Format::rgba8;
    std::optional<Format> published_format;  // of what the body publishes, if it is another
    std::optional<Format> back_format;       // of the colour that far layers are blended onto, if it is another
    Rgba background{0, 0, 0, 1};             // premultiplied
    Termination termination;
    Formulation formulation = Formulation::resolved;
    int max_passes = 0;  // geometry passes; 0: no limit
    Effects effects = Effects::needed;
    bool alike_where_blank =
        false;  // a promise: what the body does where nothing is drawn depends on a tile's size, not on its place
    bool needs_frame = false;             // its texture lookups go anywhere: literal, whatever execution is asked for
    const ShadowStage* shadow = nullptr;  // for lists that receive a shadow (pipeline/textures/shadow_stage.h)
    Replay replay;
    bool keep_layers = false;
    bool trace = false;
    std::uint64_t trace_bytes = ~std::uint64_t{0};  // what a region's trace may take (pipeline/frame/trace.h)
    std::uint64_t list_bytes =
        ~std::uint64_t{0};        // what an algorithm without a machine may keep of a region's fragments
    bool checks_targets = false;  // report infinity and NaN in any colour target, not in the published one alone
    bool nearest_depth = false;   // also make the frame's Z
    Format average_count = Format::r16f;  // weighted_average's fragment count: r16f as in the paper, or r32f

    [[nodiscard]] rasterizer::Rect rect() const noexcept;  // of its viewport

    // The list that passes draw again and again, and replay captures: the first one only begins a peel that has a
    // second.
    [[nodiscard]] const PreparedDraw* repeated() const noexcept { return second != nullptr ? second : transparent; }

    // How depths that this frame compares are computed and stored.
    [[nodiscard]] rasterizer::DepthRequest key_request() const noexcept {
        if (key == DepthKey::shader_z) return {rasterizer::DepthPath::float32, DepthFormat::d32f, depth.reference};
        return depth;
    }
    [[nodiscard]] DepthCompare depth_compare() const noexcept {
        const rasterizer::DepthRequest request = key_request();
        return {request.format, epsilon, request.reference.value_or(request.path) != request.path, quantize_reference};
    }
    // Of what a last quad stores, and of what layers are blended onto from behind.
    [[nodiscard]] Format picture_format() const noexcept { return published_format.value_or(color_format); }
    [[nodiscard]] Format behind_format() const noexcept { return back_format.value_or(color_format); }
    // Whether alpha is 1 everywhere, as nothing that is drawn lowers it.
    [[nodiscard]] bool is_opaque() const noexcept { return background[3] == 1.0f; }
    // The list that passes of a peel draw: `second`, where the same triangles come by another way.
    [[nodiscard]] const PreparedDraw& second_list() const noexcept {
        return second != nullptr ? *second : *transparent;
    }
    // Every pass sees the same fragments, and compares the depth that it stores: what resolves rest on.
    [[nodiscard]] bool is_invariant() const noexcept { return second == nullptr && depth_compare().is_plain(); }
};

}  // namespace strata::pipeline
