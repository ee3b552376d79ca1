// Tests the contents of a frame's lists besides positions and light, against the draw list itself and matrices
// multiplied out.
#include <catch2/catch.hpp>
#include <cmath>

#include "pipeline/vertices/other_splits.h"
#include "pipeline/vertices/prepare.h"
#include "pipeline/vertices/quotient_rows.h"
#include "tests/support/random_triangles.h"

namespace {

using namespace strata::testing;
using namespace strata::pipeline;
using strata::rasterizer::RasterState;
using strata::rasterizer::Rect;

// A square in the plane z = 0.5 of clip space for each material, side by side in order.
[[nodiscard]] DrawList squares_of(const std::vector<Material>& materials) {
    DrawList list;
    list.textures.resize(2);
    for (Texture& texture : list.textures) texture.texels = {0, 0, 0, 0};
    list.materials = materials;
    for (std::uint32_t i = 0; i < materials.size(); ++i) {
        const float x = -0.9f + 0.3f * static_cast<float>(i);
        list.meshes.push_back(
            {.name = "",
             .positions = {{x, -0.5f, 0.5f}, {x + 0.25f, -0.5f, 0.5f}, {x + 0.25f, 0.5f, 0.5f}, {x, 0.5f, 0.5f}},
             .w = {},
             .normals = {},
             .colors = {},
             .texcoords = {},
             .indices = {0, 1, 2, 2, 3, 0}});
        list.instances.push_back({.mesh = i, .material = i});
    }
    return list;
}

[[nodiscard]] Material flat_material(AlphaMode mode, int texture = -1) {
    return {.name = "",
            .front = {1, 1, 1, 0.5f},
            .back = {1, 1, 1, 0.5f},
            .alpha_mode = mode,
            .alpha_cutoff = 0.375f,
            .texture = texture,
            .double_sided = true,
            .unlit = true};
}

[[nodiscard]] RasterState frame_state() {
    RasterState state;
    state.viewport = {0, 0, 64, 48};
    return state;
}

[[nodiscard]] const std::vector<Material>& six_materials() {
    static const std::vector<Material> materials{flat_material(AlphaMode::opaque),  flat_material(AlphaMode::mask),
                                                 flat_material(AlphaMode::blend),   flat_material(AlphaMode::opaque, 1),
                                                 flat_material(AlphaMode::mask, 0), flat_material(AlphaMode::blend, 1)};
    return materials;
}

}  // namespace

TEST_CASE("each triangle run of a soup names its instance and material and its indices are vertices of its own mesh") {
    DrawList list = squares_of(six_materials());
    list.materials[2].double_sided = false;
    list.instances[3].model[0][0] = -1;
    list.instances.push_back({.mesh = 1, .material = 2});
    for (const Selection selection : {Selection::all, Selection::opaque, Selection::transparent}) {
        const auto soup = transform(list, {}, {.selection = selection});
        std::size_t at = 0, wrong = 0;
        std::uint32_t vertices = 0;
        for (std::uint32_t i = 0; i < list.instances.size(); ++i) {
            const std::uint32_t m = list.instances[i].material;
            const bool blends = list.materials[m].alpha_mode == AlphaMode::blend;
            if (selection != Selection::all && blends != (selection == Selection::transparent)) continue;
            REQUIRE(at < soup.runs.size());
            const auto& run = soup.runs[at++];
            wrong += run.object != i || run.material != m || run.index_count != 6 ? 1 : 0;
            wrong += run.double_sided != list.materials[m].double_sided || run.mirrored != (i == 3) ? 1 : 0;
            for (std::uint32_t k = 0; k < 6; ++k)
                wrong += soup.indices[run.first_index + k] != vertices + list.meshes[list.instances[i].mesh].indices[k]
                             ? 1
                             : 0;
            vertices += 4;
        }
        CHECK(at == soup.runs.size());
        CHECK(soup.vertices.size() == vertices);
        CHECK(wrong == 0);
    }
}

TEST_CASE(
    "the option --alpha scales every alpha at the vertex except a MASK material's which is scaled after its test") {
    const DrawList list = squares_of(six_materials());
    const auto soup = transform(list, {}, {.alpha_scale = 0.25f});
    const PreparedDraw prepared =
        prepare(list, {}, frame_state(), *find_profile("ideal"), {.alpha_scale = 0.25f, .threads = 1});
    REQUIRE(prepared.materials.size() == 6);
    for (std::size_t i = 0; i < 6; ++i) {
        const bool masks = list.materials[i].alpha_mode == AlphaMode::mask;
        CHECK(soup.vertices[4 * i].front[3] == (masks ? 0.5f : 0.125f));
        CHECK(soup.vertices[4 * i].back[3] == (masks ? 0.5f : 0.125f));
        CHECK(soup.vertices[4 * i].front[0] == 1.0f);
        const MaterialStage& stage = prepared.materials[i];
        CHECK(stage.alpha_scale == (masks ? 0.25f : 1.0f));
        CHECK(stage.mask == (masks ? AlphaTest{true, CompareFunc::gequal, 0.375f} : AlphaTest{}));
        CHECK(stage.texture == (i < 3 ? nullptr : &list.textures[i == 4 ? 0 : 1]));
    }
}

