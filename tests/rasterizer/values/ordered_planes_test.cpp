// Tests ordered planes against pipeline/reference/swiftshader-rasterizer.md 1.1, 1.4 and 2, computed from the given
// vertices with each operation in rationals and rounded once.
#include "rasterizer/values/ordered_planes.h"

#include <bit>
#include <catch2/catch.hpp>
#include <cmath>

#include "tests/rasterizer/rational.h"
#include "tests/rasterizer/scene.h"

namespace {

using namespace strata::rasterizer;

[[nodiscard]] float without_denormals(float v) { return std::abs(v) < 0x1p-126f ? 0.0f : v; }

// A binary32 whose operations are computed in rationals and rounded once; magnitudes below 2^-126 become 0.
struct Single {
    float v = 0;

    [[nodiscard]] Rational exact() const { return Rational{without_denormals(v)}; }
    [[nodiscard]] static Single of(const Rational& r) { return {without_denormals(nearest_float(r))}; }
    friend Single operator+(Single a, Single b) { return of(a.exact() + b.exact()); }
    friend Single operator-(Single a, Single b) { return of(a.exact() - b.exact()); }
    friend Single operator*(Single a, Single b) { return of(a.exact() * b.exact()); }
    friend Single operator/(Single a, Single b) { return of(a.exact() / b.exact()); }
};

struct OwnCorner {
    Single x, y;                   // in 1/16 pixel from the centre of the first pixel of the lowest row
    Single clip_y, w, q, depth;    // depth: z / w
    std::array<Single, 6> values;  // colours, coordinates
};
using OwnCorners = std::array<OwnCorner, 3>;

[[nodiscard]] Single to_whole(Single v) {
    Integer below = floor(Rational{v.v});
    const Rational rest = Rational{v.v} - Rational{below};
    if (rest > Rational{1, 2} || (rest == Rational{1, 2} && below % 2 != 0)) ++below;
    return {below.convert_to<float>()};
}

[[nodiscard]] OwnCorner corner_of(const ClipVertex& v, bool front, int width, int height) {
    OwnCorner c;
    c.w = {v.w};
    c.clip_y = {v.y};
    c.q = Single{1} / c.w;
    const auto place = [&](float at, int size) {
        const Single scale{8.0f * static_cast<float>(size)}, less{scale.v - 8.0f};
        return to_whole(scale * (Single{at} * c.q) + less);
    };
    c.x = place(v.x, width);
    c.y = place(v.y, height);
    c.depth = Single{v.z} * c.q;
    for (std::size_t a = 0; a < 6; ++a) c.values[a] = {a >= 4 ? v.texcoord[a - 4] : front ? v.front[a] : v.back[a]};
    return c;
}

// From the order (p2, p0, p1): least y first, then greatest w.
[[nodiscard]] OwnCorners in_order(const OwnCorners& p) {
    OwnCorners v{p[2], p[0], p[1]};
    const auto turn = [&](auto key, auto best) {
        const OwnCorners before = v;
        const float m = best({key(v[0]), key(v[1]), key(v[2])});
        if (m == key(before[1])) v = {v[1], v[2], v[0]};
        if (m == key(before[2])) v = {v[2], v[0], v[1]};
    };
    turn([](const OwnCorner& c) { return c.clip_y.v; }, [](std::initializer_list<float> l) { return std::min(l); });
    turn([](const OwnCorner& c) { return c.w.v; }, [](std::initializer_list<float> l) { return std::max(l); });
    return v;
}

struct OwnPlane {
    Single a, b, c;
};

struct OwnTriangle {
    OwnCorners v;  // in order
    Single r, n;   // of the depth range

