// Tests values at a pixel's centre and centroid, also far outside slivers, against exact planes in rationals; coverage
// and codes against those of the sample's own frame.
#include "rasterizer/walk/pixel_shading.h"

#include <catch2/catch.hpp>
#include <map>
#include <numeric>
#include <utility>

#include "rasterizer/base/simd.h"
#include "tests/rasterizer/rational.h"
#include "tests/rasterizer/scene.h"

namespace {

using namespace strata::rasterizer;

constexpr std::array<SamplePoint, 4> four_points{{{6, 2}, {14, 6}, {2, 10}, {10, 14}}};
constexpr int shaded_width = 24, shaded_height = 20;

[[nodiscard]] RasterState shaded_state(std::size_t sample, Interpolation interpolation) {
    RasterState state = scene_state(shaded_width, shaded_height);
    state.cull = CullFace::none;
    state.sample = four_points[sample];
    state.interpolation = interpolation;
    if (interpolation != Interpolation::centroid) return state;
    state.sample_count = 4;
    std::copy(four_points.begin(), four_points.end(), state.samples.begin());
    return state;
}

// Every third triangle becomes a sliver, some thinner than a subpixel is wide.
[[nodiscard]] TriangleSoup soup_with_slivers(SoupKind kind) {
    TriangleSoup soup = random_soup(2031, 60, kind);
    for (std::size_t t = 0; t < 60; t += 3) {
        const auto &a = soup.vertices[3 * t], &b = soup.vertices[3 * t + 1];
        ClipVertex& c = soup.vertices[3 * t + 2];
        c.w = a.w;
        c.x = (a.x / a.w * 0.5f + b.x / b.w * 0.5f) * c.w + 0.0008f;
        c.y = (a.y / a.w * 0.5f + b.y / b.w * 0.5f) * c.w;
    }
    return soup;
}

struct ShadedPoint {
    std::array<Rational, 3> weight;
    bool is_covered = true;
};
// The weights of point `at` of pixel (x, y), and whether it belongs to the triangle.
[[nodiscard]] ShadedPoint shaded_point(const std::array<SubpixelPoint, 3>& p, int x, int y, SamplePoint at, int bits) {
    const int unit = 1 << bits;
    const SubpixelPoint q{x * unit + at.x * unit / 16, y * unit + at.y * unit / 16};
    const Integer area = doubled_area(p[0], p[1], p[2]);
    ShadedPoint point;
    for (std::size_t i = 0; i < 3; ++i) {
        const SubpixelPoint a = p[(i + 1) % 3], b = p[(i + 2) % 3];
        const Integer side = area > 0 ? doubled_area(a, b, q) : Integer{-doubled_area(a, b, q)};
        const int dx = area > 0 ? b.x - a.x : a.x - b.x, dy = area > 0 ? b.y - a.y : a.y - b.y;
        point.is_covered &= side > 0 || (side == 0 && (dy < 0 || (dy == 0 && dx > 0)));
        point.weight[i] = Rational{side} / Rational{abs(area)};
    }
    return point;
}

// The centre if all samples are covered, else the first that is.
[[nodiscard]] SamplePoint model_centroid(const std::array<SubpixelPoint, 3>& p, int x, int y, int bits) {
    std::vector<SamplePoint> covered;
    for (const SamplePoint& at : four_points)
        if (shaded_point(p, x, y, at, bits).is_covered) covered.push_back(at);
    return covered.size() == four_points.size() ? SamplePoint{} : covered.front();
}

// Red by the rule of perspective: both planes rounded once, then their quotient.
[[nodiscard]] float model_red(const SetupTriangle& t, const std::array<Rational, 3>& weight) {
    std::array<float, 3> over_w{};
    for (std::size_t i = 0; i < 3; ++i) over_w[i] = t.attribute[i][0] * t.inverse_w[i];
    const float dividend = nearest_float(plane_value(weight, over_w));
    const bool is_flat = t.inverse_w == std::array{1.0f, 1.0f, 1.0f};
    return is_flat ? dividend : dividend / nearest_float(plane_value(weight, t.inverse_w));
}

struct ShadingFaults {
    std::uint64_t coverage = 0, codes = 0, depths = 0, colors = 0, fragments = 0, outside = 0, far_outside = 0;
};

void compare_with_planes(SoupKind kind, std::size_t sample, Interpolation interpolation, int bits,
                         ShadingFaults& faults) {
    const auto soup = soup_with_slivers(kind);
    const RasterRules rules{.subpixel_bits = bits};
    RasterState plain = shaded_state(sample, Interpolation::sample), unsampled = plain;
    unsampled.sample.reset();
    const Geometry centre = set_up(soup, unsampled, rules, 1);
    std::map<std::array<int, 3>, Fragment> own;
    for (const Fragment& f : draw(set_up(soup, plain, rules, 1)).fragments)
        own[{static_cast<int>(f.primitive), f.x, f.y}] = f;
    std::map<int, SetupTriangle> triangles;
    for (std::size_t t = 0; t < centre.triangles.size(); ++t)
        triangles[static_cast<int>(centre.triangles[t].primitive)] = centre.triangle(t);
    const auto drawn = draw(set_up(soup, shaded_state(sample, interpolation), rules, 1)).fragments;
    faults.coverage += drawn.size() == own.size() ? 0 : 1;
    for (const Fragment& f : drawn) {
        const auto found = own.find({static_cast<int>(f.primitive), f.x, f.y});
        const auto triangle = triangles.find(static_cast<int>(f.primitive));
        if (found == own.end()) ++faults.coverage;
        if (found == own.end() || triangle == triangles.end()) continue;  // drawn at no centre: its corners are unknown
        const SetupTriangle& t = triangle->second;
        const SamplePoint at =
            interpolation == Interpolation::centroid ? model_centroid(t.p, f.x, f.y, bits) : SamplePoint{};
        const ShadedPoint point = shaded_point(t.p, f.x, f.y, at, bits);
        ++faults.fragments;
        faults.outside += point.is_covered ? 0 : 1;
        faults.far_outside += abs(point.weight[2]) > 25 ? 1 : 0;
        faults.codes += f.code != found->second.code ? 1 : 0;
        const ShadedPoint centre_point = shaded_point(t.p, f.x, f.y, {}, bits);
        faults.depths += f.shader_z != nearest_float(plane_value(centre_point.weight, t.z)) ? 1 : 0;
        faults.colors += f.color[0] != model_red(t, point.weight) ? 1 : 0;
    }
}

// A sliver of 1.5 square subpixels, a few pixels long, with a side through the sample of pixel (20, 20): at the pixel's
// centre its weights are near 2^27, and they cancel, for all values lie on a line.
[[nodiscard]] SetupTriangle sliver_through_sample(Random& random, int bits) {
    const int unit = 1 << bits, middle = 20 * unit + unit / 2;
    int dx = 0, dy = 0;
    while (std::gcd(dx, dy) != 1)
        dx = random_int(random, 2 * unit, 9 * unit), dy = random_int(random, 2 * unit, 9 * unit);
    // dx v - dy u = 1, for the third corner
    int u = 0, v = 0;
    for (int a = dx, b = dy, u0 = 0, u1 = 1, v0 = 1, v1 = 0;;) {  // Euclid
        if (b == 0) {
            v = v0, u = -u0;
            break;
        }
        const int q = a / b;
        a = std::exchange(b, a - q * b);
        v0 = std::exchange(v1, v0 - q * v1);
        u0 = std::exchange(u1, u0 - q * u1);
    }
    const int turn = random_int(random, 0, 1) == 0 ? 1 : -1;
    dy *= turn, v *= turn;
    SetupTriangle t = window_triangle(
        {{{middle - dx, middle - dy}, {middle + 2 * dx, middle + 2 * dy}, {middle - u, middle - v}}}, bits);
    const float first = random_float(random, 0.2f, 0.8f), last = random_float(random, 0.2f, 0.8f);
    const float along = (1.0f - static_cast<float>(u) / static_cast<float>(dx)) / 3;
    const std::array values{first, last, first + along * (last - first)};
    for (std::size_t i = 0; i < 3; ++i) t.z[i] = t.attribute[i][0] = values[i];
    t.given_z = t.z;
    return t;
}

}  // namespace

