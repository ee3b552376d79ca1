// tools/library/scene.cpp - builds scenes from triangles in a program's memory, and their cameras.
#include "strata/scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "rasterizer/base/input_error.h"
#include "rasterizer/rules/primitive.h"
#include "scenes/bounds.h"
#include "scenes/camera.h"
#include "scenes/packs/pack_scene.h"

namespace strata {
inline namespace v0_1 {

namespace {

// Reads one set of triangles; errors name the field.
class Fields {
  public:
    explicit Fields(const Triangles& triangles) : thing_{"triangles '" + triangles.name + "'"} {}

    [[noreturn]] void fail(const std::string& field, const std::string& expected, const std::string& found) const {
        throw InputError(thing_, field, expected, found);
    }
    template <class Number>
    void finite(const std::string& field, std::span<const Number> values) const {
        for (std::size_t i = 0; i < values.size(); ++i)
            if (!std::isfinite(values[i]))
                fail(field + "[" + std::to_string(i) + "]", "a finite number", std::to_string(values[i]));
    }
    // The vectors of an attribute, copied to a vector.
    template <class Vector>
    [[nodiscard]] std::vector<Vector> copied(const char* field, const VertexArray& from) const {
        if (from.count > 0 && from.first == nullptr)
            fail(std::string{field} + ".first", "the address of " + std::to_string(from.count) + " vertices", "null");
        const std::size_t stride = from.stride_bytes == 0 ? sizeof(Vector) : from.stride_bytes;
        if (stride < sizeof(Vector))
            fail(std::string{field} + ".stride_bytes", "0 or at least " + std::to_string(sizeof(Vector)),
                 std::to_string(stride));
        std::vector<Vector> to(from.count);
        const auto* bytes = static_cast<const std::byte*>(from.first);
        for (std::size_t i = 0; i < from.count; ++i) std::memcpy(&to[i].x, bytes + i * stride, sizeof(Vector));
        return to;
    }

  private:
    std::string thing_;
};

std::size_t corners_of(const Fields& its, Primitive primitive) {
    switch (primitive) {
        case Primitive::triangles: return 3;
        case Primitive::lines: return 2;
        case Primitive::points: return 1;
        default: break;
    }
    its.fail("primitive", "triangles, lines or points", std::to_string(static_cast<int>(primitive)));
}

std::vector<std::uint32_t> indices_of(const Fields& its, const Triangles& triangles) {
    const std::size_t count = triangles.positions.count, corners = corners_of(its, triangles.primitive);
    const char* const expected = corners == 3 ? "three per triangle" : "two per line";
    const std::span<const std::uint32_t> given = triangles.indices;
    const std::size_t used = given.empty() ? count : given.size();
    if (used % corners != 0) its.fail(given.empty() ? "positions.count" : "indices", expected, std::to_string(used));
    std::vector<std::uint32_t> all;
    all.reserve(used / corners * 3);
    std::array<std::uint32_t, 3> corner;
    for (std::size_t i = 0; i < used; ++i) {
        const std::uint32_t index = given.empty() ? static_cast<std::uint32_t>(i) : given[i];
        if (index >= count)
            its.fail("indices[" + std::to_string(i) + "]", "less than " + std::to_string(count), std::to_string(index));
        corner[i % corners] = index;
        if ((i + 1) % corners == 0) rasterizer::append_primitive(all, {corner.data(), corners});
    }
    return all;
}

}  // namespace

Scene::Scene(const std::string& spec, const SceneOptions& options)
    : scene_{scenes::load_scene(spec, options)},
      is_loaded_{true},
      is_pack_{scenes::is_pack(spec)},
      space_{options.color_space} {}

Scene& Scene::add(const Triangles& triangles) {
    const Fields its{triangles};
    if (triangles.positions.count == 0) its.fail("positions.count", "at least 1", "0");
    if (triangles.positions.count > UINT32_MAX)
        its.fail("positions.count", "at most 4294967295", std::to_string(triangles.positions.count));
    if (triangles.colors.count != 0 && triangles.colors.count != triangles.positions.count)
        its.fail("colors.count", std::to_string(triangles.positions.count) + " or none",
                 std::to_string(triangles.colors.count));
    its.finite<float>("color", triangles.color);
    if (triangles.model) its.finite<double>("model", *triangles.model);

    pipeline::Mesh mesh;
    mesh.name = triangles.name;
    mesh.positions = its.copied<Vec3>("positions", triangles.positions);
    mesh.colors = its.copied<Rgba>("colors", triangles.colors);
    mesh.indices = indices_of(its, triangles);
    mesh.primitive = triangles.primitive;
    const auto& c = triangles.color;
    const Rgba color{c[0], c[1], c[2], c[3]};
    pipeline::DrawList& list = scene_.list;
    list.instances.push_back({.mesh = static_cast<std::uint32_t>(list.meshes.size()),
                              .material = static_cast<std::uint32_t>(list.materials.size()),
                              .model = triangles.model ? matrix_of(*triangles.model) : identity});
    list.materials.push_back(
        {.name = triangles.name,
         .front = color,
         .back = color,
         .alpha_mode = triangles.is_transparent ? pipeline::AlphaMode::blend : pipeline::AlphaMode::opaque,
         .double_sided = triangles.is_double_sided,
         .unlit = true});
    list.meshes.push_back(std::move(mesh));
    scene_.bounds = scenes::bounds_of(list);
    return *this;
}

Scene& Scene::look(const View& view) {
    own_view_ = view;
    look_at_.reset();
    orbit_.reset();
    return *this;
}

Scene& Scene::look_at(const LookAt& camera) {
    const auto require = [](bool holds, const char* field, const char* expected, double found) {
        if (!holds) throw InputError("camera", field, expected, std::to_string(found));
    };
    const auto finite = [&](const char* field, const Vec3d& v) {
        for (const double component : components(v))
            require(std::isfinite(component), field, "finite numbers", component);
    };
    finite("eye", camera.eye);
    finite("center", camera.center);
    finite("up", camera.up);
    require(camera.eye != camera.center, "center", "another point than the eye", camera.center.x);
    require(camera.fovy_degrees > 0 && camera.fovy_degrees < 180, "fovy_degrees", "a number between 0 and 180",
            camera.fovy_degrees);
    require(camera.near > 0 && std::isfinite(camera.near), "near", "a finite number above 0", camera.near);
    require(camera.far > camera.near && std::isfinite(camera.far), "far", "a finite number above near", camera.far);
    own_view_.reset();
    look_at_ = camera;
    orbit_.reset();
    return *this;
}

Scene& Scene::orbit(double azimuth_degrees, double elevation_degrees) {
    // Throws InputError for invalid angles.
    static_cast<void>(scenes::orbit_camera(scene_.bounds, azimuth_degrees, elevation_degrees));
    own_view_.reset();
    look_at_.reset();
    orbit_ = {azimuth_degrees, elevation_degrees};
    return *this;
}

View Scene::view(int width, int height, const rasterizer::RasterState& raster) const {
    const double aspect = height > 0 ? double(width) / height : 1;
    if (own_view_) return *own_view_;
    if (!look_at_ && !orbit_ && is_pack_) return *scene_.own_view;
    const auto in_convention = [&](const View& view) {
        return scenes::with_clip_convention(view, {}, scenes::view_convention(raster));
    };
    if (look_at_) return in_convention(scenes::look_at(*look_at_, aspect));
    if (!orbit_ && !is_loaded_) return {};
    if (!orbit_ && scene_.own_view) return in_convention(*scene_.own_view);
    const Orbit orbit = orbit_.value_or(Orbit{});
    return in_convention(scenes::orbit_view(scene_.bounds, orbit.azimuth, orbit.elevation, aspect));
}

}  // namespace v0_1
}  // namespace strata
