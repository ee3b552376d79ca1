// Tests what set-up makes of lines and points: their values, clipping, facing, tiles and refusals.
#include <catch2/catch.hpp>

#include "rasterizer/base/input_error.h"
#include "rasterizer/set_up/depth_bound.h"
#include "tests/rasterizer/lines.h"
#include "tests/rasterizer/rational.h"

namespace {

using namespace strata::rasterizer;

const RasterRules ideal_shapes{.lines = LineRule::diamond_exit, .points = PointRule::square};
const RasterRules chip_shapes{.subpixel_bits = 4,
                              .snap = Snap::toward_zero,
                              .z_clip = ZClip::per_fragment,
                              .window_z = WindowZ::buffer_units,
                              .depth_path = DepthPath::window_z,
                              .depth_rounding = DepthRounding::floor,
                              .offset_rule = OffsetRule::fragments,
                              .color = ColorInterpolation::weights_8bit,
                              .lines = LineRule::band,
                              .points = PointRule::reciprocal};

std::vector<ClipVertex> random_shape_ends(Random& random, int count, bool has_perspective) {
    std::vector<ClipVertex> vertices;
    for (int i = 0; i < count; ++i) {
        ClipVertex v = random_vertex(random, has_perspective ? SoupKind::perspective : SoupKind::flat);
        v.z = random_float(random, -0.9f, 0.9f) * v.w;
        vertices.push_back(v);
    }
    return vertices;
}

// The weight of the second end at the centre of a fragment.
Rational line_weight(const Geometry& g, const Fragment& f) {
    const auto [first, a, b] = g.points(g.triangles[f.primitive]);
    const SubpixelPoint c = model_centre(f.x, f.y, g.rules.subpixel_bits);
    const Integer dx = b.x - a.x, dy = b.y - a.y;
    return Rational{dx * (c.x - a.x) + dy * (c.y - a.y)} / Rational{dx * dx + dy * dy};
}

std::string shape_refusal(Primitive primitive, RasterState state, const RasterRules& rules) {
    try {
        static_cast<void>(shapes({{}, {.x = 1}}, primitive, state, rules));
    } catch (const strata::InputError& e) {
        return e.what();
    }
    return {};
}

}  // namespace

TEST_CASE("depth and attributes of a line are its ends' values at the foot of the centre, rounded once") {
    Random random{1};
    const std::vector<ClipVertex> ends = random_shape_ends(random, 80, true);
    RasterState state = scene_state(line_window, line_window);
    state.line_width_px = 3;
    const Geometry g = shapes(ends, Primitive::lines, state, ideal_shapes);
    int wrong = 0;
    const DrawResult drawn = draw(g);
    for (const Fragment& f : drawn.fragments) {
        const TriangleRecord& record = g.triangles[f.primitive];
        const Rational t = line_weight(g, f);
        const WindowCorner &a = g.corners[record.vertex[1]], &b = g.corners[record.vertex[2]];
        const ClipVertex &va = g.vertices[record.vertex[1]], &vb = g.vertices[record.vertex[2]];
        wrong += f.shader_z != nearest_float((1 - t) * Rational{a.z} + t * Rational{b.z}) ? 1 : 0;
        const Rational wa = (1 - t) * Rational{a.inverse_w}, wb = t * Rational{b.inverse_w};
        const float red_w = va.front[0] * a.inverse_w, blue_w = vb.front[0] * b.inverse_w;
        const float above = nearest_float((1 - t) * Rational{red_w} + t * Rational{blue_w}),
                    below = nearest_float(wa + wb);
        wrong += f.color[0] != above / below ? 1 : 0;
    }
    CHECK(wrong == 0);
    CHECK(drawn.fragments.size() > 1000);
    CHECK(drawn.batches_are_sound);
}