    [[nodiscard]] Single at(const OwnPlane& p, int i, int j) const {
        const Single sixteenth{1.0f / 16}, x0 = v[0].x * sixteenth, y0 = v[0].y * sixteenth;
        const Single x{static_cast<float>(i)}, y{static_cast<float>(j)};
        return (x - x0) * p.a + (p.c + (y - y0) * p.b);
    }
    [[nodiscard]] OwnPlane depth() const {
        const Single s{1.0f / 16};
        const Single x1 = (v[1].x - v[0].x) * s, y1 = (v[1].y - v[0].y) * s, x2 = (v[2].x - v[0].x) * s,
                     y2 = (v[2].y - v[0].y) * s;
        const Single d = r / (x1 * y2 - x2 * y1), z1 = v[1].depth - v[0].depth, z2 = v[2].depth - v[0].depth;
        return {(y2 * z1 - y1 * z2) * d, (x1 * z2 - x2 * z1) * d, v[0].depth * r + n};
    }
    [[nodiscard]] Single offset(const OwnPlane& p, const PolygonOffset& by, DepthFormat format) const {
        const Single one = (v[1].depth - v[0].depth) * r + n, two = (v[2].depth - v[0].depth) * r + n;
        const float largest = std::max({std::abs(p.c.v), std::abs(one.v), std::abs(two.v)});
        const Single unit{format == DepthFormat::d16 ? 1.01f / 65535
                                                     : nearest_float(power(floor_log2(Rational{largest}) - 23))};
        const Single slope{std::max(std::abs(p.a.v), std::abs(p.b.v))};
        return unit * Single{by.units} + slope * Single{by.factor};
    }
    // The plane of the values u_k; of 1 / w if they are 1.
    [[nodiscard]] OwnPlane plane(const std::array<Single, 3>& u) const {
        const Single s{1.0f / 16}, s1 = v[1].w * s, s2 = v[2].w * s, zero{0};
        const Single x1 = s1 * (v[1].x - v[0].x), y1 = s1 * (v[1].y - v[0].y), x2 = s2 * (v[2].x - v[0].x),
                     y2 = s2 * (v[2].y - v[0].y);
        const Single area = x1 * y2 - x2 * y1, g = area.v == 0 ? zero : Single{1} / area, d = g * v[0].q;
        const std::array<OwnPlane, 3> m{
            OwnPlane{(y1 * v[2].w - y2 * v[1].w) * d, (x2 * v[1].w - x1 * v[2].w) * d, v[0].q},
            OwnPlane{y2 * g, (zero - x2) * g, zero}, OwnPlane{(zero - y1) * g, x1 * g, zero}};
        const auto sum = [&](Single OwnPlane::*part) {
            return (u[0] * (m[0].*part) + u[1] * (m[1].*part)) + u[2] * (m[2].*part);
        };
        return {sum(&OwnPlane::a), sum(&OwnPlane::b), sum(&OwnPlane::c)};
    }
};

// The sign that decides the winding; 1: counterclockwise with y up, and a sum of 0.
[[nodiscard]] int turn_of(const OwnCorners& given) {
    const OwnCorners p{given[2], given[0], given[1]};
    const Single area = ((p[0].y - p[2].y) * p[1].x + (p[2].y - p[1].y) * p[0].x) + (p[1].y - p[0].y) * p[2].x;
    if (area.v == 0) return 1;
    int turn = area.v < 0 ? 1 : -1;
    for (const OwnCorner& c : p) turn = c.w.v < 0 ? -turn : turn;
    return turn;
}

[[nodiscard]] RasterRules ordered_rules() {
    return {.subpixel_bits = 4,
            .clip = ClipVolume::view_volume_depth_first,
            .w_divide = WDivide::reciprocal,
            .viewport = ViewportArithmetic::half_pixel_first,
            .y_axis = YAxis::clip,
            .area_sign = AreaSign::single,
            .plane_rule = PlaneRule::greatest_w,
            .plane_corners = PlaneCorners::given,
            .perspective = PerspectiveDivide::reciprocal,
            .depth_rounding = DepthRounding::product_even,
            .depth_limits = DepthLimits::zero_to_one,
            .offset_unit = OffsetUnit::differences};
}

// With ties of y and w, so that the order of the corners matters.
[[nodiscard]] TriangleSoup soup_with_ties(std::uint64_t seed, int triangles, SoupKind kind) {
    TriangleSoup soup = random_soup(seed, triangles, kind);
    for (TriangleRun& run : soup.runs) run.double_sided = true;
    for (std::size_t i = 0; i + 2 < soup.vertices.size(); i += 3) {
        ClipVertex* const v = &soup.vertices[i];
        if (i % 2 == 0) v[i / 6 % 3].y = v[(i / 6 + 1) % 3].y;
        if (i % 4 == 0) v[i / 12 % 3].w = v[(i / 12 + 1) % 3].w;
        for (std::size_t k = 0; k < 3; ++k) {
            v[k].texcoord[1] *= 0x1p-124f;
            if (i % 5 == 0) v[k].texcoord[0] *= 0x1p-129f;
        }
    }
    return soup;
}

struct Wrong {
    std::uint64_t depths = 0, codes = 0, values = 0, facings = 0, beyond = 0, fragments = 0;
};

[[nodiscard]] Wrong compared(const TriangleSoup& soup, const RasterState& state, const RasterRules& rules) {
    Wrong wrong;
    const DepthRequest depth{DepthPath::float32, state.depth_format};
    const bool is_up = state.y_direction == YDirection::up;
    const int width = state.viewport.width(), height = state.viewport.height();
    for (const Fragment& f : draw(set_up(soup, state, rules, 1), depth).fragments) {
        OwnCorners p;
        for (const bool front : {true, false}) {
            if (front != f.front_facing) continue;
            for (std::size_t k = 0; k < 3; ++k)
                p[k] = corner_of(soup.vertices[3 * f.primitive + k], front, width, height);
        }
        const bool is_mirrored = soup.runs[f.material - 7].mirrored;
        wrong.facings += f.front_facing == ((turn_of(p) > 0) != is_mirrored) ? 0 : 1;
        const bool symmetric = state.clip_depth == ClipDepth::minus_one_to_one;
        const Single near{state.depth_near}, far{state.depth_far}, half{symmetric ? 0.5f : 1.0f};
        const OwnTriangle t{in_order(p), (far - near) * half, symmetric ? (far + near) * half : near};
        const int row = is_up ? height - 1 - f.y : f.y;
        const OwnPlane own = t.depth();
        Single z = t.at(own, f.x, row);
        if (state.polygon_offset.enabled) z = z + t.offset(own, state.polygon_offset, state.depth_format);
        wrong.depths += f.shader_z == z.v ? 0 : 1;
        const bool by_range = rules.depth_limits == DepthLimits::clamp;
        const float least = by_range ? near.v : 0.0f, greatest = by_range ? far.v : 1.0f;
        const Single stored{std::clamp(z.v, least, greatest)};
        wrong.beyond += z.v < near.v || z.v > far.v ? 1 : 0;
        wrong.codes += state.depth_format == DepthFormat::d32f
                           ? f.code != std::bit_cast<std::uint32_t>(stored.v)
                           : f.code != static_cast<std::uint32_t>(to_whole(Single{65535} * stored).v);
        const Single one{1};
        const Single reciprocal = one / t.at(t.plane({one, one, one}), f.x, row);
        for (std::size_t a = 0; a < 6; ++a) {
            const Single over = t.at(t.plane({t.v[0].values[a], t.v[1].values[a], t.v[2].values[a]}), f.x, row);
            const float found = a < 4 ? f.color[a] : f.texcoord[a - 4];
            wrong.values += found == (over * reciprocal).v ? 0 : 1;
        }
        ++wrong.fragments;
    }
    return wrong;
}

}  // namespace

