// pipeline/device/profile_conflicts.cpp - finds values of a profile that conflict (profile_fields.h).
#include "pipeline/device/profile_fields.h"

namespace strata::pipeline {

std::optional<FieldConflict> conflict_of(const DeviceProfile& profile) {
    using rasterizer::DepthPath;
    const rasterizer::RasterRules& rules = profile.raster;
    if (profile.blend_rounding == BlendRounding::unrounded_source && profile.has_signed_blend)
        return FieldConflict{"blend_rounding", "another with has_signed_blend", "unrounded_source"};
    // A peel might not terminate: binary32 values outside the range are stored as codes without an order.
    if (profile.depth24 == Depth24::binary32 && rules.depth_limits == rasterizer::DepthLimits::wrap)
        return FieldConflict{"depth24", "codes with raster.depth_limits wrap", "binary32"};
    if (rules.coverage != rasterizer::CoverageRule::float_spans) return std::nullopt;
    const auto beside = [](std::string_view other) {
        return FieldConflict{"raster.coverage", "snapped_edges with " + std::string{other}, "float_spans"};
    };
    if (rules.color == rasterizer::ColorInterpolation::weights_8bit) return beside("raster.color weights_8bit");
    if (rules.depth_path == DepthPath::window_z) return beside("raster.depth_path window_z");
    if (rules.depth_path == DepthPath::w_buffer) return beside("raster.depth_path w_buffer");
    if (rules.viewport == rasterizer::ViewportArithmetic::half_pixel_first)
        return beside("raster.viewport half_pixel_first");
    if (rules.y_axis == rasterizer::YAxis::clip) return beside("raster.y_axis clip");
    return std::nullopt;
}

}  // namespace strata::pipeline
