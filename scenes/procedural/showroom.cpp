// scenes/procedural/showroom.cpp - builds the draw list of showroom.h.
#include "scenes/procedural/showroom.h"

#include "scenes/bounds.h"
#include "scenes/numbers/srgb_encode.h"
#include "scenes/procedural/hard_cases/build_case.h"

namespace strata::scenes {
namespace {

using pipeline::AlphaMode;
using pipeline::Material;
using pipeline::Mesh;
using pipeline::Rgba;

constexpr int side = 64;  // pixels

struct Place {
    double x = 0, y = 0, w = 1;
};

// The position in space that the view shows at a window position.
pipeline::Vec3 seen(const Place& p) {
    static const CaseScene frame{.width = side, .height = side};
    return hard::point_at_window(frame, p.x, p.y, p.w);
}

enum class QuadFacing : std::uint8_t { eye, away };

struct Look {
    Rgba front{1, 1, 1, 1}, back{1, 1, 1, 1};
    AlphaMode mode = AlphaMode::blend;
    int texture = -1;
    bool double_sided = true, is_lit = false;
};

class RoomBuilder {
  public:
    explicit RoomBuilder(const SceneOptions& options) : options_{options} {}

    // Adds a mesh with its own material and instance. Corners are counterclockwise in the window.
    Mesh& add(const char* name, const Look& look) {
        Material material{.name = name,
                          .front = encoded(look.front),
                          .back = encoded(look.back),
                          .alpha_mode = look.mode,
                          .texture = look.texture,
                          .double_sided = look.double_sided,
                          .unlit = !look.is_lit || !options_.light};
        const auto number = static_cast<std::uint32_t>(list.meshes.size());
        list.materials.push_back(std::move(material));
        list.instances.push_back({.mesh = number, .material = number});
        list.meshes.emplace_back().name = name;
        return list.meshes.back();
    }

    // A fan over `places`; `colors` has one per corner, one for all, or none.
    void polygon(Mesh& mesh, const std::vector<Place>& places, const std::vector<Rgba>& colors = {},
                 QuadFacing facing = QuadFacing::eye) const {
        const auto first = static_cast<std::uint32_t>(mesh.positions.size());
        for (std::size_t i = 0; i < places.size(); ++i) {
            mesh.positions.push_back(seen(places[i]));
            if (!colors.empty()) mesh.colors.push_back(encoded(colors[i % colors.size()]));
        }
        for (std::uint32_t i = 2; i < places.size(); ++i)
            if (facing == QuadFacing::eye)
                mesh.indices.insert(mesh.indices.end(), {first, first + i - 1, first + i});
            else
                mesh.indices.insert(mesh.indices.end(), {first, first + i, first + i - 1});
    }

    // A rectangle in the window whose left and right sides are at the distances `left` and `right`.
    void pane(Mesh& mesh, const hard::CaseBox& box, double left, double right, const std::vector<Rgba>& colors = {},
              QuadFacing facing = QuadFacing::eye) const {
        polygon(mesh,
                {{box.left, box.top, left},
                 {box.left, box.bottom, left},
                 {box.right, box.bottom, right},
                 {box.right, box.top, right}},
                colors, facing);
    }

    pipeline::DrawList list;

