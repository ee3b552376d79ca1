// Tests the vertex stage against binary32 arithmetic written out operation by operation, and the contents of a frame's
// lists.
#include "pipeline/vertices/prepare.h"

#include <bit>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "pipeline/region/region_shortcuts.h"
#include "rasterizer/base/simd.h"
#include "tests/pipeline/frames.h"
#include "tests/support/random_triangles.h"

namespace {

using namespace strata::testing;
using namespace strata::pipeline;
using strata::rasterizer::ClipVertex;

// Multiples of 2^-10 below 4: products of three and their sums are exact in binary64, but not in binary32.
Matrix random_matrix(Random& random) {
    std::array<double, 16> m{};
    for (double& x : m) x = random_int(random, -4095, 4095) / 1024.0;
    return strata::matrix_of(m);
}

// Entry (row, column) of projection * view * model; exact in any order.
double product(const View& view, const Matrix& model, std::size_t row, std::size_t column) {
    double sum = 0;
    for (std::size_t j = 0; j < 4; ++j)
        for (std::size_t k = 0; k < 4; ++k) sum += view.projection[j][row] * view.view[k][j] * model[column][k];
    return sum;
}

// clip[r] = ((m[r] x + m[4 + r] y) + m[8 + r] z) + m[12 + r], every operation rounded.
float clip_coordinate(const View& view, const Matrix& model, std::size_t r, const Vec3& p) {
    std::array<float, 4> m{};
    for (std::size_t column = 0; column < 4; ++column) m[column] = static_cast<float>(product(view, model, r, column));
    const float x = m[0] * p[0];
    const float y = m[1] * p[1];
    const float z = m[2] * p[2];
    const float xy = x + y;
    const float xyz = xy + z;
    return xyz + m[3];
}

bool same(const ClipVertex& a, const ClipVertex& b) {
    return a.x == b.x && a.y == b.y && a.z == b.z && a.w == b.w && a.front == b.front && a.back == b.back &&
           a.texcoord == b.texcoord;
}

bool same(const strata::rasterizer::SetupTriangle& a, const strata::rasterizer::SetupTriangle& b) {
    bool points = true;
    for (std::size_t i = 0; i < 3; ++i) points = points && a.p[i].x == b.p[i].x && a.p[i].y == b.p[i].y;
    return points && a.unsnapped == b.unsnapped && a.z == b.z && a.inverse_w == b.inverse_w &&
           a.attribute == b.attribute && a.primitive == b.primitive && a.material == b.material &&
           a.front_facing == b.front_facing;
}

// One triangle in the plane z = 0, counterclockwise for a viewer at +z.
DrawList one_triangle(const Material& material, const Matrix& model = identity) {
    DrawList list;
    list.meshes = {{.name = "",
                    .positions = {{-0.5f, -0.5f, 0}, {0.5f, -0.5f, 0}, {0, 0.5f, 0}},
                    .w = {},
                    .normals = {{0, 0, 1}, {0, 0, 1}, {0, 0, 1}},
                    .colors = {},
                    .texcoords = {},
                    .indices = {0, 1, 2}}};
    list.materials = {material};
    list.instances = {{.mesh = 0, .material = 0, .model = model}};
    return list;
}

// Some vertices are transformed in a group, others singly.
constexpr std::size_t several_vertices = 37;

// The light factor of a normal under a model and a view, in binary64.
double light_factor(const Vec3& n, const Matrix& m, const Matrix& view) {
    // Inverse transpose by Cramer's rule, up to the determinant: columns of cofactors.
    std::array<double, 3> world{};
    for (std::size_t r = 0; r < 3; ++r)
        for (std::size_t c = 0; c < 3; ++c) {
            const std::size_t r1 = (r + 1) % 3, r2 = (r + 2) % 3, c1 = (c + 1) % 3, c2 = (c + 2) % 3;
            world[r] += (m[c1][r1] * m[c2][r2] - m[c2][r1] * m[c1][r2]) * n[c];
        }
    const double length = std::sqrt(world[0] * world[0] + world[1] * world[1] + world[2] * world[2]);
    const double towards = std::sqrt(view[0][2] * view[0][2] + view[1][2] * view[1][2] + view[2][2] * view[2][2]);
    return 0.25 + 0.75 * std::fabs((world[0] * view[0][2] + world[1] * view[1][2] + world[2] * view[2][2]) /
                                   (length * towards));
}

}  // namespace