TEST_CASE("planes begin at the corner of the greatest w of what was given: depths and values are the rounded steps",
          "[long][slow]") {
    for (const auto& [kind, clip_depth, direction] :
         {std::tuple{SoupKind::perspective, ClipDepth::minus_one_to_one, YDirection::up},
          {SoupKind::needs_clipping, ClipDepth::zero_to_one, YDirection::up},
          {SoupKind::needs_clipping, ClipDepth::minus_one_to_one, YDirection::down}}) {
        RasterState state = scene_state(23, 17);
        state.clip_depth = clip_depth;
        state.y_direction = direction;
        state.depth_near = 0.125f;
        state.depth_far = 0.9f;
        RasterRules rules = ordered_rules();
        if (direction == YDirection::down) rules.depth_limits = DepthLimits::clamp;
        const Wrong wrong = compared(soup_with_ties(521, 40, kind), state, rules);
        CHECK(wrong.depths == 0);
        CHECK(wrong.codes == 0);
        CHECK(wrong.values == 0);
        CHECK(wrong.facings == 0);
        CHECK(wrong.fragments > 800);
    }
}

TEST_CASE("polygon offset is added to the value of each fragment and its unit is that of depth differences",
          "[long][slow]") {
    for (const DepthFormat format : {DepthFormat::d16, DepthFormat::d32f}) {
        RasterState state = scene_state(23, 17);
        state.depth_format = format;
        state.polygon_offset = {true, 1.5f, -3.0f};
        state.depth_near = 0.125f;
        state.depth_far = 0.9f;
        for (const DepthLimits limits : {DepthLimits::zero_to_one, DepthLimits::clamp}) {
            RasterRules rules = ordered_rules();
            rules.depth_limits = limits;
            const Wrong wrong = compared(soup_with_ties(522, 30, SoupKind::needs_clipping), state, rules);
            CHECK(wrong.depths == 0);
            CHECK(wrong.codes == 0);
            CHECK(wrong.beyond > 10);
            CHECK(wrong.values == 0);
            CHECK(wrong.fragments > 500);
        }
    }
}