  private:
    [[nodiscard]] Rgba encoded(const Rgba& color) const { return from_encoded(color, options_.color_space); }
    const SceneOptions& options_;
};

// 4 x 4 texels, all rows and columns different; every third texel has alpha 51, below the mask's cutoff.
pipeline::Texture sign_texture(const SceneOptions& options) {
    pipeline::Texture texture;
    texture.name = "sign";
    texture.width = texture.height = 4;
    texture.filter = pipeline::TextureFilter::linear;
    texture.decode_srgb = options.color_space == pipeline::ColorSpace::linear;
    for (int i = 0; i < 16; ++i)
        for (const int texel : {40 + 13 * i, 250 - 9 * i, (97 * i) % 256, i % 3 == 0 ? 51 : 255})
            texture.texels.push_back(static_cast<std::uint8_t>(texel));
    return texture;
}

void add_opaque(RoomBuilder& b) {
    b.pane(b.add("wall", {.mode = AlphaMode::opaque, .double_sided = false}), {8, 8, 56, 56}, 12, 12,
           {{0.55f, 0.5f, 0.4f, 1}, {0.3f, 0.35f, 0.5f, 1}});
    b.pane(b.add("post", {.front = {0.2f, 0.25f, 0.2f, 1}, .mode = AlphaMode::opaque}), {28, 8, 32, 60}, 3, 5);
    Mesh& sign = b.add("sign", {.mode = AlphaMode::mask, .texture = 0});
    b.pane(sign, {36, 10, 52, 26}, 6, 6);
    sign.texcoords = {{0, 0}, {0, 1.5f}, {1.5f, 1.5f}, {1.5f, 0}};
}

void add_panes(RoomBuilder& b) {
    b.pane(b.add("perspective", {.front = {1, 1, 1, 0.8f}, .back = {1, 1, 1, 0.8f}}), {4, 30, 60, 50}, 2, 10,
           {{1, 0.1f, 0.1f, 0.3f}, {1, 1, 0.1f, 0.9f}, {0.1f, 0.2f, 1, 0.6f}, {0.1f, 1, 0.3f, 0.4f}});
    b.pane(b.add("hidden", {.front = {1, 0, 1, 0.5f}, .back = {1, 0, 1, 0.5f}}), {20, 40, 44, 60}, 14, 14);
    Mesh& lit = b.add(
        "lit",
        {.front = {0.9f, 0.8f, 0.2f, 0.5f}, .back = {0.9f, 0.8f, 0.2f, 0.5f}, .double_sided = false, .is_lit = true});
    b.pane(lit, {10, 12, 26, 28}, 5, 5);
    lit.normals = {{0, 0, 1}, {0.6f, 0, 0.8f}, {0, 0.8f, 0.6f}, {1, 0, 0}};
    b.pane(b.add("facing away", {.front = {1, 1, 1, 0.5f}, .double_sided = false}), {14, 16, 30, 32}, 4.5, 4.5, {},
           QuadFacing::away);
    const Look two_colors{.front = {0.9f, 0.1f, 0.1f, 0.5f}, .back = {0.1f, 0.8f, 0.1f, 0.6f}};
    b.pane(b.add("two colours away", two_colors), {40, 34, 60, 60}, 4, 4, {}, QuadFacing::away);
    b.pane(b.add("two colours", two_colors), {44, 44, 62, 62}, 3.5, 3.5);
    b.pane(b.add("solid", {.front = {0.7f, 0.3f, 0.6f, 1}, .back = {0.7f, 0.3f, 0.6f, 1}}), {54, 22, 62, 34}, 6.5, 6.5);
    Mesh& glass = b.add("stained glass", {.front = {1, 1, 1, 0.6f}, .back = {1, 1, 1, 0.6f}, .texture = 0});
    b.pane(glass, {2, 50, 18, 62}, 5.5, 5.5);
    glass.texcoords = {{-0.25f, 0}, {-0.25f, 1}, {1, 1}, {1, 0}};
}

// Planes that meet, nearly meet, or test the device's rules for depths and edges.
void add_meetings(RoomBuilder& b) {
    const Look plain;
    Mesh& ties = b.add("ties", plain);
    for (const Rgba& color : {Rgba{1, 0, 0, 0.5f}, Rgba{0, 1, 0, 0.25f}, Rgba{0, 0, 1, 0.75f}})
        b.pane(ties, {2, 34, 18, 46}, 7, 7, {color});
    Mesh& near = b.add("near-coincident", plain);
    b.pane(near, {2, 2, 14, 10}, 8, 8, {{1, 0.5f, 0, 0.5f}});
    b.pane(near, {2, 2, 14, 10}, 8 - 0x1p-15, 8 - 0x1p-15, {{0, 0.5f, 1, 0.5f}});
    Mesh& crossing = b.add("crossing", plain);
    b.pane(crossing, {16, 2, 48, 8}, 1.0009765625, 1.0009765625, {{0.9f, 0.9f, 0, 0.5f}});
    b.pane(crossing, {16, 2, 48, 8}, 1.0009765625 - 0x1p-21, 1.0009765625 + 0x1p-21, {{0, 0.2f, 0.9f, 0.5f}});
    Mesh& planes = b.add("near plane", plain);
    b.pane(planes, {50, 2, 63, 20}, 0.5, 4, {{0.2f, 0.9f, 0.9f, 0.4f}});
    b.pane(planes, {56, 56, 64, 64}, 1, 1, {{0.9f, 0.2f, 0.9f, 0.4f}});
    Mesh& edges = b.add("edges", plain);
    b.pane(edges, {20.5, 54.5, 30.5, 61.5}, 2, 2, {{0.1f, 0.4f, 0.9f, 0.5f}});
    b.pane(edges, {30.5, 54.5, 40.5, 61.5}, 2, 2, {{0.9f, 0.4f, 0.1f, 0.5f}});
    Mesh& slivers = b.add("slivers", plain);
    for (int i = 0; i < 24; ++i) {
        const double x = 4 + i * 2.37, top = 24 + (i * 7) % 11 + i / 7.0;
        b.polygon(slivers,
                  {{x, top, 2.5 + i / 16.0}, {x + 1.31, top + 9.17, 3 + i / 9.0}, {x + 2.93, top + 1.61, 2.75}},
                  {hard::color_of(i, 0.4f)});
    }
}

}  // namespace

Scene make_showroom(const SceneOptions& options) {
    RoomBuilder builder{options};
    add_opaque(builder);
    add_panes(builder);
    add_meetings(builder);
    Scene scene;
    scene.name = "showroom";
    scene.list = std::move(builder.list);
    scene.list.textures = {sign_texture(options)};
    scene.own_view = hard::perspective_view(1);
    scene.bounds = bounds_of(scene.list);
    return scene;
}

}  // namespace strata::scenes