TEST_CASE("a list needs what its selected materials need and a set of its triangles what theirs do") {
    const DrawList list = squares_of(six_materials());
    const auto prepared = [&](Selection selection, bool shadow = false) {
        return prepare(list, {}, frame_state(), *find_profile("ideal"),
                       {.selection = selection, .threads = 1, .receives_shadow = shadow});
    };
    CHECK(prepared(Selection::all).needs == MaterialNeeds{true, true, 0});
    CHECK(prepared(Selection::transparent).needs == MaterialNeeds{true, false, 0});
    CHECK(prepared(Selection::opaque, true).needs == MaterialNeeds{true, true, 0xf000});
    const PreparedDraw all = prepared(Selection::all, true);
    REQUIRE(all.geometry.triangles.size() == 12);
    CHECK(needs_of(all, {}) == MaterialNeeds{false, false, 0xf000});
    for (std::uint32_t t = 0; t < 12; ++t) {
        const std::uint32_t material = t / 2;
        const MaterialNeeds expected{material >= 3, material == 1 || material == 4, 0xf000};
        CHECK(needs_of(all, {&t, 1}) == expected);
    }
    const std::array<std::uint32_t, 3> plain{0, 1, 4}, several{0, 3, 7};
    CHECK(needs_of(all, plain) == MaterialNeeds{false, false, 0xf000});
    CHECK(needs_of(all, several) == MaterialNeeds{true, true, 0xf000});
}

TEST_CASE("parts have the order's ranges and depths 0 to 1 where depth is clamped or else their own") {
    DrawList list =
        squares_of({flat_material(AlphaMode::blend), flat_material(AlphaMode::blend), flat_material(AlphaMode::blend)});
    for (std::size_t i = 0; i < 3; ++i)
        for (Vec3& p : list.meshes[i].positions) p[2] = 0.25f * static_cast<float>(i);
    PrepareOptions options{.threads = 1};
    options.order = [](const auto&) { return SubmissionOrder{{0, 1, 2, 3, 4, 5}, {{0, 2}, {2, 4}, {4, 6}}}; };
    RasterState state = frame_state();
    for (const char* device : {"geforce3", "ideal"}) {
        state.depth_format = DepthFormat::d24;
        state.depth_clamp = false;
        const auto parts = prepare(list, {}, state, *find_profile(device), options).parts;
        REQUIRE(parts.size() == 3);
        for (std::size_t i = 0; i < 3; ++i) {
            const double z = 0.5 + 0.125 * static_cast<double>(i);
            CHECK(parts[i].primitives ==
                  PrimitiveRange{static_cast<std::uint32_t>(2 * i), static_cast<std::uint32_t>(2 * i + 2)});
            CHECK(parts[i].near <= z);
            CHECK(parts[i].near >= z - 0x1p-18);
            CHECK(parts[i].far >= z);
            CHECK(parts[i].far <= z + 0x1p-18);
        }
        state.depth_clamp = true;
        for (const DrawPart& part : prepare(list, {}, state, *find_profile(device), options).parts) {
            CHECK(part.near == 0.0);
            CHECK(part.far == 1.0);
        }
    }
}

TEST_CASE(
    "a vertex's extras begin with r and q and end with the texture units and either is the same without the other") {
    const TriangleScene scene = random_triangles(741, 12);
    CoordinateUnits units{};
    units[1] = {.enabled = true, .gen = eye_position()};
    units[2] = {.enabled = true, .gen = eye_position(), .matrix = scaling(2, 3, 4)};
    const auto extras = [&](bool quotient, const CoordinateUnits& wanted) {
        return prepare(scene.list, scene.view, frame_state(), *find_profile("geforce8"),
                       {.depth_quotient = quotient, .threads = 1, .units = wanted})
            .geometry.extras;
    };
    const auto both = extras(true, units), rq = extras(true, {}), alone = extras(false, units);
    CHECK(extras(false, {}).stride == 0);
    CHECK((both.stride == 18 && rq.stride == 2 && alone.stride == 16));
    CHECK((both.has_rq && both.has_units && rq.has_rq && !rq.has_units && !alone.has_rq && alone.has_units));
    const std::size_t vertices = rq.values.size() / 2;
    REQUIRE((vertices > 20 && both.values.size() == 18 * vertices && alone.values.size() == 16 * vertices));
    std::size_t wrong = 0;
    for (std::size_t v = 0; v < vertices; ++v) {
        wrong += both.of(v)[0] != rq.of(v)[0] || both.of(v)[1] != rq.of(v)[1] ? 1 : 0;
        for (std::size_t k = 0; k < 16; ++k) wrong += both.units_of(v)[k] != alone.of(v)[k] ? 1 : 0;
        for (std::size_t c = 0; c < 4; ++c) {  // unit 2 is unit 1 scaled; unit 0 is unused
            const float factor = std::array{2.0f, 3.0f, 4.0f, 1.0f}[c];
            wrong += std::fabs(alone.of(v)[8 + c] - factor * alone.of(v)[4 + c]) > 1e-5f ? 1 : 0;
            wrong += alone.of(v)[c] != 0.0f ? 1 : 0;
        }
    }
    CHECK(wrong == 0);
}

