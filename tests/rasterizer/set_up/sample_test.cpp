// Tests samples against the corners of the frame of one sample, and, at every sample of every pixel, exact edges with
// the top-left rule and exact planes in rationals.
#include <catch2/catch.hpp>
#include <map>

#include "rasterizer/base/input_error.h"
#include "rasterizer/base/simd.h"
#include "rasterizer/set_up/check_input.h"
#include "tests/rasterizer/rational.h"
#include "tests/rasterizer/scene.h"

namespace {

using namespace strata::rasterizer;

constexpr int sampled_width = 24, sampled_height = 20;

[[nodiscard]] RasterState state_at(const std::optional<SamplePoint>& sample) {
    RasterState state = scene_state(sampled_width, sampled_height);
    state.cull = CullFace::none;
    state.sample = sample;
    return state;
}

// Position of sample `s` of pixel (x, y) in subpixels.
[[nodiscard]] SubpixelPoint model_sample(int x, int y, const SamplePoint& s, int subpixel_bits) {
    const int unit = 1 << subpixel_bits;
    return {x * unit + s.x * unit / 16, y * unit + s.y * unit / 16};
}

// Twice the area on the inner side of each edge, and whether the point belongs to the triangle.
struct ModelPoint {
    std::array<Rational, 3> weight;
    bool is_covered = true;
};
[[nodiscard]] ModelPoint point_in(std::array<SubpixelPoint, 3> p, SubpixelPoint at) {
    const Integer area = doubled_area(p[0], p[1], p[2]);
    ModelPoint point;
    for (std::size_t i = 0; i < 3; ++i) {
        const SubpixelPoint a = p[(i + 1) % 3], b = p[(i + 2) % 3];
        const Integer side = area > 0 ? doubled_area(a, b, at) : Integer{-doubled_area(a, b, at)};
        // Rows increase downwards: on the clockwise outline a left side goes up, and a top side right.
        const int dx = area > 0 ? b.x - a.x : a.x - b.x, dy = area > 0 ? b.y - a.y : a.y - b.y;
        const bool owns = dy < 0 || (dy == 0 && dx > 0);
        point.is_covered &= side > 0 || (side == 0 && owns);
        point.weight[i] = Rational{side} / Rational{abs(area)};
    }
    return point;
}

// A mesh over and beyond the whole viewport with corners on sixteenths of a pixel, so that samples are on sides.
[[nodiscard]] TriangleSoup jittered_grid(std::uint64_t seed, int subpixel_bits) {
    constexpr int columns = 7, rows = 6;
    Random random{seed};
    TriangleSoup soup;
    for (int y = 0; y <= rows; ++y)
        for (int x = 0; x <= columns; ++x) {
            const int jitter = subpixel_bits == 4 ? 16 : 32;
            const auto at = [&](int i, int count, int size) {
                const int outside = i == 0 ? -1 : i == count ? 1 : 0;
                const int cell = size * 16 / count;
                const int sixteenths = i * cell + outside * 32 + (outside == 0 ? random_int(random, -16, 16) : 0);
                return static_cast<float>(sixteenths) / static_cast<float>(size * 16) * 2 - 1 +
                       (jitter == 32 && i % 2 == 0 ? 0x1p-12f : 0.0f);
            };
            soup.vertices.push_back({.x = at(x, columns, sampled_width), .y = at(y, rows, sampled_height), .w = 1});
        }
    for (std::uint32_t y = 0; y < rows; ++y)
        for (std::uint32_t x = 0; x < columns; ++x) {
            const std::uint32_t a = y * (columns + 1) + x, b = a + 1, c = a + columns + 1, d = c + 1;
            soup.indices.insert(soup.indices.end(), {a, b, c, c, b, d});
        }
    soup.runs = {{.first_index = 0, .index_count = static_cast<std::uint32_t>(soup.indices.size())}};
    return soup;
}

}  // namespace

TEST_CASE("coverage and depth and colour of a sample are those of exact edges and planes at its point") {
    std::uint64_t wrong = 0, covered = 0;
    for (const int bits : {4, 8, 12})
        for (const SamplePoint sample :
             {SamplePoint{0, 0}, SamplePoint{12, 12}, SamplePoint{6, 2}, SamplePoint{15, 1}, SamplePoint{8, 8}}) {
            const RasterRules rules{.subpixel_bits = bits};
            const auto soup = random_soup(static_cast<std::uint64_t>(40 + bits), 30, SoupKind::flat);
            const Geometry centre = set_up(soup, state_at({}), rules, 1), g = set_up(soup, state_at(sample), rules, 1);
            std::map<std::array<int, 3>, Fragment> drawn;
            for (const Fragment& f : draw(g).fragments) drawn[{static_cast<int>(f.primitive), f.x, f.y}] = f;
            for (std::size_t t = 0; t < centre.triangles.size(); ++t) {
                const SetupTriangle triangle = centre.triangle(t);
                for (int y = 0; y < sampled_height; ++y)
                    for (int x = 0; x < sampled_width; ++x) {
                        const ModelPoint point = point_in(triangle.p, model_sample(x, y, sample, bits));
                        const auto found = drawn.find({static_cast<int>(triangle.primitive), x, y});
                        wrong += point.is_covered != (found != drawn.end()) ? 1 : 0;
                        if (!point.is_covered || found == drawn.end()) continue;
                        ++covered;
                        wrong += found->second.shader_z != nearest_float(plane_value(point.weight, triangle.z)) ? 1 : 0;
                        const std::array red{triangle.attribute[0][0], triangle.attribute[1][0],
                                             triangle.attribute[2][0]};
                        wrong += found->second.color[0] != nearest_float(plane_value(point.weight, red)) ? 1 : 0;
                    }
            }
        }
    CHECK(wrong == 0);
    CHECK(covered > 15000);
}

