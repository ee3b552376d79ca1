// tools/request/device_fields.cpp - the options of the device's state, of what ends a peel, and of the order of
// triangles.
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "rasterizer/set_up/check_input.h"
#include "tools/request/choices.h"
#include "tools/request/groups.h"
#include "tools/request/light_words.h"
#include "tools/request/make_field.h"

namespace strata::tools {

namespace {

using peeling::Algorithm;
using peeling::RenderOptions;
using rasterizer::RasterState;

// A termination rule of peeling/reference/keys-and-counts.md 3.1, with its ratio or number of passes.
std::optional<pipeline::Termination> to_termination(std::string_view text) {
    using enum pipeline::TerminationRule;
    if (text == "exact") return pipeline::Termination{.rule = exact};
    if (text == "paper") return pipeline::Termination{.rule = paper};
    if (text == "any") return pipeline::Termination{.rule = any};
    if (text.starts_with("ratio:")) {
        const auto value = to_number<double>(text.substr(6));
        if (value && *value >= 0 && *value <= 1) return pipeline::Termination{.rule = ratio, .ratio = *value};
    }
    if (text.starts_with("fixed:")) {
        const auto value = to_int(text.substr(6));
        if (value && *value >= 1) return pipeline::Termination{.rule = fixed, .passes = *value};
    }
    return std::nullopt;
}

std::string termination_text(const pipeline::Termination& termination) {
    const std::string rule{enum_name(termination.rule)};
    if (termination.rule == pipeline::TerminationRule::ratio) return fmt::format("{}:{}", rule, termination.ratio);
    if (termination.rule == pipeline::TerminationRule::fixed) return fmt::format("{}:{}", rule, termination.passes);
    return rule;
}

// A sort order of peeling/reference/keys-and-counts.md 5. A seed is any 64-bit number.
std::optional<peeling::Sort> to_sort(std::string_view text) {
    using enum peeling::SortRule;
    if (text == "none") return peeling::Sort{.rule = none};
    if (text == "exact") return peeling::Sort{.rule = exact};
    if (text == "reverse") return peeling::Sort{.rule = reverse};
    if (text.starts_with("bucket:")) {
        const auto buckets = to_int(text.substr(7));
        if (buckets && *buckets >= 1) return peeling::Sort{.rule = bucket, .buckets = *buckets};
    }
    if (text.starts_with("shuffle:")) {
        const auto parts = split(text.substr(8), ',');
        if (parts.size() != 2) return std::nullopt;
        const auto fraction = to_number<double>(parts[0]);
        const auto seed = to_int<std::uint64_t>(parts[1]);
        if (fraction && seed && *fraction >= 0 && *fraction <= 1)
            return peeling::Sort{.rule = shuffle, .fraction = *fraction, .seed = *seed};
    }
    return std::nullopt;
}

std::string sort_text(const peeling::Sort& sort) {
    const std::string rule{enum_name(sort.rule)};
    if (sort.rule == peeling::SortRule::bucket) return fmt::format("{}:{}", rule, sort.buckets);
    if (sort.rule == peeling::SortRule::shuffle) return fmt::format("{}:{},{}", rule, sort.fraction, sort.seed);
    return rule;
}

// FACTOR,UNITS. The offset is enabled even if both are zero. 2^24 units are the whole range of a D24 buffer.
std::optional<rasterizer::PolygonOffset> to_polygon_offset(std::string_view text) {
    const auto values = to_numbers<float>(text, 2);
    if (!values || std::fabs((*values)[0]) > 0x1p24f || std::fabs((*values)[1]) > 0x1p24f) return std::nullopt;
    return rasterizer::PolygonOffset{true, (*values)[0], (*values)[1]};
}

std::string polygon_offset_text(const rasterizer::PolygonOffset& offset) {
    return offset.enabled ? fmt::format("{},{}", offset.factor, offset.units) : "";
}

std::optional<std::vector<std::string>> to_names(std::string_view text) { return split(text, ','); }

std::string names_text(const std::vector<std::string>& names) { return fmt::format("{}", fmt::join(names, ",")); }

constexpr const char* size_expected = "a number of pixels from 0 to 65536";

std::optional<float> to_size_px(std::string_view text) {
    const auto px = to_number<float>(text);
    return px && !std::signbit(*px) && *px <= rasterizer::greatest_size_px ? px : std::nullopt;
}

// FACTOR,PATTERN: a whole number, and 16 bits in hexadecimal.
std::optional<rasterizer::LineStipple> to_line_stipple(std::string_view text) {
    const std::vector<std::string> parts = split(text, ',');
    if (parts.size() != 2 || parts[1].size() < 3 || parts[1].size() > 6 || !parts[1].starts_with("0x"))
        return std::nullopt;
    const auto factor = to_int(parts[0]);
    if (!factor || *factor < 1 || *factor > 256) return std::nullopt;
    rasterizer::LineStipple stipple{*factor, 0};
    const char* const end = parts[1].data() + parts[1].size();
    const auto read = std::from_chars(parts[1].data() + 2, end, stipple.pattern, 16);
    if (read.ec != std::errc{} || read.ptr != end) return std::nullopt;
    return stipple;
}

std::string line_stipple_text(const rasterizer::LineStipple& stipple) {
    return fmt::format("{},{:#06x}", stipple.factor, stipple.pattern);
}

std::string epsilon_text(const pipeline::CompareEpsilon& epsilon) {
    return epsilon.ulps != 0 ? fmt::format("{}ulp", epsilon.ulps) : fmt::format("{}", epsilon.absolute);
}

std::string vertex_paths_text(const peeling::VertexPaths& paths) {
    if (!paths.first) return "";
    const std::string first = name_of(vertex_paths(), *paths.first);
    return paths.second ? first + "," + name_of(vertex_paths(), *paths.second) : first;
}

std::string region_text(const rasterizer::Rect& rect) {
    return fmt::format("{},{},{},{}", rect.x0, rect.y0, rect.width(), rect.height());
}

// NEAR,FAR of glDepthRange, which OpenGL clamps to [0, 1].
bool set_depth_range(PictureRequest& request, std::string_view text) {
    const auto values = to_numbers<float>(text, 2);
    const auto is_share = [](float value) { return value >= 0 && value <= 1; };
    if (!values || !std::ranges::all_of(*values, is_share)) return false;
    request.render.raster.depth_near = (*values)[0];
    request.render.raster.depth_far = (*values)[1];
    return true;
}

void copy_depth_range(PictureRequest& to, const PictureRequest& from) {
    to.render.raster.depth_near = from.render.raster.depth_near;
    to.render.raster.depth_far = from.render.raster.depth_far;
}

std::string depth_range_text(const PictureRequest& request) {
    return fmt::format("{},{}", request.render.raster.depth_near, request.render.raster.depth_far);
}

// MODE,START,END or MODE,DENSITY, and the colour.
std::optional<pipeline::Fog> to_fog(std::string_view text) {
    const std::vector<std::string> parts = split(text, ',');
    pipeline::Fog fog;
    const auto mode = to_choice(fog_modes, parts[0]);
    if (!mode) return std::nullopt;
    fog.mode = *mode;
    const std::size_t distances = fog.mode == pipeline::FogMode::linear ? 2 : 1;
    std::vector<float> values;
    for (std::size_t k = 1; k < parts.size(); ++k) {
        const auto value = to_number<float>(parts[k]);
        if (!value) return std::nullopt;
        values.push_back(*value);
    }
    if (values.size() != distances && values.size() != distances + 3) return std::nullopt;
    if (distances == 2) fog.start = values[0], fog.end = values[1];
    if (distances == 1) fog.density = values[0];
    for (std::size_t c = 0; c + distances < values.size(); ++c) fog.color[c] = values[distances + c];
    return pipeline::fault_of(fog) ? std::nullopt : std::optional{fog};
}

std::string fog_text(const pipeline::Fog& fog) {
    const bool is_linear = fog.mode == pipeline::FogMode::linear;
    const std::string distances = is_linear ? fmt::format("{},{}", fog.start, fog.end) : fmt::format("{}", fog.density);
    const pipeline::Rgba& c = fog.color;
    const bool is_black = c[0] == 0 && c[1] == 0 && c[2] == 0;
    const std::string color = is_black ? "" : fmt::format(",{},{},{}", c[0], c[1], c[2]);
    return fmt::format("{},{}{}", name_of(fog_modes, fog.mode), distances, color);
}

// What passes compare and how positions are computed.
std::vector<OptionField> depth_fields() {
    using enum OptionGroup;
    const std::string paths = one_of(names_of(vertex_paths()));
    return {
        usual(choice<&PictureRequest::render, &RenderOptions::depth>(
            depth, "depth-format", depth_formats, "depth buffer (default d32f, or d24 where that is missing)")),
        choice<&PictureRequest::render, &RenderOptions::depth_path>(
            depth, "depth-path", depth_paths(), "how depth is computed (default: the profile's own)"),
        choice<&PictureRequest::render, &RenderOptions::reference_path>(
            depth, "reference-path", depth_paths(),
            "the depth that a peel compares with what it stored (default: the one that it stores)"),
        field<&PictureRequest::render, &RenderOptions::compare_epsilon>(
            depth,
            {"compare-epsilon", "E|Nulp", "added to a stored depth before a program compares it (default 0)",
             "a part of the depth range from 0 to 1 such as 1e-7, or units in the last place such as 2ulp"},
            to_epsilon, epsilon_text),
        flag<&PictureRequest::render, &RenderOptions::quantize_reference>(
            depth, "quantize-reference", "compare a depth that is not rounded like the stored one"),
        field<&PictureRequest::render, &RenderOptions::vertex_paths>(
            depth,
            {"vertex-path", "A[,B]",
             "how positions are computed, in the first pass and in further ones (default separate): " + paths,
             "one or two of " + paths},
            [](std::string_view text) { return to_vertex_paths(text, ','); }, vertex_paths_text),
        field<&PictureRequest::render, &RenderOptions::raster, &RasterState::polygon_offset>(
            depth,
            {"polygon-offset", "FACTOR,UNITS", "glPolygonOffset of triangles (default: off)",
             "two numbers such as 1,1, each from -16777216 to 16777216"},
            to_polygon_offset, polygon_offset_text),
        field<&PictureRequest::render, &RenderOptions::offset_only>(
            depth,
            {"only", "NAME[,NAME...]", "meshes or materials that --polygon-offset moves (default: everything)",
             "names of meshes or materials"},
            to_names, names_text),
        choice<&PictureRequest::depth_order>(
            depth, "depth-order", depth_orders,
            "the depth test that keeps the nearer fragment; greater: reversed depth, near at 1 "
            "(default: the profile's own)"),
        choice<&PictureRequest::clip_depth>(
            depth, "clip-depth", clip_depths,
            "where z of clip space begins; zero-to-one: glClipControl, Direct3D (default: the "
            "profile's own)"),
        joint(depth,
              {"depth-range", "NEAR,FAR", "glDepthRange: the depths of the near and of the far plane (default 0,1)",
               "two numbers from 0 to 1 such as 0,0.5"},
              set_depth_range, depth_range_text, copy_depth_range),
        number<&PictureRequest::render, &RenderOptions::raster, &RasterState::line_width_px>(
            depth, {"line-width", "PX", "glLineWidth: pixels across a line (default 1)", size_expected}, to_size_px),
        number<&PictureRequest::render, &RenderOptions::raster, &RasterState::point_size_px>(
            depth, {"point-size", "PX", "glPointSize: the sides of a point in pixels (default 1)", size_expected},
            to_size_px),
        field<&PictureRequest::render, &RenderOptions::raster, &RasterState::line_stipple>(
            depth,
            {"line-stipple", "FACTOR,PATTERN",
             "glLineStipple: of every 16 times FACTOR fragments along a line those whose bit is set, the lowest first "
             "(default: all)",
             "a whole number from 1 to 256 and 16 bits in hexadecimal such as 1,0x00ff"},
            to_line_stipple, line_stipple_text),
        flag<&PictureRequest::render, &RenderOptions::raster, &RasterState::point_sprites>(
            depth, "point-sprites", "GL_POINT_SPRITE: a texture covers each point's square"),
        field<&PictureRequest::render, &RenderOptions::raster, &RasterState::scissor>(
            depth,
            {"scissor", "X,Y,W,H",
             "glScissor: draw these pixels of the picture alone, counted from its top left corner",
             "four whole numbers such as 240,180,160,120, the last two above 0"},
            to_region, region_text),
    };
}

// The lights of a scene, and what they find on its surfaces.
std::vector<OptionField> light_fields() {
    using enum OptionGroup;
    return {
        usual(field<&PictureRequest::render, &RenderOptions::lights>(
            targets,
            {"lights", "none|LIGHT[/LIGHT...]",
             "glLight: up to eight of directional,DX,DY,DZ or point,X,Y,Z[,A0,A1,A2] or "
             "spot,X,Y,Z,DX,DY,DZ,CUTOFF[,EXPONENT[,A0,A1,A2]] in the scene's space, with color=R:G:B, ambient=R:G:B "
             "or range=D behind (default: the file's; with none a light at the eye)",
             "none, or lights with / between them, such as directional,0,-1,0/point,1,2,3,color=1:0.5:0"},
            to_lights, lights_text)),
        field<&PictureRequest::render, &RenderOptions::light_model>(
            targets,
            {"light-model", "PART[,PART...]",
             "glLightModel and the material of all surfaces: ambient=R:G:B, specular=R:G:B, shininess=N, "
             "emission=R:G:B, local-viewer, two-sided, separate-specular (default ambient=0.2:0.2:0.2)",
             "parts such as specular=1:1:1,shininess=32,two-sided"},
            to_light_model, light_model_text),
    };
}

// Fog, targets, and what ends a peel.
std::vector<OptionField> target_fields() {
    using enum OptionGroup;
    return {
        usual(field<&PictureRequest::render, &RenderOptions::fog>(
            targets,
            {"fog", "linear,START,END|exp,DENSITY|exp2,DENSITY[,R,G,B]",
             "glFog of all surfaces by their distance from the eye along the view, in units of the scene; the "
             "colour as it is blended (default: no fog)",
             "linear,START,END with two distances, or exp,DENSITY or exp2,DENSITY from 0, and a colour such as "
             "0.5,0.6,0.7 "
             "from 0 to 1 or none"},
            to_fog, fog_text)),
        choice<&PictureRequest::render, &RenderOptions::color_format>(
            targets, "color-format", color_formats, "colour target (default rgba8; rgba32f on ideal)"),
        choice<&PictureRequest::render, &RenderOptions::result_format>(
            targets, "result-format", color_formats,
            "the picture, where it is not kept as colours are that are composited (default: as --color-format)"),
        choice<&PictureRequest::render, &RenderOptions::back_format>(
            targets, "back-format", color_formats,
            "the back of dual and dual_independent (default: as --color-format, which is then that of the front)"),
        read_by({"weighted_average"}, choice<&PictureRequest::render, &RenderOptions::average_count>(
                                          targets, "average-count", count_formats,
                                          "fragment count of weighted_average (default r16f, as in the paper)")),
        field<&PictureRequest::render, &RenderOptions::termination>(
            targets,
            {"termination", "exact|paper|any|ratio:R|fixed:N", "what ends a peel (default exact)",
             "exact, paper, any, ratio:R with R from 0 to 1, or fixed:N with N from 1"},
            to_termination, termination_text),
        number<&PictureRequest::render, &RenderOptions::max_passes>(
            targets,
            {"max-passes", "N", "geometry passes at most (default 0: as many as it takes)", "a whole number from 0"},
            to_count),
    };
}

}  // namespace

std::vector<OptionField> device_fields() {
    std::vector<OptionField> all = depth_fields();
    std::ranges::move(light_fields(), std::back_inserter(all));
    std::ranges::move(target_fields(), std::back_inserter(all));
    return all;
}

std::vector<OptionField> order_fields() {
    using enum OptionGroup;
    return {
        read_if([](const Algorithm& algorithm) { return algorithm.has_published_form; },
                choice<&PictureRequest::render, &RenderOptions::formulation>(
                    order, "formulation", formulations,
                    "the listings of Carr et al. repaired, or as printed, with what they lose (default resolved)")),
        read_if([](const Algorithm& algorithm) { return algorithm.order == peeling::ListOrder::sets; },
                field<&PictureRequest::render, &RenderOptions::sorted>(
                    order,
                    {"sorted", "NAME[,NAME...]",
                     "meshes or materials that arrive front to back, for hybrid (default: those that the scene names)",
                     "names of meshes or materials"},
                    to_names, names_text)),
        field<&PictureRequest::render, &RenderOptions::sort>(
            order,
            {"sort", "bucket:N|exact|none|reverse|shuffle:F,SEED",
             "order of triangles, by centroid (default none: as listed)",
             "bucket:N with N from 1, exact, none, reverse, or shuffle:FRACTION,SEED with a fraction from 0 to 1"},
            to_sort, sort_text),
    };
}

}  // namespace strata::tools