TEST_CASE("values at the centre of slivers with weights near 2 to the 27 are the exact planes rounded once") {
    constexpr int bits = 12;
    Random random{2032};
    std::vector<SetupTriangle> triangles;
    for (int i = 0; i < 300; ++i) triangles.push_back(sliver_through_sample(random, bits));
    for (const strata::Simd simd : strata::available_simd()) {
        const strata::SimdScope scope{simd};
        Geometry geometry = window_geometry(triangles, 40, 40, {.subpixel_bits = bits});
        geometry.state.sample = four_points[0];
        geometry.state.interpolation = Interpolation::centre;
        std::uint64_t wrong = 0, fragments = 0;
        Rational most = 0;
        for (const Fragment& f : draw(geometry).fragments) {
            const SetupTriangle& t = triangles[f.primitive];
            // The corners are those that the sample moved, so its pixel's centre is where the sample is not.
            const SamplePoint centre{16 - four_points[0].x, 16 - four_points[0].y};
            const ShadedPoint point = shaded_point(t.p, f.x, f.y, centre, bits);
            most = std::max(most, Rational{abs(point.weight[1]) + abs(point.weight[2])});
            const float value = nearest_float(plane_value(point.weight, t.z));
            wrong += f.shader_z == value && f.color[0] == value ? 0 : 1;
            ++fragments;
        }
        CHECK(wrong == 0);
        CHECK(fragments > 100);
        CHECK(most > 1 << 26);
    }
}

