// rasterizer/set_up/check_input.cpp - the checks of check_input.h, field by field.
#include "rasterizer/set_up/check_input.h"

#include <algorithm>
#include <limits>
#include <span>

#include "rasterizer/base/require.h"
#include "rasterizer/coverage/pixel_steps.h"
#include "rasterizer/coverage/sample_rectangle.h"

namespace strata::rasterizer {
namespace {

void check_size(const Requirements& state, const char* field, float px) {
    if (!(px >= 0.0f && px <= greatest_size_px)) state.fail(FieldName{field}, "0 to 65536", px);
}

void check_viewport(const Requirements& state, const Rect& v) {
    state.within("viewport.x0", v.x0, 0, greatest_coordinate_px);
    state.within("viewport.y0", v.y0, 0, greatest_coordinate_px);
    state.within("viewport.x1", v.x1, v.x0, greatest_coordinate_px);
    state.within("viewport.y1", v.y1, v.y0, greatest_coordinate_px);
}

// Far outside every viewport, but small enough to be translated without overflow in an int.
void check_scissor(const Requirements& state, const Rect& s) {
    constexpr int most = 1 << 30;
    state.within("scissor.x0", s.x0, -most, most);
    state.within("scissor.y0", s.y0, -most, most);
    state.within("scissor.x1", s.x1, -most, most);
    state.within("scissor.y1", s.y1, -most, most);
}

// Every number must be below `limit`.
void check_numbers(const Requirements& soup, const char* list, std::span<const std::uint32_t> numbers,
                   std::uint64_t limit) {
    std::uint32_t greatest = 0;
    for (const std::uint32_t n : numbers) greatest = std::max(greatest, n);
    if (numbers.empty() || greatest < limit) return;
    const auto wrong = std::ranges::find_if(numbers, [limit](std::uint32_t n) { return n >= limit; });
    soup.below({list, static_cast<std::size_t>(wrong - numbers.begin())}, *wrong, limit);
}

// r and q take two values of a vertex, fog one, secondary colours eight and the texture units sixteen; there may be
// other values before those of the units.
void check_extras(const Requirements& soup, const VertexExtras& extras, std::size_t vertices) {
    const std::size_t needed = (extras.has_rq ? 2 : 0) + (extras.has_fog ? 1 : 0) +
                               (extras.has_secondary ? 2 * color_channels : 0) +
                               (extras.has_units ? 4 * texture_units : 0);
    soup.within("extras.stride", extras.stride, needed, max_extras);
    if (extras.values.size() != extras.stride * vertices)
        soup.fail(FieldName{"extras.values"},
                  std::to_string(extras.stride) + " numbers for each of " + std::to_string(vertices) + " vertices",
                  extras.values.size());
}

}  // namespace

void check(const RasterState& state) {
    const Requirements its{"raster state"};
    check_viewport(its, state.viewport);
    if (state.scissor) check_scissor(its, *state.scissor);
    if (state.sample) {
        its.within("sample.x", state.sample->x, 0, 15);
        its.within("sample.y", state.sample->y, 0, 15);
    }
    its.listed("interpolation", state.interpolation);
    if (state.interpolation != Interpolation::sample && !state.sample)
        its.fail(FieldName{"interpolation"}, "sample, because the frame has no sample position",
                 static_cast<int>(state.interpolation));
    const SampleCoverage& coverage = state.sample_coverage;
    if (coverage.value && !(*coverage.value >= 0 && *coverage.value <= 1))
        its.fail(FieldName{"sample_coverage.value"}, "a number from 0 to 1", *coverage.value);
    const bool is_centroid = state.interpolation == Interpolation::centroid;
    its.within("sample_count", state.sample_count, is_centroid ? 1 : 0, static_cast<int>(state.samples.size()));
    for (std::size_t i = 0; i < static_cast<std::size_t>(state.sample_count); ++i) {
        its.within({"samples.x", i}, state.samples[i].x, 0, 15);
        its.within({"samples.y", i}, state.samples[i].y, 0, 15);
    }
    its.finite("depth_near", state.depth_near);
    its.finite("depth_far", state.depth_far);
    its.finite("w_scale", state.w_scale);
    its.finite("log_scale", state.log_scale);
    its.finite("polygon_offset.factor", state.polygon_offset.factor);
    its.finite("polygon_offset.units", state.polygon_offset.units);
    its.within("clip_plane_count", state.clip_plane_count, 0, static_cast<int>(state.clip_planes.size()));
    for (std::size_t i = 0; i < static_cast<std::size_t>(state.clip_plane_count); ++i) {
        const ClipPlane& plane = state.clip_planes[i];
        for (const float value : {plane.a, plane.b, plane.c, plane.d}) its.finite({"clip_planes", i}, value);
    }
    check_size(its, "line_width_px", state.line_width_px);
    check_size(its, "point_size_px", state.point_size_px);
    if (state.line_stipple) its.within("line_stipple.factor", state.line_stipple->factor, 1, 256);
    its.listed("line_style", state.line_style);
    if (state.line_style == LineStyle::thin && state.line_width_px != 1.0f)
        its.fail(FieldName{"line_width_px"}, "1 with line_style thin", state.line_width_px);
    its.listed("clip_depth", state.clip_depth);
    its.listed("depth_order", state.depth_order);
    its.listed("y_direction", state.y_direction);
    its.listed("cull", state.cull);
    its.listed("front_face", state.front_face);
    its.listed("depth_format", state.depth_format);
}

void check(const TriangleSoup& soup) {
    const Requirements its{"triangle soup"};
    constexpr std::uint64_t most = std::numeric_limits<std::uint32_t>::max();
    its.within("vertices", std::uint64_t{soup.vertices.size()}, 0, most);
    check_extras(its, soup.extras, soup.vertices.size());
    check_numbers(its, "indices", soup.indices, soup.vertices.size());
    std::uint64_t triangles = 0;
    for (std::size_t i = 0; i < soup.runs.size(); ++i) {
        const TriangleRun& run = soup.runs[i];
        its.listed({"runs", i, "primitive"}, run.primitive);
        if (run.index_count % 3 != 0) its.fail(FieldName{"runs", i, "index_count"}, "a multiple of 3", run.index_count);
        if (run.lent == nullptr && std::uint64_t{run.first_index} + run.index_count > soup.indices.size())
            its.fail(FieldName{"runs", i}, "an end within " + std::to_string(soup.indices.size()) + " indices",
                     std::uint64_t{run.first_index} + run.index_count);
        triangles += run.index_count / 3;
    }
    its.within("runs", triangles, 0, most);
    its.within("order", std::uint64_t{soup.order.size()}, 0, most);
    check_numbers(its, "order", soup.order, triangles);
}

void check(const TriangleSoup& soup, const RasterState& state, const RasterRules& rules) {
    if (state.smooth_polygons && (rules.lines != LineRule::band || state.sample))
        throw InputError("raster state", "smooth_polygons", "false, because the rules have none", "true");
    for (std::size_t i = 0; i < soup.runs.size(); ++i) {
        const Shape shape = shape_of(soup.runs[i].primitive);
        if (shape == Shape::triangle) continue;
        const std::string primitive = FieldName{"runs", i, "primitive"}.text();
        const std::string found = shape == Shape::line ? "lines" : "points";
        const auto require = [&](bool is_met, const std::string& expected) {
            if (!is_met) throw InputError("triangle soup", primitive, expected, found);
        };
        require(draws(rules, soup.runs[i].primitive), "triangles, because the rules have no " + found);
        require(shape != Shape::line || state.line_style == LineStyle::band || rules.lines == LineRule::band,
                "line_style band, because the rules have no other");
        require(shape != Shape::line || !state.line_stipple || has_line_stipple(rules, soup.runs[i].primitive),
                "no line_stipple, because the rules have none for these lines");
        require(!state.polygon_stipple || !is_drawn_by_triangles(shape, state, rules),
                "triangles with polygon_stipple, because the rules draw it as two of them");
        require(!state.sample || covers_samples(rules, soup.runs[i].primitive),
                "triangles, because the frame has sample positions");
        require(!state.sample || !state.line_stipple || shape != Shape::line,
                "no line_stipple, because the frame has sample positions");
        require(state.interpolation == Interpolation::sample, "triangles, because values are not those of the samples");
    }
}

}  // namespace strata::rasterizer