TEST_CASE("with clipped plane corners each piece has the planes that it would have if it were given") {
    RasterRules rules = ordered_rules();
    rules.area_sign = AreaSign::exact;
    rules.plane_corners = PlaneCorners::clipped;
    const RasterState state = scene_state(37, 29);
    const TriangleSoup soup = soup_with_ties(523, 60, SoupKind::needs_clipping);
    const Geometry geometry = set_up(soup, state, rules, 1);
    CHECK(geometry.given.empty());
    TriangleSoup pieces;
    for (const TriangleRecord& t : geometry.triangles)
        for (const std::uint32_t v : t.vertex) {
            pieces.indices.push_back(static_cast<std::uint32_t>(pieces.vertices.size()));
            pieces.vertices.push_back(geometry.vertices[v]);
            if (!t.front_facing) std::swap(pieces.vertices.back().front, pieces.vertices.back().back);
        }
    pieces.runs = {{0, static_cast<std::uint32_t>(pieces.indices.size()), 7, 0, true, false}};
    RasterRules given = rules;
    given.plane_corners = PlaneCorners::given;
    const auto found = by_pixel(draw(geometry).fragments);
    const auto alone = by_pixel(draw(set_up(pieces, state, given, 1)).fragments);
    const auto whole = by_pixel(draw(set_up(soup, state, given, 1)).fragments);
    REQUIRE(found.size() == alone.size());
    REQUIRE(found.size() == whole.size());
    std::uint64_t wrong = 0, unlike = 0;
    for (std::size_t i = 0; i < found.size(); ++i) {
        wrong += found[i].shader_z == alone[i].shader_z && found[i].texcoord == alone[i].texcoord ? 0 : 1;
        unlike += found[i].shader_z == whole[i].shader_z && found[i].texcoord == whole[i].texcoord ? 0 : 1;
    }
    CHECK(wrong == 0);
    CHECK(unlike > found.size() / 10);
}

TEST_CASE("a sliver whose binary32 area has the wrong sign is lost and no other", "[slow]") {
    Random random{524};
    TriangleSoup soup;
    constexpr int width = 1920, height = 1080, count = 60'000;
    for (int n = 0; n < count; ++n) {
        const float x = random_float(random, -1, 1), y = random_float(random, -1, 1);
        const float dx = random_float(random, -1, 1) - x, dy = random_float(random, -1, 1) - y;
        const float share = random_float(random, 0, 1), off = random_float(random, -1, 1) * 0x1p-17f;
        for (const auto& [px, py] :
             {std::array{x, y}, {x + dx, y + dy}, {x + share * dx + off, y + share * dy - off}}) {
            soup.indices.push_back(static_cast<std::uint32_t>(soup.vertices.size()));
            soup.vertices.push_back({px, py, 0, 1.0f, {}, {}, {}});
        }
    }
    soup.runs = {{0, static_cast<std::uint32_t>(soup.indices.size()), 7, 0, true, false}};
    std::uint64_t lost = 0, flat = 0;
    for (int n = 0; n < count; ++n) {
        OwnCorners p;
        std::array<SubpixelPoint, 3> points;
        for (std::size_t k = 0; k < 3; ++k) {
            p[k] = corner_of(soup.vertices[3 * static_cast<std::size_t>(n) + k], true, width, height);
            points[k] = {static_cast<std::int32_t>(p[k].x.v), static_cast<std::int32_t>(p[k].y.v)};
        }
        const Integer area = doubled_area(points[0], points[1], points[2]);
        const int exact = area > 0 ? 1 : area < 0 ? -1 : 0;
        flat += exact == 0 ? 1 : 0;
        lost += exact != 0 && turn_of(p) != exact ? 1 : 0;
    }
    CHECK(lost > 5);
    const RasterState state = scene_state(width, height);
    RasterRules exact = ordered_rules();
    exact.area_sign = AreaSign::exact;
    CHECK(set_up(soup, state, exact, 1).counters.degenerate == flat);
    CHECK(set_up(soup, state, ordered_rules(), 1).counters.degenerate == flat + lost);
}