TEST_CASE("vertices are multiplied by the matrix product rounded once with every operation rounded") {
    Random random{501};
    std::size_t wrong = 0;
    for (int round = 0; round < 500; ++round) {
        DrawList list = one_triangle({.name = "", .unlit = true}, random_matrix(random));
        const View view{random_matrix(random), random_matrix(random)};
        list.meshes[0].positions.resize(several_vertices);
        list.meshes[0].normals.clear();
        for (Vec3& p : list.meshes[0].positions)
            for (float& x : strata::components(p)) x = random_float(random, -3, 3);
        const auto soup = transform(list, view, {});
        for (std::size_t i = 0; i < several_vertices; ++i) {
            const ClipVertex& v = soup.vertices[i];
            const std::array found{v.x, v.y, v.z, v.w};
            for (std::size_t r = 0; r < 4; ++r)
                wrong +=
                    found[r] != clip_coordinate(view, list.instances[0].model, r, list.meshes[0].positions[i]) ? 1 : 0;
        }
    }
    CHECK(wrong == 0);
}

TEST_CASE("lighting is 1/4 + 3/4 abs of N.L towards the eye under any model matrix and leaves alpha unchanged") {
    Random random{502};
    double worst = 0;
    std::size_t others = 0;
    for (int round = 0; round < 500; ++round) {
        DrawList list =
            one_triangle({.name = "", .front = {1, 0.5f, 0, 0.75f}, .back = {0, 0, 1, 0.25f}}, random_matrix(random));
        const View view{random_matrix(random), identity};
        list.meshes[0].positions.resize(several_vertices);
        list.meshes[0].normals.resize(several_vertices);
        for (Vec3& n : list.meshes[0].normals)
            for (float& x : strata::components(n)) x = random_float(random, -2, 2);
        const auto vertices = transform(list, view, {}).vertices;
        for (std::size_t i = 0; i < several_vertices; ++i) {
            const ClipVertex& v = vertices[i];
            const double expected = light_factor(list.meshes[0].normals[i], list.instances[0].model, view.view);
            worst = std::max({worst, std::fabs(v.front[0] - expected), std::fabs(v.front[1] - 0.5 * expected),
                              std::fabs(v.back[2] - expected)});
            others += v.front[2] != 0.0f || v.front[3] != 0.75f || v.back[0] != 0.0f || v.back[3] != 0.25f ? 1 : 0;
        }
    }
    CHECK(others == 0);
    CHECK(worst < 1e-5);
}

TEST_CASE(
    "a surface that faces the eye or away is fully lit and one seen edge-on a quarter and an unlit one not at all") {
    const auto red = [](const Vec3& normal, bool unlit) {
        DrawList list = one_triangle({.name = "", .unlit = unlit});
        list.meshes[0].normals.assign(3, normal);
        return transform(list, {}, {}).vertices[0].front[0];
    };
    CHECK(red({0, 0, 3}, false) == 1.0f);
    CHECK(red({0, 0, -0.5f}, false) == 1.0f);
    CHECK(red({1, 2, 0}, false) == 0.25f);
    CHECK(red({0, 0, 0}, false) == 0.25f);
    CHECK(red({1, 0, 0}, true) == 1.0f);
}

