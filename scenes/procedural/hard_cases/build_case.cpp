// scenes/procedural/hard_cases/build_case.cpp - triangles, quads and views from positions in pixels (build_case.h).
#include "scenes/procedural/hard_cases/build_case.h"

namespace strata::scenes::hard {

CaseBox whole(const CaseScene& scene) noexcept {
    return {0, 0, static_cast<double>(scene.width), static_cast<double>(scene.height)};
}

pipeline::Vec3 position(const CaseScene& scene, const CaseCorner& corner) noexcept {
    return {static_cast<float>(2 * corner.x / scene.width - 1), static_cast<float>(1 - 2 * corner.y / scene.height),
            static_cast<float>(2 * corner.depth - 1)};
}

void add(pipeline::Mesh& mesh, const std::array<pipeline::Vec3, 3>& positions, const pipeline::Rgba& color) {
    for (const pipeline::Vec3& p : positions) {
        mesh.indices.push_back(static_cast<std::uint32_t>(mesh.positions.size()));
        mesh.positions.push_back(p);
        mesh.colors.push_back(color);
    }
}

void add(CaseScene& scene, const std::array<CaseCorner, 3>& corners, const pipeline::Rgba& color) {
    add(scene.transparent, {position(scene, corners[0]), position(scene, corners[1]), position(scene, corners[2])},
        color);
}

namespace {

// Top left, top right, bottom left, bottom right.
using Quad = std::array<pipeline::Vec3, 4>;

Quad quad_of(const CaseScene& scene, const CaseBox& box, const Tilt& depth) noexcept {
    const auto corner = [&](double x, double y) { return position(scene, {x, y, depth.at(x, y)}); };
    return {corner(box.left, box.top), corner(box.right, box.top), corner(box.left, box.bottom),
            corner(box.right, box.bottom)};
}

// Counterclockwise in the window.
void add_corners(pipeline::Mesh& mesh, const Quad& q, const pipeline::Rgba& color, Diagonal diagonal) {
    if (diagonal == Diagonal::falling) {
        add(mesh, {q[0], q[2], q[3]}, color);
        add(mesh, {q[0], q[3], q[1]}, color);
    } else {
        add(mesh, {q[0], q[2], q[1]}, color);
        add(mesh, {q[1], q[2], q[3]}, color);
    }
}

}  // namespace

void add_quad(CaseScene& scene, const CaseBox& box, const Tilt& depth, const pipeline::Rgba& color, Diagonal diagonal) {
    add_corners(scene.transparent, quad_of(scene, box, depth), color, diagonal);
}

void add_opaque_quad(CaseScene& scene, const CaseBox& box, const Tilt& depth, const pipeline::Rgba& color) {
    add_corners(scene.opaque, quad_of(scene, box, depth), color, Diagonal::falling);
}

// Clip coordinates are x, y, w - 2 near and w: depth before the window's mapping is 1 - 2 near / w.
pipeline::View perspective_view(double near) {
    pipeline::View view;
    view.projection[2][2] = -1;
    view.projection[2][3] = -1;
    view.projection[3][2] = -2 * near;
    view.projection[3][3] = 0;
    return view;
}

pipeline::View perspective_view(double near, double far) {
    pipeline::View view = perspective_view(near);
    view.projection[2][2] = -(far + near) / (far - near);
    view.projection[3][2] = -2 * far * near / (far - near);
    return view;
}

// The eye looks along -z, and clip x is eye x.
pipeline::Vec3 point_at_window(const CaseScene& scene, double x, double y, double w) noexcept {
    const pipeline::Vec3 at_one = position(scene, {x, y, 0});
    return {static_cast<float>(double{at_one.x} * w), static_cast<float>(double{at_one.y} * w), static_cast<float>(-w)};
}

void add_facing_quad(CaseScene& scene, double w, const pipeline::Rgba& color) {
    const double right = scene.width, bottom = scene.height;
    add_corners(scene.transparent,
                {point_at_window(scene, 0, 0, w), point_at_window(scene, right, 0, w),
                 point_at_window(scene, 0, bottom, w), point_at_window(scene, right, bottom, w)},
                color, Diagonal::falling);
}

pipeline::Rgba color_of(int number, float alpha) noexcept {
    // Eighths: exact in every format except UNORM8, which rounds them the same way on every computer.
    const auto eighth = [](int n) { return static_cast<float>(n % 8 + 1) * 0.125f; };
    return {eighth(3 * number), eighth(5 * number + 2), eighth(7 * number + 5), alpha};
}

}  // namespace strata::scenes::hard