TEST_CASE("values at centre and centroid are those of exact planes and codes those of the sample") {
    for (const Interpolation interpolation : {Interpolation::centre, Interpolation::centroid})
        for (const strata::Simd simd : strata::available_simd()) {
            const strata::SimdScope scope{simd};
            ShadingFaults faults;
            for (const int bits : {4, 8})
                for (const std::size_t sample : {0u, 3u})
                    for (const SoupKind kind : {SoupKind::flat, SoupKind::perspective})
                        compare_with_planes(kind, sample, interpolation, bits, faults);
            CHECK(faults.coverage == 0);
            CHECK(faults.codes == 0);
            CHECK(faults.depths == 0);
            CHECK(faults.colors == 0);
            CHECK(faults.fragments > 5000);
            CHECK((faults.outside > 300) == (interpolation == Interpolation::centre));
            CHECK((faults.far_outside > 0) == (interpolation == Interpolation::centre));
            if (interpolation == Interpolation::centroid) CHECK(faults.outside == 0);
        }
}

namespace {

constexpr UnitMask shaded_units = 0xf241;  // components of all four units
constexpr std::size_t shaded_unit_values = 4 * texture_units;

struct ShadedValues {
    std::uint32_t code = 0, reference_code = 0;
    double reference_z = 0;
    std::vector<float> attributes;  // colour, coordinates and the values of units
};
using ShadedFragments = std::map<std::array<int, 3>, ShadedValues>;  // by primitive, x and y

[[nodiscard]] ShadedFragments shaded_fragments(const TriangleSoup& soup, const RasterState& state,
                                               const RasterRules& rules) {
    const FragmentNeeds needs{.texcoord = true, .reference = true, .units = shaded_units};
    const Geometry geometry = set_up(soup, state, rules, 1);
    ShadedFragments found;
    TileRasterizer rasterizer{state.viewport};
    auto sink = [&](FragmentBatch& batch) {
        for (std::size_t i = 0; i < static_cast<std::size_t>(batch.count); ++i) {
            ShadedValues& values = found[{static_cast<int>(batch.primitive[i]), batch.x[i], batch.y[i]}];
            values.code = batch.code[i];
            values.reference_code = batch.reference_code[i], values.reference_z = batch.reference_z[i];
            for (std::size_t c = 0; c < 4; ++c) values.attributes.push_back(batch.color[c][i]);
            for (std::size_t c = 0; c < 2; ++c) values.attributes.push_back(batch.texcoord[c][i]);
            for (std::size_t u = 0; u < texture_units; ++u)
                for (std::size_t c = 0; c < 4; ++c)
                    if (names(shaded_units, u, c)) values.attributes.push_back(batch.unit[u][c][i]);
        }
    };
    rasterizer.draw(geometry, geometry.all_triangles, {DepthPath::float32, DepthFormat::d24, DepthPath::window_z},
                    needs, BatchSink{sink});
    return found;
}

}  // namespace