TEST_CASE("the texture matrix of depth maps clip z from -w or from 0 to the depth range and keeps w as q") {
    Matrix projection;
    for (std::size_t i = 0; i < 16; ++i) projection[i / 4][i % 4] = static_cast<double>(i * i % 7) - 2.5;
    int wrong = 0;
    for (const bool symmetric : {true, false})
        for (const auto& [n, f] : {std::pair{0.0f, 1.0f}, std::pair{0.25f, 0.5f}, std::pair{0.75f, 0.125f}}) {
            RasterState state;
            state.clip_depth = symmetric ? strata::rasterizer::ClipDepth::minus_one_to_one
                                         : strata::rasterizer::ClipDepth::zero_to_one;
            state.depth_near = n, state.depth_far = f;
            const Matrix m = depth_texture_matrix(projection, state);
            for (std::size_t c = 0; c < 4; ++c) {
                const double z = projection[c][2], w = projection[c][3];
                const double r =
                    symmetric ? 0.5 * ((double{f} - n) * z + (double{f} + n) * w) : (double{f} - n) * z + n * w;
                wrong += m[c][0] != 0 || m[c][1] != 0 || m[c][2] != r || m[c][3] != w ? 1 : 0;
            }
        }
    CHECK(wrong == 0);
}

TEST_CASE(
    "moving the window moves viewport and scissor and both positions of every corner by whole pixels on each axis") {
    const TriangleScene scene = random_triangles(742, 10);
    for (const bool has_scissor : {false, true})
        for (const char* device : {"geforce3", "geforce8"}) {
            RasterState state = frame_state();
            if (has_scissor) state.scissor = Rect{4, 5, 30, 20};
            state.depth_format = DepthFormat::d24;
            const auto before = prepare(scene.list, scene.view, state, *find_profile(device), {.threads = 1}).geometry;
            auto after = before;
            move_window(after, 100, -7);
            CHECK(after.state.viewport == Rect{100, -7, 164, 41});
            CHECK(after.state.scissor == (has_scissor ? std::optional{Rect{104, -2, 130, 13}} : std::nullopt));
            const int unit = device == std::string{"geforce3"} ? 16 : 256;
            std::size_t wrong = 0;
            REQUIRE(after.corners.size() == before.corners.size());
            for (std::size_t i = 0; i < before.corners.size(); ++i) {
                const auto &a = before.corners[i], &b = after.corners[i];
                wrong += b.p.x != a.p.x + 100 * unit || b.p.y != a.p.y - 7 * unit ? 1 : 0;
                wrong += b.unsnapped[0] != a.unsnapped[0] + 100.0f || b.unsnapped[1] != a.unsnapped[1] - 7.0f ? 1 : 0;
                wrong += b.z != a.z || b.inverse_w != a.inverse_w ? 1 : 0;
            }
            CHECK(wrong == 0);
        }
}

TEST_CASE("light falls along the view's third row for any length and along z where the row is zero") {
    DrawList list = squares_of({{.name = "", .front = {1, 1, 1, 1}, .back = {1, 1, 1, 1}}});
    list.meshes[0].normals = {{0, 0, 1}, {1, 0, 0}, {0.6f, 0, 0.8f}, {0, 2, 0}};
    const auto reds = [&](const Matrix& matrix) {
        std::array<float, 4> red;
        const auto vertices = transform(list, {.view = matrix}, {}).vertices;
        for (std::size_t i = 0; i < 4; ++i) red[i] = vertices[i].front[0];
        return red;
    };
    CHECK(reds(identity) == std::array{1.0f, 0.25f, 0.25f + 0.75f * 0.8f, 0.25f});
    Matrix long_row = identity;
    long_row[2][2] = 1000;
    CHECK(reds(long_row) == reds(identity));
    Matrix sideways = identity;
    sideways[0][2] = 5, sideways[2][2] = 0;
    CHECK(reds(sideways)[1] == 1.0f);
    CHECK(reds(sideways)[0] == 0.25f);
    Matrix none = identity;
    none[2][2] = 0;
    CHECK(reds(none) == reds(identity));
}