TEST_CASE("every instruction set lights and transforms vertices to the same bits including normals of length zero") {
    Random random{503};
    DrawList list = one_triangle({.name = "", .front = {1, 0.5f, 0.25f, 0.75f}}, random_matrix(random));
    list.meshes[0].positions.resize(500);
    list.meshes[0].normals.resize(500);
    for (Vec3& p : list.meshes[0].positions)
        for (float& x : strata::components(p)) x = random_float(random, -3, 3);
    const float not_a_number = std::numeric_limits<float>::quiet_NaN(),
                infinity = std::numeric_limits<float>::infinity();
    for (Vec3& n : list.meshes[0].normals) {
        const auto one_of = std::array{0.0f, -0.0f, 1.0f, 0x1p-80f, 0x1p80f, not_a_number, infinity};
        for (float& x : strata::components(n))
            x = random() % 4 == 0 ? one_of[random() % one_of.size()] : random_float(random, -2, 2);
        if (random() % 8 == 0) n = {0.0f, -0.0f, 0.0f};
    }
    const View view{random_matrix(random), random_matrix(random)};
    const auto bits = [&](strata::Simd simd) {
        const strata::SimdScope kernels{simd};
        std::vector<std::array<std::uint32_t, 14>> all;
        for (const ClipVertex& v : transform(list, view, {}).vertices)
            all.push_back(std::bit_cast<std::array<std::uint32_t, 14>>(v));
        return all;
    };
    const auto scalar = bits(strata::Simd::scalar);
    for (const strata::Simd simd : strata::available_simd()) CHECK(bits(simd) == scalar);
}

TEST_CASE("vertex colours multiply the material's") {
    DrawList list = one_triangle({.name = "", .front = {0.5f, 1, 0.25f, 0.5f}, .unlit = true});
    list.meshes[0].colors = {{0.5f, 0.25f, 1, 0.5f}, {1, 1, 1, 1}, {0, 0, 0, 0}};
    const auto soup = transform(list, {}, {});
    CHECK(soup.vertices[0].front == std::array{0.25f, 0.25f, 0.25f, 0.25f});
    CHECK(soup.vertices[0].back == std::array{0.5f, 0.25f, 1.0f, 0.5f});
}

TEST_CASE("a mirrored instance reverses its winding and its front stays its front") {
    const auto prepared = [](double x_scale, double y_scale) {
        Matrix model = identity;
        model[0][0] = x_scale;
        model[1][1] = y_scale;
        const DrawList list = one_triangle({.name = ""}, model);
        strata::rasterizer::RasterState raster;  // culls back faces
        raster.viewport = {0, 0, 16, 16};
        return prepare(list, {}, raster, *find_profile("geforce8"), {});
    };
    for (const double y : {1.0, -1.0})
        for (const double x : {1.0, -1.0}) {
            const PreparedDraw draw = prepared(x, y);
            REQUIRE(draw.geometry.triangles.size() == 1);
            CHECK(draw.geometry.triangles[0].front_facing);
        }
}

TEST_CASE("an instance without volume is not mirrored because its model's determinant is 0") {
    Matrix model = identity;
    model[2][2] = 0;
    strata::rasterizer::RasterState raster;
    raster.viewport = {0, 0, 16, 16};
    const PreparedDraw draw = prepare(one_triangle({.name = ""}, model), {}, raster, *find_profile("geforce8"), {});
    REQUIRE(draw.geometry.triangles.size() == 1);
    CHECK(draw.geometry.triangles[0].front_facing);
}

TEST_CASE("a w buffer's unit is the far plane's w where clip z is clip w or 1 without such a plane") {
    const auto scale = [](double zz, double zw, double wz, double ww) {  // clip z = zz z + zw, clip w = wz z + ww
        View view;
        view.projection[2][2] = zz;
        view.projection[3][2] = zw;
        view.projection[2][3] = wz;
        view.projection[3][3] = ww;
        strata::rasterizer::RasterState raster;
        raster.viewport = {0, 0, 16, 16};
        raster.depth_format = DepthFormat::d24;
        return prepare(one_triangle({.name = ""}), view, raster, *find_profile("geforce3"), {}).geometry.state.w_scale;
    };
    CHECK(scale(-3, -8, -1, 2) == static_cast<float>(16777215.0 / 7));  // z = w at z = -5
    CHECK(scale(-1.5, -2, -1, 0) == static_cast<float>(16777215.0 / 4));
    CHECK(scale(-1, -2, -1, 0) == 1.0f);  // an infinite far plane
    CHECK(scale(-0.5, 2, -1, 0) == static_cast<float>(16777215.0 / 4));
    CHECK(scale(-0.5, -2, -1, 0) == 1.0f);  // behind the eye
}