// A fragment of the frame at another point of the pixel has the values of that point. With four samples around it a
// centre is covered where all of them are.
TEST_CASE("attributes and compared depths are those of the frame at the point of the pixel where they are evaluated") {
    TriangleSoup soup = soup_with_slivers(SoupKind::perspective);
    Random random{2033};
    soup.extras = {.stride = shaded_unit_values, .has_rq = false, .has_units = true, .values = {}};
    for (std::size_t i = 0; i < soup.vertices.size() * shaded_unit_values; ++i)
        soup.extras.values.push_back(random_float(random, -9, 9));
    const RasterRules of_clipped{}, of_given{.plane_rule = PlaneRule::greatest_w, .plane_corners = PlaneCorners::given};
    for (const RasterRules& rules : {of_clipped, of_given}) {
        std::vector<ShadedFragments> frames;
        for (std::size_t s = 0; s < four_points.size(); ++s)
            frames.push_back(shaded_fragments(soup, shaded_state(s, Interpolation::sample), rules));
        RasterState at_centre = shaded_state(0, Interpolation::sample);
        at_centre.sample = SamplePoint{};
        const ShadedFragments centre = shaded_fragments(soup, at_centre, rules);
        std::uint64_t codes = 0, references = 0, attributes = 0, whole = 0, cut = 0;
        const auto shaded = shaded_fragments(soup, shaded_state(3, Interpolation::centroid), rules);
        for (const auto& [key, values] : shaded) {
            codes += values.code != frames[3].at(key).code ? 1 : 0;
            if (const auto found = centre.find(key); found != centre.end())
                references += values.reference_code != found->second.reference_code ||
                                      values.reference_z != found->second.reference_z
                                  ? 1
                                  : 0;
            const auto covers = [&k = key](const ShadedFragments& frame) { return frame.contains(k); };
            const bool is_whole = std::ranges::all_of(frames, covers);
            const ShadedFragments& point = is_whole ? centre : *std::ranges::find_if(frames, covers);
            attributes += values.attributes != point.at(key).attributes ? 1 : 0;
            ++(is_whole ? whole : cut);
        }
        INFO(static_cast<int>(rules.plane_rule));
        CHECK(shaded.size() == frames[3].size());
        CHECK(codes == 0);
        CHECK(references == 0);
        CHECK(attributes == 0);
        CHECK(whole > 500);
        CHECK(cut > 100);
    }
}

// A sample is in the depth range, or is not, by its own depth.
TEST_CASE("where fragments are clipped to the depth range a pixel's shading keeps those of the sample's own frame") {
    TriangleSoup soup = soup_with_slivers(SoupKind::perspective);
    for (std::size_t v = 0; v < soup.vertices.size(); v += 2) soup.vertices[v].z *= 1.5f;
    const RasterRules rules{.z_clip = ZClip::per_fragment};
    const auto fragments = [&](Interpolation interpolation) {
        return draw(set_up(soup, shaded_state(3, interpolation), rules, 1)).fragments;
    };
    const std::vector<Fragment> own = fragments(Interpolation::sample);
    for (const Interpolation interpolation : {Interpolation::centre, Interpolation::centroid}) {
        const std::vector<Fragment> shaded = fragments(interpolation);
        REQUIRE(shaded.size() == own.size());
        std::uint64_t wrong = 0, outside = 0;
        for (std::size_t i = 0; i < own.size(); ++i) {
            wrong += shaded[i].x != own[i].x || shaded[i].y != own[i].y || shaded[i].code != own[i].code ? 1 : 0;
            outside += shaded[i].shader_z < 0 || shaded[i].shader_z > 1 ? 1 : 0;
        }
        CHECK(wrong == 0);
        CHECK(outside > 0);
    }
}