TEST_CASE("NV2A's colours along a line have its 8-bit weights") {
    Random random{2};
    std::vector<ClipVertex> ends = random_shape_ends(random, 60, false);
    for (ClipVertex& v : ends) v.front[0] = static_cast<float>(random() % 256) / 255.0f;
    RasterState state = scene_state(line_window, line_window);
    state.depth_format = DepthFormat::d24;
    state.line_width_px = 4;
    const Geometry g = shapes(ends, Primitive::lines, state, chip_shapes);
    int wrong = 0, fragments = 0;
    for (const Fragment& f : draw(g, {DepthPath::window_z, DepthFormat::d24}).fragments) {
        const auto [first, a, b] = g.points(g.triangles[f.primitive]);
        const Integer length = Integer{b.x - a.x} * (b.x - a.x) + Integer{b.y - a.y} * (b.y - a.y);
        const Rational t = line_weight(g, f) * Rational{length};
        const std::array<Rational, 2> e{truncate_to_bits(length - t, 24), truncate_to_bits(t, 24)};
        const Rational sum = e[0] + e[1], r = 1 / sum;
        const bool is_power = sum == power(floor_log2(sum));
        const Rational cut = is_power ? r : truncate_to_bits(r * (1 - power(-31)), 29);
        std::array<Rational, 2> w{truncate_to_bits(e[0] * cut, 24), truncate_to_bits(e[1] * cut, 24)};
        const auto exponent = [](const Rational& v) { return v == 0 ? -1000 : floor_log2(v); };
        const std::size_t rest = exponent(w[1]) > exponent(w[0]) ? 1 : 0;
        w[rest] = 1 - w[1 - rest];
        const int second = floor(256 * w[1]).convert_to<int>();
        const TriangleRecord& record = g.triangles[f.primitive];
        const auto code = [&](std::size_t k) {
            return static_cast<int>(g.vertices[record.vertex[k]].front[0] * 255.0f + 0.5f);
        };
        const int expected = ((256 - second) * code(1) + second * code(2) + 128) >> 8;
        wrong += f.color[0] != static_cast<float>(expected) / 255.0f ? 1 : 0;
        ++fragments;
    }
    CHECK(wrong == 0);
    CHECK(fragments > 1000);
}

TEST_CASE("a point has its vertex' values") {
    Random random{3};
    const std::vector<ClipVertex> vertices = random_shape_ends(random, 50, true);
    RasterState state = scene_state(line_window, line_window);
    state.point_size_px = 5;
    const Geometry g = shapes(vertices, Primitive::points, state, ideal_shapes);
    const DrawResult drawn = draw(g);
    CHECK(drawn.fragments.size() > 500);
    for (const Fragment& f : drawn.fragments) {
        const std::uint32_t v = g.triangles[f.primitive].vertex[0];
        REQUIRE(f.shader_z == g.corners[v].z);
        REQUIRE(f.color == g.vertices[v].front);
        REQUIRE(f.front_facing);
    }
}

TEST_CASE("a line through the near plane is the line from there on") {
    RasterState state = scene_state(line_window, line_window);
    const ClipVertex a{.x = -0.75f, .y = -0.5f, .z = -2}, b{.x = 0.75f, .y = 0.25f, .z = 2};
    const ClipVertex from{.x = -0.375f, .y = -0.3125f, .z = -1}, to{.x = 0.375f, .y = 0.0625f, .z = 1};
    const Geometry cut = shapes({a, b}, Primitive::lines, state, ideal_shapes),
                   whole = shapes({from, to}, Primitive::lines, state, ideal_shapes);
    CHECK(draw(cut).fragments == draw(whole).fragments);
    CHECK(cut.counters.clipped == 1);
    const Geometry back = shapes({b, a}, Primitive::lines, state, ideal_shapes),
                   whole_back = shapes({to, from}, Primitive::lines, state, ideal_shapes);
    CHECK(draw(back).fragments == draw(whole_back).fragments);
    const Geometry behind =
        shapes({{.z = -2}, {.x = 1, .z = -3}, {.z = 0, .w = -1}, {.z = 2}}, Primitive::lines, state, ideal_shapes);
    CHECK(behind.triangles.empty());
    CHECK(behind.counters.outside == 2);
}

