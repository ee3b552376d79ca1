// tools/lab/probe/search/fields.cpp - decides which fields of a profile have an effect beside the others, which values
// are tried, and in which groups (fields.h).
#include "tools/lab/probe/search/fields.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

namespace strata::probe {

namespace {

using rasterizer::ClipVolume;
using rasterizer::ColorInterpolation;
using rasterizer::CoverageRule;
using rasterizer::DepthPath;
using rasterizer::PerspectiveColor;
using rasterizer::PlaneRule;
using rasterizer::RasterRules;
using rasterizer::WeightRule;
using rasterizer::WindowZ;
using rasterizer::WindowZRule;

// True if fragments outside the depth range are discarded by the NV2A's window z, whichever depth is stored
// (depth_range.cpp).
bool drops_by_window_z(const RasterRules& r) {
    return r.z_clip == rasterizer::ZClip::per_fragment && r.window_z == WindowZ::buffer_units;
}
bool has_window_z(const RasterRules& r) { return r.depth_path == DepthPath::window_z || drops_by_window_z(r); }
bool is_chip_depth(const RasterRules& r) { return has_window_z(r) && r.hypothesis.window_z == WindowZRule::chip; }
bool has_color_weights(const RasterRules& r) {
    return r.color == ColorInterpolation::weights_8bit && r.plane_rule == PlaneRule::exact;
}
bool has_weights(const RasterRules& r) { return is_chip_depth(r) || has_color_weights(r); }
bool has_cut_reciprocal(const RasterRules& r) {
    return (has_weights(r) && r.hypothesis.weights == WeightRule::cut_edges) ||
           (has_color_weights(r) && r.interpolation.perspective_color == PerspectiveColor::cut_products);
}

// Fields that only have an effect together with others.
struct Dependence {
    std::string_view key;
    bool (*matters)(const RasterRules&);
};
constexpr Dependence dependences[]{
    {"raster.tie_rule", [](const RasterRules& r) { return r.coverage == CoverageRule::snapped_edges; }},
    {"raster.guard_band_px", [](const RasterRules& r) { return r.clip == ClipVolume::guard_band; }},
    {"raster.plane_corners", [](const RasterRules& r) { return r.plane_rule == PlaneRule::greatest_w; }},
    {"raster.perspective", [](const RasterRules& r) { return r.plane_rule != PlaneRule::exact; }},
    {"raster.offset_rule", [](const RasterRules& r) { return r.depth_path == DepthPath::window_z; }},
    {"raster.window_z_rule", has_window_z},
    {"raster.plane_anchor", [](const RasterRules& r) { return r.depth_path == DepthPath::float32_plane; }},
    {"raster.interpolant_bits", [](const RasterRules& r) { return r.depth_path == DepthPath::perspective_rq; }},
    {"raster.divide", [](const RasterRules& r) { return r.depth_path == DepthPath::perspective_rq; }},
    {"raster.weights", has_weights},
    {"raster.reciprocal_bits", has_weights},
    {"raster.reciprocal_deficit", has_cut_reciprocal},
    {"raster.sum_bits", is_chip_depth},
    {"raster.vertex_color_bits", has_color_weights},
    {"raster.perspective_color", has_color_weights},
    {"raster.color", [](const RasterRules& r) { return r.plane_rule == PlaneRule::exact; }},
    {"raster.equal_colors", [](const RasterRules& r) { return r.plane_rule != PlaneRule::exact; }},
    {"raster.area_sign", [](const RasterRules& r) { return r.coverage == CoverageRule::snapped_edges; }},
};

constexpr Unprobed unprobed[]{
    {"raster.w_signs", "of window positions, which no client of the kit can give"},
    {"raster.w_slope", "of a w buffer, which OpenGL has not"},
    {"raster.quantize_reference", "of a program's comparison, which no scene makes"},
    {"raster.texture_coordinates", "no scene has a texture"},
    {"raster.perspective_coordinates", "no scene has a texture"},
    {"texture_filter", "no scene has a texture"},
    {"fog", "no scene has fog"},
    {"lighting", "no scene has lights"},
    {"raster.lines", "no scene has lines"},
    {"raster.points", "no scene has points"},
    {"raster.sample_divisor", "no scene has several samples per pixel"},
    {"sample_positions", "no scene has several samples per pixel"},
    {"resolve", "no scene has several samples per pixel"},
    {"alpha_to_coverage", "no scene has several samples per pixel"},
    {"centroid", "no scene has several samples per pixel"},
    {"sample_coverage", "no scene has several samples per pixel"},
};

// True if a triangle has a channel of one value at its corners: planes stepped in binary32 may move it.
bool has_constant(const Draw& draw) {
    for (std::size_t first = 0; first + 2 < draw.corners.size(); first += 3)
        for (std::size_t c = 0; c < 4; ++c) {
            const auto value = [&](std::size_t corner) { return draw.corners[first + corner].front[c]; };
            if (value(0) == value(1) && value(0) == value(2)) return true;
        }
    return false;
}

}  // namespace

const ProfileField& field(std::string_view key) {
    const auto fields = pipeline::profile_fields();
    const auto found = std::ranges::find(fields, key, &ProfileField::key);
    assert(found != fields.end() && "a key of profile_fields()");
    return *found;
}

bool matters(std::string_view key, const DeviceProfile& profile) {
    // Tiles in binary32 do not round each blend.
    if (key == "blend_rounding" && profile.blend_storage != pipeline::BlendStorage::target) return false;
    const auto* const found = std::ranges::find(dependences, key, &Dependence::key);
    return found == std::end(dependences) || found->matters(profile.raster);
}

bool can_change(std::string_view key, const Item& item) {
    const auto any_draw = [&](auto has) { return std::ranges::any_of(item.draws, has); };
    const auto any_corner = [&](auto has) {
        return any_draw([&](const Draw& draw) { return std::ranges::any_of(draw.corners, has); });
    };
    const auto is_one_of = [&](std::initializer_list<std::string_view> keys) {
        return std::ranges::find(keys, key) != keys.end();
    };
    // Polygon offset may move depths out of the depth range.
    const bool has_offset = any_draw([](const Draw& draw) { return draw.offset.enabled; });
    if (is_one_of({"raster.clip", "raster.plane_corners", "raster.guard_band_px", "raster.z_clip", "raster.w_clip"}))
        return any_corner([](const ClipVertex& v) {
                   return !(std::abs(v.x) <= v.w && std::abs(v.y) <= v.w && std::abs(v.z) <= v.w && v.w > 0);
               }) ||
               (key == "raster.z_clip" && has_offset);
    if (is_one_of({"raster.depth_path", "raster.window_z", "raster.depth_rounding", "raster.depth_limits",
                   "raster.window_z_rule", "raster.plane_anchor", "raster.sum_bits", "raster.interpolant_bits",
                   "raster.divide"}))
        return item.depth.has_value();
    if (key == "raster.equal_colors") return any_draw(has_constant);
    if (key == "depth24") return item.depth == DepthFormat::d24;
    if (is_one_of({"raster.offset_unit", "raster.offset_rule"})) return item.depth && has_offset;
    if (key == "alpha_test") return any_draw([](const Draw& draw) { return draw.alpha_above.has_value(); });
    const bool blends = any_draw([](const Draw& draw) { return draw.blend.has_value(); });
    const bool is_unorm = item.color == pipeline::Format::rgba8;
    if (key == "blend_rounding") return blends && is_unorm;
    if (key == "blend_storage") return blends && item.color != pipeline::Format::rgba32f;
    if (key == "min_max_nan" || key == "denormals") return blends && !is_unorm;
    if (key == "half_rounding") return item.color == pipeline::Format::rgba16f;
    if (key == "unorm_rounding") return is_unorm;
    return true;
}

bool is_reported(std::string_view key) {
    return key.starts_with("has_") || key.starts_with("max_") || key == "min_samples" || key == "origin" ||
           key == "clip_depth" || key == "depth_order";
}

std::span<const Unprobed> unprobed_fields() { return unprobed; }

std::vector<const ProfileField*> probed_fields() {
    std::vector<const ProfileField*> fields;
    for (const ProfileField& f : pipeline::profile_fields()) {
        const bool is_unprobed = std::ranges::find(unprobed, f.key, &Unprobed::key) != std::end(unprobed);
        if (!is_reported(f.key) && !is_unprobed) fields.push_back(&f);
    }
    return fields;
}

// A guard band has too many values for a list: guard_band_search.h searches it.
std::vector<int> searched_values(const ProfileField& f, int current) {
    std::vector<int> values{current};
    if (f.key == "raster.guard_band_px") return values;
    for (int value = f.lowest; value <= f.highest; value += f.step)
        if (value != current) values.push_back(value);
    return values;
}

// No frame of the kit is larger than 512 pixels, and a guard band inside the frame is not valid. Paths that need a
// texture shader or a w buffer cannot draw a kit.
bool is_valid(const DeviceProfile& profile) {
    const RasterRules& r = profile.raster;
    if (r.depth_path == DepthPath::depth_replace || r.depth_path == DepthPath::w_buffer) return false;
    if (is_written_by_program(r.depth_path)) return false;
    if (r.depth_path == DepthPath::window_z && r.window_z != WindowZ::buffer_units) return false;
    if (pipeline::conflict_of(profile)) return false;
    if (r.coverage == CoverageRule::float_spans && is_chip_depth(r)) return false;
    if (r.depth_path == DepthPath::perspective_rq && !profile.has_fragment_programs) return false;
    return r.guard_band_px >= 512;
}

const std::vector<FieldGroup>& field_groups() {
    static const std::vector<FieldGroup> groups{
        {"coverage",
         Part::coverage,
         {"coverage."},
         // A position that is truncated depends on the direction of y.
         {"raster.coverage", "raster.subpixel_bits", "raster.snap", "raster.tie_rule", "raster.y_axis"},
         {"raster.area_sign"}},
        {"positions", Part::coverage, {"positions.edges"}, {"raster.w_divide", "raster.viewport", "raster.y_axis"}},
        {"depth",
         Part::depth,
         {"depth."},
         {"raster.depth_path", "raster.window_z_rule", "raster.plane_rule", "raster.plane_origin", "raster.window_z",
          "raster.depth_rounding", "raster.plane_anchor"},
         {"raster.weights", "raster.reciprocal_bits", "raster.reciprocal_deficit", "raster.sum_bits",
          "raster.interpolant_bits", "raster.divide", "depth24", "raster.y_axis", "raster.tie_rule"}},
        // Float depths depend on the last bit of a position, if the depth rule is known, and the reverse.
        {"positions in depth",
         Part::depth,
         {"positions.", "depth."},
         {"raster.w_divide", "raster.viewport", "raster.y_axis"},
         {"raster.subpixel_bits", "raster.snap", "raster.plane_rule", "raster.plane_origin", "raster.depth_rounding",
          "raster.interpolant_bits", "raster.divide"}},
        {"colours",
         Part::color,
         {"color."},
         {"raster.plane_rule", "raster.color", "raster.plane_origin", "raster.perspective", "unorm_rounding",
          "raster.perspective_color"},
         {"raster.vertex_color_bits", "raster.weights", "raster.reciprocal_bits", "raster.reciprocal_deficit",
          "half_rounding", "raster.subpixel_bits", "raster.snap", "raster.equal_colors"}},
        {"clip",
         Part::both,
         {"clip.guard-band", "clip.", "positions."},
         {"raster.clip", "raster.z_clip", "raster.w_clip", "raster.viewport", "raster.depth_limits",
          "raster.plane_corners"},
         {"raster.window_z_rule", "raster.weights", "raster.sum_bits", "raster.reciprocal_bits",
          "raster.reciprocal_deficit"}},
        {"offset", Part::depth, {"offset."}, {"raster.offset_unit", "raster.offset_rule"}, {"raster.depth_limits"}},
        {"blending", Part::color, {"blend.products", "blend.over"}, {"blend_rounding", "blend_storage"}},
        {"halves", Part::color, {"color.halves"}, {"half_rounding"}},
        {"extremes", Part::color, {"blend.max", "blend.min"}, {"min_max_nan"}},
        {"denormals", Part::color, {"blend.small"}, {"denormals"}},
        {"alpha", Part::color, {"alpha."}, {"alpha_test"}},
    };
    return groups;
}

}  // namespace strata::probe
