#include "tests/fuzz/scene_of_bytes.h"

#include <limits>

namespace strata::fuzz {

using namespace pipeline;

namespace {

constexpr Matrix perspective{2, 0, 0, 0, 0, 2, 0, 0, 0, 0, -1.5, -1, 0, 0, -2.5, 0};  // near 1, far 5

constexpr std::array<float, 16> hard_numbers{0.0f,
                                             -0.0f,
                                             1.0f,
                                             -1.0f,
                                             0x1p-20f,
                                             -0x1p-126f,
                                             0x1p-149f,
                                             100.0f,
                                             -3.0e4f,
                                             1e9f,
                                             -1e30f,
                                             std::numeric_limits<float>::max(),
                                             0.75f,
                                             -0.5f,
                                             std::numeric_limits<float>::infinity(),
                                             std::numeric_limits<float>::quiet_NaN()};

enum class Placement : std::uint8_t { corners, on_grid, anywhere, hard };

// A channel value; 0 and 1 are frequent.
float channel(ByteSource& bytes) {
    const int code = bytes.byte();
    return code < 32 ? 1.0f : code < 64 ? 0.0f : static_cast<float>(code) / 255.0f;
}

Rgba color(ByteSource& bytes) { return {channel(bytes), channel(bytes), channel(bytes), channel(bytes)}; }

// In [-1.5, 1.5] in clip space, or a multiple of half a pixel.
float coordinate(ByteSource& bytes, Placement placement, int pixels) {
    if (placement == Placement::hard && bytes.one_in(3)) return bytes.pick(hard_numbers);
    if (placement != Placement::on_grid) return 3 * bytes.fraction() - 1.5f;
    return static_cast<float>(bytes.below(2 * pixels + 9) - 4) / static_cast<float>(pixels) - 1;
}

// A vertex of a mesh that fills the screen is a corner of it; others are anywhere.
Vec3 position(ByteSource& bytes, Placement placement, bool is_perspective, int width, int height, int corner) {
    const bool is_corner = placement == Placement::corners && corner < 4;
    const float x = is_corner ? (corner % 2 == 0 ? -1.25f : 1.0f) : coordinate(bytes, placement, width);
    const float y = is_corner ? (corner < 2 ? -1.0f : 1.25f) : coordinate(bytes, placement, height);
    const float reach = bytes.one_in(6) ? 2.0f : 1.0f;  // beyond the near and far planes, or between them
    const float z = placement == Placement::anywhere ? reach * (2 * bytes.fraction() - 1)
                                                     : reach * static_cast<float>(bytes.below(15) - 7) / 8;
    if (!is_perspective) return {x, y, z};
    const float distance = 3 + 2 * z;  // z in [-1, 1] is between the planes, z < -1.5 behind the eye
    return {x * distance * 0.5f, y * distance * 0.5f, -distance};
}

void add_vertices(ByteSource& bytes, Mesh& mesh, bool is_perspective, int width, int height) {
    const Placement placement =
        bytes.pick(std::array{Placement::corners, Placement::corners, Placement::on_grid, Placement::on_grid,
                              Placement::anywhere, Placement::anywhere, Placement::hard});
    const bool is_colored = !bytes.one_in(4);
    const int count = 3 + bytes.below(8);
    for (int i = 0; i < count; ++i) {
        Vec3 p = position(bytes, placement, is_perspective, width, height, i);
        if (i > 0 && bytes.one_in(8)) {  // a sliver: next to the previous vertex
            p = mesh.positions.back();
            p[static_cast<std::size_t>(bytes.below(3))] += bytes.fraction() * 0x1p-6f;
        }
        mesh.positions.push_back(p);
        mesh.normals.push_back({bytes.fraction() - 0.5f, bytes.fraction() - 0.5f, 0.5f});
        mesh.texcoords.push_back({4 * bytes.fraction() - 1, 4 * bytes.fraction() - 1});
        if (is_colored) mesh.colors.push_back(color(bytes));
    }
}

// Neighbours share vertices; some triangles occur twice, some are degenerate.
void add_triangles(ByteSource& bytes, Mesh& mesh) {
    const auto vertices = static_cast<int>(mesh.positions.size());
    const int count = 1 + bytes.below(8);
    for (int t = 0; t < count; ++t) {
        if (t > 0 && bytes.one_in(4)) {
            const auto first = static_cast<std::size_t>(3 * bytes.below(t));
            for (std::size_t corner = 0; corner < 3; ++corner) mesh.indices.push_back(mesh.indices[first + corner]);
            continue;
        }
        for (int corner = 0; corner < 3; ++corner)
            mesh.indices.push_back(
                static_cast<std::uint32_t>((t + corner + (bytes.one_in(2) ? bytes.below(vertices) : 0)) % vertices));
    }
}

Texture texture(ByteSource& bytes) {
    constexpr std::array wraps{TextureWrap::repeat, TextureWrap::mirrored_repeat, TextureWrap::clamp_to_edge};
    Texture t;
    t.width = 1 + bytes.below(4);
    t.height = 1 + bytes.below(4);
    t.target = bytes.one_in(8) ? TextureTarget::rectangle : TextureTarget::two_d;
    t.filter = bytes.one_in(2) ? TextureFilter::nearest : TextureFilter::linear;
    t.wrap_s = t.target == TextureTarget::rectangle ? TextureWrap::clamp_to_edge : bytes.pick(wraps);
    t.wrap_t = t.target == TextureTarget::rectangle ? TextureWrap::clamp_to_edge : bytes.pick(wraps);
    t.decode_srgb = bytes.one_in(4);
    for (int i = 0; i < 4 * t.width * t.height; ++i) t.texels.push_back(static_cast<std::uint8_t>(bytes.byte()));
    return t;
}

Material material(ByteSource& bytes, int number, int textures) {
    constexpr std::array others{AlphaMode::blend, AlphaMode::blend, AlphaMode::opaque, AlphaMode::mask};
    Material m;
    m.alpha_mode = number == 0 && !bytes.one_in(16) ? AlphaMode::blend : bytes.pick(others);
    m.front = color(bytes);
    m.back = bytes.one_in(3) ? color(bytes) : m.front;
    m.alpha_cutoff = channel(bytes);
    m.texture = bytes.one_in(3) ? bytes.below(textures + 1) - 1 : -1;
    m.double_sided = !bytes.one_in(4);
    m.unlit = !bytes.one_in(3);
    return m;
}

Matrix model(ByteSource& bytes) {
    Matrix m = identity;
    if (bytes.one_in(2)) m[3][2] = (bytes.below(17) - 8) / 16.0;
    if (bytes.one_in(4)) m[3][0] = (bytes.below(17) - 8) / 16.0;
    if (bytes.one_in(6)) m[0][0] = -1;
    if (bytes.one_in(6)) m[1][1] = bytes.fraction() * 2.0;
    return m;
}

}  // namespace

View view_of(ByteSource& bytes) {
    View view;
    if (bytes.one_in(2)) view.projection = perspective;
    if (bytes.one_in(4))
        view.view = {0.95, 0.02, 0.1, 0, -0.03, 0.99, 0.05, 0, -0.1, -0.04, 0.97, 0, 0.01, 0.02, -0.03, 1};
    return view;
}

DrawList list_of(ByteSource& bytes, const View& view, int width, int height) {
    DrawList list;
    const int meshes = 1 + bytes.below(3), materials = 1 + bytes.below(3), textures = bytes.below(3);
    const int instances = 1 + bytes.below(bytes.one_in(6) ? 24 : 6);
    for (int i = 0; i < materials; ++i) list.materials.push_back(material(bytes, i, textures));
    for (int i = 0; i < instances; ++i)
        list.instances.push_back({.mesh = static_cast<std::uint32_t>(i < meshes ? i : bytes.below(meshes)),
                                  .material = static_cast<std::uint32_t>(bytes.below(materials)),
                                  .model = model(bytes),
                                  .arrives_sorted = bytes.one_in(3)});
    for (int i = 0; i < meshes; ++i) {
        Mesh mesh;
        add_vertices(bytes, mesh, view.projection == perspective, width, height);
        add_triangles(bytes, mesh);
        list.meshes.push_back(std::move(mesh));
    }
    for (int i = 0; i < textures; ++i) list.textures.push_back(texture(bytes));
    return list;
}

}  // namespace strata::fuzz