TEST_CASE("corners without an area have slopes of 0 and a w of 0 counts as 1") {
    RasterState state = scene_state(16, 16);
    std::array<ClipVertex, 3> v{};
    for (std::size_t k = 0; k < 3; ++k) v[k].w = 1.0f, v[k].x = 0.25f * static_cast<float>(k);
    const OrderedPlanes flat{{&v[0], &v[1], &v[2]}, state, ordered_rules()};
    const FloatPlane plane = flat.plane({2, 3, 5});
    CHECK(plane.dx == 0.0f);
    CHECK(plane.dy == 0.0f);
    CHECK(plane.origin == 5.0f);  // the third corner is the first of three with equal y and w
    v[2].w = 0.0f;
    v[2].z = 0.5f;
    const OrderedPlanes at_eye{{&v[2], &v[2], &v[2]}, state, ordered_rules()};
    CHECK(at_eye.depth().origin == 0.75f);
}

TEST_CASE("a plane of the greatest w is evaluated at the sample at an exact distance from the centre") {
    RasterState state = scene_state(16, 16);
    const std::array<ClipVertex, 3> v{ClipVertex{.x = -0.7f, .y = -0.4f, .z = 0.1f, .w = 1.0f},
                                      ClipVertex{.x = 0.9f, .y = -0.3f, .z = 0.7f, .w = 1.5f},
                                      ClipVertex{.x = 0.1f, .y = 0.8f, .z = 0.3f, .w = 1.25f}};
    const std::array corners{&v[0], &v[1], &v[2]};
    const FloatPlane centre = OrderedPlanes{corners, state, ordered_rules()}.depth();
    state.sample = SamplePoint{14, 6};
    const FloatPlane sampled = OrderedPlanes{corners, state, ordered_rules()}.depth();
    CHECK(sampled.origin == centre.origin);
    CHECK((sampled.dx == centre.dx && sampled.dy == centre.dy));
    std::uint64_t wrong = 0;
    for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 16; ++x) {
            const Rounded i{static_cast<float>(x) + 0.375f}, j{static_cast<float>(y) - 0.125f};
            const Rounded row = Rounded{centre.row_base} + Rounded{centre.row_step} * j;
            const Rounded down = (row - Rounded{centre.y0}) * Rounded{centre.dy},
                          across = (i - Rounded{centre.x0}) * Rounded{centre.dx};
            wrong += sampled.at(PlaneRule::greatest_w, x, y) != (across + (Rounded{centre.origin} + down)).v ? 1 : 0;
        }
    CHECK(wrong == 0);
}

TEST_CASE("a magnitude below 2^-126 becomes a zero of its sign when read or stored") {
    const auto bits = [](Flushed v) { return std::bit_cast<std::uint32_t>(v.v); };
    const Flushed least{0x1p-126f};
    CHECK(bits(Flushed{-0x1.fffffcp-127f}) == 0x80000000u);
    CHECK(bits(Flushed{0x1p-149f}) == 0);
    CHECK(least.v == 0x1p-126f);
    CHECK(bits(Flushed{-0x1p-149f} + Flushed{0.0f}) == 0);
    CHECK(bits(-least * Flushed{0.5f}) == 0x80000000u);
    CHECK(bits(least / Flushed{-2.0f}) == 0x80000000u);
    CHECK(bits(Flushed{0x1.8p-126f} - least) == 0);
}