TEST_CASE("points outside of the depth range and lines without length are dropped and counted") {
    const RasterState state = scene_state(line_window, line_window);
    const Geometry points = shapes({{.z = -1.5f}, {.z = 0}, {.z = 1.5f}}, Primitive::points, state, ideal_shapes);
    CHECK(points.triangles.size() == 1);
    CHECK(points.counters.outside == 2);
    const Geometry dots = shapes({{.x = 0.5f}, {.x = 0.5f}}, Primitive::lines, state, ideal_shapes);
    CHECK(dots.counters.degenerate == 1);
    CHECK(dots.counters.triangles_in == 1);
}

TEST_CASE("lines and points do not depend on tiles, and no fragment is behind their depth bound") {
    Random random{4};
    for (const RasterRules& rules : {ideal_shapes, chip_shapes}) {
        RasterState state = scene_state(line_window, line_window);
        state.depth_format = DepthFormat::d24;
        state.line_width_px = state.point_size_px = 2.5f;
        const DepthRequest depth{rules.depth_path, DepthFormat::d24};
        for (const Primitive primitive : {Primitive::lines, Primitive::points}) {
            Geometry g = shapes(random_shape_ends(random, 200, true), primitive, state, rules);
            const std::vector<Fragment> whole = by_pixel(draw(g, depth).fragments);
            bin_triangles(g, 8);
            std::vector<Fragment> tiled;
            for (std::size_t t = 0; t + 1 < g.bin_start.size(); ++t) {
                const DrawResult tile = draw(g, depth, everything, tile_rect(g, t), g.bin(t));
                tiled.insert(tiled.end(), tile.fragments.begin(), tile.fragments.end());
            }
            CHECK(by_pixel(tiled) == whole);
            for (std::size_t i = 0; i < g.triangles.size(); ++i) {
                const double bound = depth_bound(g, std::span{g.all_triangles}.subspan(i, 1));
                for (const Fragment& f :
                     draw(g, depth, everything, g.state.viewport, std::span{g.all_triangles}.subspan(i, 1)).fragments)
                    REQUIRE(f.shader_z <= bound);
            }
        }
    }
}

TEST_CASE("a polygon's lines and points have its facing and are culled with it") {
    TriangleSoup soup;
    for (const auto& [x, y] : {std::pair{-0.5f, -0.5f}, {0.5f, -0.5f}, {0.0f, 0.5f}})
        soup.vertices.push_back({.x = x, .y = y, .front = {1, 0, 0, 1}, .back = {0, 1, 0, 1}});
    // Counterclockwise, clockwise, and without area.
    soup.indices = {0, 1, 2, 0, 2, 1, 0, 1, 1};
    RasterState state = scene_state(line_window, line_window);
    for (const Primitive primitive : {Primitive::polygon_lines, Primitive::polygon_points})
        for (const CullFace cull : {CullFace::none, CullFace::front, CullFace::back}) {
            state.cull = cull;
            soup.runs = {{.index_count = 9, .double_sided = false, .primitive = primitive}};
            const Geometry g = set_up(soup, state, ideal_shapes, 1);
            std::set<std::uint32_t> front, back;
            for (const Fragment& f : draw(g).fragments) {
                (f.front_facing ? front : back).insert(f.primitive);
                CHECK(f.color[0] == (f.front_facing ? 1.0f : 0.0f));
            }
            const bool is_line = primitive == Primitive::polygon_lines;  // a line without length has no fragments
            CHECK(front == (cull == CullFace::front ? std::set<std::uint32_t>{}
                            : is_line               ? std::set<std::uint32_t>{0}
                                                    : std::set<std::uint32_t>{0, 2}));
            CHECK(back == (cull == CullFace::back ? std::set<std::uint32_t>{} : std::set<std::uint32_t>{1}));
        }
}

