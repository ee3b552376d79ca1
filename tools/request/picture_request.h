// tools/request/picture_request.h - what a user asks of a picture, before the profile and the scene are read: one
// field for each option of option_fields.h.
//
// Rule     Defaults are those of scenes/reference/reports.md 6. A value that the profile or the scene completes is
//          optional, and empty unless it is asked for.
#pragma once
#include <optional>
#include <string>

#include "peeling/multisampling.h"
#include "peeling/render_options.h"
#include "pipeline/device/profile.h"
#include "scenes/scene.h"
#include "tools/request/values.h"

namespace strata::tools {

// Options that commands declare together and --help lists together. Result bits depend on all groups up to `order`.
enum class OptionGroup : std::uint8_t {
    origin,
    reading,
    view,
    depth,
    targets,
    algorithm,
    shading,
    samples,
    order,
    execution,
    resources,
    measures
};

// True if no bit of a result depends on the options of the group.
[[nodiscard]] constexpr bool keeps_bits(OptionGroup group) noexcept { return group > OptionGroup::order; }

struct PictureRequest {
    scenes::SceneOptions scene_options{};
    std::optional<pipeline::Origin> origin{};             // empty: the profile's
    std::optional<rasterizer::ClipDepth> clip_depth{};    // empty: a pack's, else the profile's
    std::optional<rasterizer::DepthOrder> depth_order{};  // likewise
    std::string camera{};  // a camera of the scene or a file; empty: the view is an orbit
    std::optional<Orbit> orbit{};
    bool states_size = false;                    // --size is given
    std::optional<pipeline::Rgba> background{};  // sRGB, not premultiplied; empty: the default, black or a pack's
    // Without what depends on the profile and the scene: clip convention, background, samples and the place of shading.
    peeling::RenderOptions render{};
    peeling::Multisampling sampling{};
    std::optional<int> sample{};                             // the frame of this sample alone
    bool shades_pixels = false;                              // per-pixel instead of per-sample shading
    std::optional<rasterizer::Interpolation> interpolate{};  // of per-pixel shading: centre or centroid
};

}  // namespace strata::tools