TEST_CASE("parts keep their primitives and their depth range contains all of their fragments") {
    const TriangleScene scene = random_triangles(507, 24);
    for (const char* profile : {"geforce8", "ideal", "llvmpipe"}) {
        strata::rasterizer::RasterState raster;
        raster.viewport = {0, 0, 64, 64};
        PrepareOptions options{.selection = Selection::transparent, .tile_size = 8};
        options.order = [](const auto& soup) {
            const auto first = soup.runs[0].index_count / 3;
            return SubmissionOrder{{}, {{0, first}, {first, static_cast<std::uint32_t>(soup.indices.size() / 3)}}};
        };
        const PreparedDraw draw = prepare(scene.list, scene.view, raster, *find_profile(profile), options);
        REQUIRE(draw.parts.size() == 2);
        TestFrame test{FragmentScene{64, 64}, profile};
        test.frame.transparent = &draw;
        RegionStatistics statistics;
        Region region{test.frame, {test.frame.rect()}, statistics};
        std::size_t outside = 0;
        const auto fragments = RegionShortcuts{region}.capture(Counting::counted);
        for (const CapturedFragment& f : fragments)
            for (const DrawPart& part : draw.parts)
                if (f.primitive >= part.primitives.first && f.primitive < part.primitives.last)
                    outside += double{f.shader_z} < part.near || double{f.shader_z} > part.far ? 1 : 0;
        CHECK(fragments.size() > 1000);
        CHECK(outside == 0);
        CHECK(draw.parts[0].near > 0);
        CHECK(draw.parts[0].far < 1);
    }
}

TEST_CASE("altered vertices are projected and altered corners are drawn") {
    const TriangleScene scene = random_triangles(508, 24);
    strata::rasterizer::RasterState raster;
    raster.viewport = {0, 0, 64, 64};
    const auto prepared = [&](const VertexAlteration* alteration) {
        return prepare(scene.list, scene.view, raster, *find_profile("geforce8"), {.alteration = alteration});
    };
    // Doubles w together with x, y and z: a power of two moves no vertex, but halves 1 / w.
    const VertexAlteration doubled{.vertices =
                                       [](strata::rasterizer::TriangleSoup& soup) {
                                           for (ClipVertex& v : soup.vertices)
                                               for (float* const c : {&v.x, &v.y, &v.z, &v.w}) *c *= 2;
                                       },
                                   .corners =
                                       [](strata::rasterizer::Geometry& geometry) {
                                           for (auto& corner : geometry.corners) corner.z = 0.25f;
                                       }};
    const PreparedDraw usual = prepared(nullptr), altered = prepared(&doubled);
    REQUIRE(altered.geometry.corners.size() == usual.geometry.corners.size());
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < usual.geometry.corners.size(); ++i) {
        const auto &a = usual.geometry.corners[i], &b = altered.geometry.corners[i];
        wrong += a.p.x != b.p.x || a.p.y != b.p.y || a.inverse_w != 2 * b.inverse_w || b.z != 0.25f ? 1 : 0;
    }
    CHECK(usual.geometry.corners.size() > 20);
    CHECK(wrong == 0);
}

