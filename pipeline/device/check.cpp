// pipeline/device/check.cpp - one rule per feature, and the checks of check.h that apply them.
#include "pipeline/device/check.h"

#include <array>
#include <utility>
#include <vector>

#include "rasterizer/base/enum_values.h"

namespace strata::pipeline {
namespace {

// The description and the extension of a Refusal, and the profile's field (pipeline/reference/devices.md 9.1).
struct FeatureRule {
    Feature feature;
    std::string_view words, extension;
    bool DeviceProfile::*has;
};

constexpr std::array feature_rules{
    FeatureRule{Feature::d16, "16-bit depth buffers", "", &DeviceProfile::has_d16},
    FeatureRule{Feature::d24, "24-bit depth buffers", "", &DeviceProfile::has_d24},
    FeatureRule{Feature::d32f, "float depth buffers", "ARB_depth_buffer_float", &DeviceProfile::has_d32f},
    FeatureRule{Feature::float_targets, "float render targets that blend", "ARB_color_buffer_float",
                &DeviceProfile::has_float_targets},
    FeatureRule{Feature::unclamped_depth_clear, "unclamped depth clears", "NV_depth_buffer_float",
                &DeviceProfile::has_unclamped_depth_clear},
    FeatureRule{Feature::fragment_programs, "fragment programs that discard after a compare", "ARB_fragment_program",
                &DeviceProfile::has_fragment_programs},
    FeatureRule{Feature::separate_alpha_blend, "separate blend functions for alpha", "EXT_blend_func_separate",
                &DeviceProfile::has_separate_alpha_blend},
    FeatureRule{Feature::independent_blend, "independent blend equations", "ARB_draw_buffers_blend",
                &DeviceProfile::has_independent_blend},
    FeatureRule{Feature::two_sided_stencil, "two-sided stencil", "EXT_stencil_two_side",
                &DeviceProfile::has_two_sided_stencil},
    FeatureRule{Feature::depth_clamp, "depth clamping", "ARB_depth_clamp", &DeviceProfile::has_depth_clamp},
    FeatureRule{Feature::depth_replace, "depth replace by texture shaders", "NV_texture_shader",
                &DeviceProfile::has_depth_replace},
    FeatureRule{Feature::sequential_depth_units, "sequential depth units", "STRATA_depth_units",
                &DeviceProfile::has_sequential_depth_units},
    FeatureRule{Feature::ordered_rmw, "ordered read-modify-write of render targets", "STRATA_ordered_rmw",
                &DeviceProfile::has_ordered_rmw},
    FeatureRule{Feature::signed_blend, "signed blend equations", "", &DeviceProfile::has_signed_blend},
    FeatureRule{Feature::d16f, "16-bit float depth buffers", "", &DeviceProfile::has_d16f},
    FeatureRule{Feature::narrow_surfaces, "surfaces of 15 and 16 bits or without alpha", "",
                &DeviceProfile::has_narrow_surfaces},
    FeatureRule{Feature::d24f, "24-bit float depth buffers", "", &DeviceProfile::has_d24f},
    FeatureRule{Feature::unordered_access, "buffers that a program writes and changes atomically",
                "ARB_shader_storage_buffer_object", &DeviceProfile::has_unordered_access},
    FeatureRule{Feature::logic_op, "logical operations on colours", "", &DeviceProfile::has_logic_op},
};

constexpr bool rules_follow_the_enum() {
    std::size_t i = 0;
    for (const Feature feature : enum_values<Feature>)
        if (i >= feature_rules.size() || feature_rules[i++].feature != feature) return false;
    return i == feature_rules.size();
}
static_assert(rules_follow_the_enum(), "feature_rules has a rule for every Feature, in its order");

const FeatureRule& rule(Feature feature) { return feature_rules[static_cast<std::size_t>(feature)]; }

// "use geforce8 or ideal": the built-in profiles for which `can` is true. User profiles are not known here.
std::string way_out(auto can) {
    std::vector<std::string> names;
    for (const DeviceProfile& profile : builtin_profiles())
        if (can(profile)) names.push_back(profile.name);
    std::string text;
    for (std::size_t i = 0; i < names.size(); ++i)
        text += (i == 0 ? "use " : i + 1 == names.size() ? " or " : ", ") + names[i];
    return text;
}

// Checks a number that a profile limits.
std::optional<Refusal> check_limit(const DeviceProfile& profile, int DeviceProfile::*limit, int wanted,
                                   const std::string& feature, const std::string& extension) {
    if (wanted <= profile.*limit) return std::nullopt;
    return Refusal{feature, extension, way_out([&](const DeviceProfile& p) { return wanted <= p.*limit; })};
}

// True if the blends can be used in one pass without independent blending: they must share factors, equations and
// constant; write masks and enables may differ.
bool shares_terms(const Blend& a, const Blend& b) {
    return a.color == b.color && a.alpha == b.alpha && a.constant == b.constant;
}

}  // namespace

std::string Refusal::message(const DeviceProfile& profile) const {
    std::string text =
        (algorithm.empty() ? "profile " + profile.name : "algorithm " + algorithm) + " has no " + feature;
    if (!extension.empty()) text += " (" + extension + ")";
    if (!way_out.empty()) text += "; " + way_out;
    return text;
}

bool has(const DeviceProfile& profile, Feature feature) { return profile.*rule(feature).has; }

std::optional<Refusal> check(const DeviceProfile& profile, Feature feature) {
    if (has(profile, feature)) return std::nullopt;
    const FeatureRule& missing = rule(feature);
    return Refusal{std::string{missing.words}, std::string{missing.extension},
                   way_out([&](const DeviceProfile& p) { return has(p, feature); })};
}

std::optional<Refusal> check(const DeviceProfile& profile, std::span<const Feature> needed) {
    for (const Feature feature : needed)
        if (std::optional<Refusal> refusal = check(profile, feature)) return refusal;
    return std::nullopt;
}

std::optional<Refusal> check(const DeviceProfile& profile, rasterizer::Primitive primitive) {
    const rasterizer::Shape shape = shape_of(primitive);
    const auto can = [primitive](const DeviceProfile& p) { return draws(p.raster, primitive); };
    if (can(profile)) return std::nullopt;
    return Refusal{std::string{"known rule for "} + (shape == rasterizer::Shape::line ? "lines" : "points") +
                       (is_of_polygon(primitive) ? " of polygons" : ""),
                   "", way_out(can)};
}

std::optional<Refusal> check(const DeviceProfile& profile, DepthFormat format) {
    switch (format) {
        case DepthFormat::d16: return check(profile, Feature::d16);
        case DepthFormat::d24: return check(profile, Feature::d24);
        case DepthFormat::d32f: return check(profile, Feature::d32f);
        case DepthFormat::d16f: return check(profile, Feature::d16f);
        case DepthFormat::d24f: break;
    }
    return check(profile, Feature::d24f);
}

std::optional<Refusal> check(const DeviceProfile& profile, Format target) {
    if (is_depth(target)) return check(profile, depth_format(target));
    const ChannelType type = info(target).type;
    // Devices that blend float targets blend packed ones; r11g11b10f is itself a float format.
    if (is_packed(target) && type != ChannelType::half && !has(profile, Feature::float_targets))
        return Refusal{"blended colour format " + std::string{info(target).name}, "",
                       way_out([](const DeviceProfile& p) { return p.has_float_targets; })};
    if (type == ChannelType::half || type == ChannelType::single) return check(profile, Feature::float_targets);
    if (is_narrow(target)) return check(profile, Feature::narrow_surfaces);
    return std::nullopt;
}

std::optional<Refusal> check(const DeviceProfile& profile, const StencilTest& state) {
    if (state.enabled && state.two_sided) return check(profile, Feature::two_sided_stencil);
    return std::nullopt;
}

std::optional<Refusal> check(const DeviceProfile& profile, const Blend& state) {
    const auto is_signed = [](const BlendTerm& term) {
        return term.equation == BlendEquation::signed_add || term.equation == BlendEquation::signed_reverse_subtract;
    };
    if (state.logic_op) return check(profile, Feature::logic_op);  // which disables blending
    if (state.enabled && (is_signed(state.color) || is_signed(state.alpha)))
        if (std::optional<Refusal> refusal = check(profile, Feature::signed_blend)) return refusal;
    if (state.enabled && state.color != state.alpha) return check(profile, Feature::separate_alpha_blend);
    return std::nullopt;
}

std::optional<Refusal> check(const DeviceProfile& profile, std::span<const Blend> targets) {
    const int count = static_cast<int>(targets.size());
    if (std::optional<Refusal> refusal =
            check_limit(profile, &DeviceProfile::max_render_targets, count,
                        std::to_string(count) + " render targets in one pass", "ARB_draw_buffers"))
        return refusal;
    // The first target that blends: all other blending targets are compared with it.
    const Blend* first = nullptr;
    for (const Blend& target : targets) {
        if (std::optional<Refusal> refusal = check(profile, target)) return refusal;
        if (!target.enabled) continue;
        if (first != nullptr && !shares_terms(*first, target))
            if (std::optional<Refusal> refusal = check(profile, Feature::independent_blend)) return refusal;
        if (first == nullptr) first = &target;
    }
    return std::nullopt;
}

// A program may compare r/q on every device; only a texture shader replaces depth (devices.md 9.2).
std::optional<Refusal> check_reference(const DeviceProfile& profile, rasterizer::DepthPath compared) {
    if (compared == rasterizer::DepthPath::depth_replace) return check(profile, Feature::depth_replace);
    return std::nullopt;
}

// Without programs r/q can be compared but not written: depth replace is the only stage that writes it.
std::optional<Refusal> check(const DeviceProfile& profile, rasterizer::DepthPath written) {
    if (written == rasterizer::DepthPath::perspective_rq && !profile.has_fragment_programs)
        return Refusal{"fragment programs that write a depth", "ARB_fragment_program",
                       "use depth path depth_replace, which writes the same depth"};
    if (rasterizer::is_written_by_program(written) && !profile.has_fragment_programs)
        return Refusal{"fragment programs that write a depth", "ARB_fragment_program",
                       way_out([](const DeviceProfile& p) { return p.has_fragment_programs; })};
    return check_reference(profile, written);
}

std::optional<Refusal> check_depth_clear(const DeviceProfile& profile, DepthFormat format, float value) {
    const bool is_clamped = value >= 0.0f && value <= 1.0f;
    // Fixed-point formats clamp the value, so the device needs no feature.
    if (format != DepthFormat::d32f || is_clamped) return std::nullopt;
    return check(profile, Feature::unclamped_depth_clear);
}

std::optional<Refusal> check_size(const DeviceProfile& profile, int width_px, int height_px) {
    const int larger = width_px > height_px ? width_px : height_px;
    return check_limit(profile, &DeviceProfile::max_viewport_px, larger,
                       "viewport of " + std::to_string(width_px) + " x " + std::to_string(height_px) + " pixels", "");
}

std::optional<Refusal> check_samples(const DeviceProfile& profile, int samples) {
    return check_limit(profile, &DeviceProfile::max_samples, samples, std::to_string(samples) + " samples per pixel",
                       "ARB_multisample");
}

std::optional<Refusal> check_multisampling(const DeviceProfile& profile, int samples) {
    // Devices with float spans have no sample positions: their binary32 positions cannot be moved exactly.
    const auto has = [samples](const DeviceProfile& p) {
        return samples >= p.min_samples && samples <= p.max_samples &&
               p.raster.coverage == rasterizer::CoverageRule::snapped_edges;
    };
    if (samples == 1 || has(profile)) return std::nullopt;
    return Refusal{std::to_string(samples) + " samples per pixel", "ARB_multisample", way_out(has)};
}

std::optional<Refusal> check_interpolation(const DeviceProfile& profile, rasterizer::Interpolation interpolation) {
    const auto is_known = [](const DeviceProfile& p) {
        return p.raster.color == rasterizer::ColorInterpolation::exact_plane &&
               p.raster.interpolation.texture_coordinates == rasterizer::CoordinateRule::exact_plane;
    };
    if (interpolation != rasterizer::Interpolation::centre || is_known(profile)) return std::nullopt;
    return Refusal{"measured colours at pixel centres outside the triangle", "",
                   way_out(is_known) + ", or --interpolate centroid"};
}

std::optional<Refusal> check_texture_units(const DeviceProfile& profile, int units) {
    return check_limit(profile, &DeviceProfile::max_texture_units, units, std::to_string(units) + " texture units",
                       "ARB_multitexture");
}

}  // namespace strata::pipeline