TEST_CASE("polygon offset moves triangles alone") {
    for (const RasterRules& rules : {ideal_shapes, chip_shapes}) {
        RasterState state = scene_state(line_window, line_window);
        state.depth_format = DepthFormat::d24;
        const std::vector<ClipVertex> ends{{.x = -0.5f, .z = -0.5f}, {.x = 0.5f, .z = 0.5f}};
        const DepthRequest depth{rules.depth_path, DepthFormat::d24};
        const auto plain = draw(shapes(ends, Primitive::lines, state, rules), depth).fragments;
        state.polygon_offset = {true, 3, 1000};
        CHECK(draw(shapes(ends, Primitive::lines, state, rules), depth).fragments == plain);
    }
}

TEST_CASE("a polygon stipple keeps the pixels of its pattern, of triangles alone") {
    RasterState state = scene_state(line_window, line_window);
    TriangleSoup soup = random_soup(5, 40, SoupKind::flat);
    const std::vector<Fragment> all = by_pixel(draw(set_up(soup, state, ideal_shapes, 1)).fragments);
    state.polygon_stipple.emplace();
    Random random{6};
    for (std::uint32_t& row : *state.polygon_stipple) row = static_cast<std::uint32_t>(random());
    std::vector<Fragment> expected;
    for (const Fragment& f : all)
        if (((*state.polygon_stipple)[static_cast<std::size_t>(f.y % 32)] >> (31 - f.x % 32) & 1) != 0)
            expected.push_back(f);
    CHECK(by_pixel(draw(set_up(soup, state, ideal_shapes, 1)).fragments) == expected);
    CHECK(expected.size() < all.size() * 2 / 3);
    const std::vector<ClipVertex> ends{{.x = -0.5f, .y = -0.9f}, {.x = 0.5f, .y = 0.3f}};
    RasterState whole = scene_state(line_window, line_window);
    CHECK(draw(shapes(ends, Primitive::lines, state, ideal_shapes)).fragments ==
          draw(shapes(ends, Primitive::lines, whole, ideal_shapes)).fragments);
}

TEST_CASE("lines and points are refused where no rule says what they cover") {
    RasterState state = scene_state(8, 8);
    CHECK(shape_refusal(Primitive::lines, state, {}) ==
          "triangle soup: runs[0].primitive: expected triangles, because the rules have no lines, found lines");
    CHECK(shape_refusal(Primitive::points, state, {.lines = LineRule::band}) ==
          "triangle soup: runs[0].primitive: expected triangles, because the rules have no points, found points");
    RasterRules stepped = ideal_shapes;
    stepped.plane_rule = PlaneRule::least_corner;
    CHECK(shape_refusal(Primitive::lines, state, stepped) != "");
    CHECK(shape_refusal(Primitive::lines, state, ideal_shapes) == "");
    state.line_width_px = -1;
    CHECK(shape_refusal(Primitive::lines, state, ideal_shapes) ==
          "raster state: line_width_px: expected 0 to 65536, found -1.000000");
    state.line_width_px = 2;
    state.line_style = LineStyle::thin;
    CHECK(shape_refusal(Primitive::lines, state, chip_shapes) ==
          "raster state: line_width_px: expected 1 with line_style thin, found 2.000000");
    state.line_style = LineStyle::band;
    state.sample.emplace();
    const std::string no_samples =
        "triangle soup: runs[0].primitive: expected triangles, because the frame has sample positions, found ";
    CHECK(shape_refusal(Primitive::points, state, chip_shapes) == no_samples + "points");
    CHECK(shape_refusal(Primitive::lines, state, chip_shapes) == no_samples + "lines");
    CHECK(shape_refusal(Primitive::points, state, ideal_shapes) == "");
    CHECK(shape_refusal(Primitive::lines, state, ideal_shapes) == "");
    state.line_stipple.emplace();
    CHECK(shape_refusal(Primitive::points, state, ideal_shapes) == "");
    CHECK(shape_refusal(Primitive::lines, state, ideal_shapes) ==
          "triangle soup: runs[0].primitive: expected no line_stipple, because the frame has sample positions, found "
          "lines");
    state.line_stipple.reset();
    state.interpolation = Interpolation::centre;
    CHECK(shape_refusal(Primitive::points, state, ideal_shapes) ==
          "triangle soup: runs[0].primitive: expected triangles, because values are not those of the samples, found "
          "points");
}