TEST_CASE("every sample of a closed mesh belongs to one triangle at all 256 points of a pixel") {
    std::uint64_t wrong = 0;
    for (const int bits : {4, 8}) {
        const TriangleSoup soup = jittered_grid(static_cast<std::uint64_t>(71 + bits), bits);
        for (int y = 0; y < 16; ++y)
            for (int x = 0; x < 16; ++x) {
                const Geometry g = set_up(soup, state_at(SamplePoint{x, y}), {.subpixel_bits = bits}, 1);
                std::array<int, sampled_width * sampled_height> drawn{};
                for (const Fragment& f : draw(g, {}, coverage_only).fragments)
                    ++drawn[static_cast<std::size_t>(f.y * sampled_width + f.x)];
                for (const int triangles : drawn) wrong += triangles != 1 ? 1 : 0;
            }
    }
    CHECK(wrong == 0);
}

TEST_CASE("the mean over the points of a pixel tends to a triangle's area") {
    TriangleSoup soup;
    soup.vertices = {
        {.x = -0.71f, .y = -0.63f, .w = 1}, {.x = 0.83f, .y = -0.37f, .w = 1}, {.x = -0.13f, .y = 0.91f, .w = 1}};
    soup.indices = {0, 1, 2};
    soup.runs = {{.first_index = 0, .index_count = 3}};
    const SetupTriangle triangle = set_up(soup, state_at({}), {}, 1).triangle(0);
    const double area =
        std::abs(doubled_area(triangle.p[0], triangle.p[1], triangle.p[2]).convert_to<double>()) / 2 / 65536;
    // The difference between two grids of points is at most the sides' length times half a step's diagonal.
    const double sides = 2.0 * (sampled_width + sampled_height);
    for (const int step : {8, 4, 2, 1}) {
        std::uint64_t covered = 0, points = 0;
        for (int y = 0; y < 16; y += step)
            for (int x = 0; x < 16; x += step, ++points)
                covered += draw(set_up(soup, state_at(SamplePoint{x, y}), {}, 1), {}, coverage_only).fragments.size();
        const double mean = static_cast<double>(covered) / static_cast<double>(points);
        INFO(points << " points: " << mean << " of " << area << " pixels");
        CHECK(std::abs(mean - area) <= sides * step / 16 / 4);
    }
}

TEST_CASE("corners move opposite to the sample whether set up singly or by sixteen or added by clipping") {
    for (const SoupKind kind : {SoupKind::flat, SoupKind::perspective, SoupKind::needs_clipping})
        for (const strata::Simd simd : strata::available_simd())
            for (const SamplePoint sample : {SamplePoint{15, 1}, SamplePoint{0, 8}}) {
                const strata::SimdScope scope{simd};
                const auto soup = random_soup(77, 120, kind);
                const RasterRules rules{.subpixel_bits = 8};
                const Geometry centre = set_up(soup, state_at({}), rules, 1),
                               moved = set_up(soup, state_at(sample), rules, 1);
                // By position before the snap and by depth, which no sample changes: clipping adds corners only to
                // triangles that are kept.
                std::map<std::array<float, 3>, SubpixelPoint> at;
                for (const WindowCorner& c : centre.corners) at[{c.unsnapped[0], c.unsnapped[1], c.z}] = c.p;
                std::uint64_t wrong = 0, corners = 0, made = 0;
                for (const TriangleRecord& t : moved.triangles)
                    for (const std::uint32_t v : t.vertex) {
                        const WindowCorner& c = moved.corners[v];
                        const auto found = at.find({c.unsnapped[0], c.unsnapped[1], c.z});
                        if (found == at.end()) continue;
                        const SubpixelPoint p = found->second;
                        wrong += c.p.x != p.x - (sample.x - 8) * 16 || c.p.y != p.y - (sample.y - 8) * 16 ? 1 : 0;
                        ++corners;
                        made += v >= soup.vertices.size() ? 1 : 0;
                    }
                CHECK((made > 100) == (kind == SoupKind::needs_clipping));
                CHECK(wrong == 0);
                CHECK(corners > 100);
            }
}

TEST_CASE("a sample outside of its pixel is rejected") {
    const auto refused = [](SamplePoint sample) {
        try {
            check(state_at(sample));
        } catch (const strata::InputError& error) {
            return std::string{error.what()};
        }
        return std::string{};
    };
    CHECK(refused({16, 3}) == "raster state: sample.x: expected 0 to 15, found 16");
    CHECK(refused({3, -1}) == "raster state: sample.y: expected 0 to 15, found -1");
    CHECK(refused({15, 0}).empty());
}