TEST_CASE("opaque and masked materials go to the opaque list and blended ones to the transparent") {
    const TriangleScene scene = random_triangles(504, 8);  // materials: blend, blend, mask, opaque
    const auto materials = [&](Selection selection) {
        std::vector<std::uint32_t> found;
        for (const auto& run : transform(scene.list, scene.view, {.selection = selection}).runs)
            found.push_back(run.material);
        return found;
    };
    CHECK(materials(Selection::all) == std::vector<std::uint32_t>{0, 1, 2, 3});
    CHECK(materials(Selection::opaque) == std::vector<std::uint32_t>{2, 3});
    CHECK(materials(Selection::transparent) == std::vector<std::uint32_t>{0, 1});
}

TEST_CASE("MASK tests the material's own alpha when every alpha is scaled") {
    for (const float scale : {1.0f, 0.5f, 0.1f})
        for (const float alpha : {0.25f, 0.374f, 0.375f, 0.5f, 0.75f}) {  // .374 and .375 are codes 95 and 96
            FragmentScene scene{4, 4};
            scene.pixels[5].fragments = {{0.5f, {1, 1, 1, alpha}}};
            DrawList list = draw_list(scene);
            list.materials[0].alpha_mode = AlphaMode::mask;
            list.materials[0].alpha_cutoff = 0.375f;
            strata::rasterizer::RasterState raster;
            raster.viewport = {0, 0, 4, 4};
            const PreparedDraw draw =
                prepare(list, {}, raster, *find_profile("ideal"), {.alpha_scale = scale, .tile_size = 8});
            TestFrame test{scene, "ideal"};
            test.frame.transparent = &draw;
            for (const Format format : {Format::rgba8, Format::rgba32f}) {
                test.frame.color_format = format;
                RegionStatistics statistics;
                Region region{test.frame, {test.frame.rect()}, statistics};
                const auto fragments = RegionShortcuts{region}.capture(Counting::counted);
                CHECK(fragments.size() == (alpha >= 0.375f ? 1 : 0));
                for (const CapturedFragment& f : fragments) CHECK(f.color[3] == alpha * scale);
            }
        }
}

TEST_CASE("lists know whether a pass must shade for textures or for alphas that MASK tests") {
    const auto needs = [](Selection selection) {
        const TriangleScene scene = random_triangles(505, 8);
        strata::rasterizer::RasterState raster;
        raster.viewport = {0, 0, 16, 16};
        const PreparedDraw draw =
            prepare(scene.list, scene.view, raster, *find_profile("geforce8"), {.selection = selection});
        return std::pair{draw.needs.texcoord, draw.needs.color};
    };
    CHECK(needs(Selection::opaque) == std::pair{true, true});
    CHECK(needs(Selection::transparent) == std::pair{true, false});
}

TEST_CASE("vertices and triangles and bins do not depend on the number of threads") {
    TriangleScene scene = random_triangles(506, 6000);  // several chunks of vertices
    strata::rasterizer::RasterState raster;
    raster.viewport = {0, 0, 64, 64};
    const auto prepared = [&](int threads) {
        return prepare(scene.list, scene.view, raster, *find_profile("geforce8"), {.threads = threads});
    };
    const PreparedDraw one = prepared(1);
    REQUIRE(one.geometry.triangles.size() > 5000);
    const auto vertices = transform(scene.list, scene.view, {.threads = 1}).vertices;
    for (const int threads : {2, 4, 0}) {
        const PreparedDraw other = prepared(threads);
        CHECK(std::ranges::equal(transform(scene.list, scene.view, {.threads = threads}).vertices, vertices,
                                 [](const ClipVertex& a, const ClipVertex& b) { return same(a, b); }));
        REQUIRE(other.geometry.triangles.size() == one.geometry.triangles.size());
        std::size_t wrong = 0;
        for (std::size_t i = 0; i < one.geometry.triangles.size(); ++i)
            wrong += same(other.geometry.triangle(i), one.geometry.triangle(i)) ? 0 : 1;
        CHECK(wrong == 0);
        CHECK(other.geometry.bin_triangles == one.geometry.bin_triangles);
        CHECK(other.geometry.counters == one.geometry.counters);
    }
}
