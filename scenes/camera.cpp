// scenes/camera.cpp - the matrices of gluLookAt and gluPerspective, entry by entry. The order of the operations
// is part of the rule of camera.h: every bit of an image depends on these entries.
#include "scenes/camera.h"

#include <fmt/format.h>

#include <cmath>

#include "rasterizer/base/float_environment.h"
#include "rasterizer/base/input_error.h"
#include "rasterizer/base/vector_arithmetic.h"
#include "scenes/numbers/elementary.h"

namespace strata::scenes {
namespace {

// The vector must not be 0: parse_look_at() in camera_file.cpp and orbit_camera() ensure that.
Vec3d normalized(const Vec3d& a) noexcept { return divided(a, std::sqrt(dot_product(a, a))); }

// World to eye space, GLU 1.3 section 4.1: the rows are side, top and -forward, because the eye looks along -z. The
// initializer lists columns.
pipeline::Matrix look_at_matrix(const Vec3d& eye, const Vec3d& center, const Vec3d& up) noexcept {
    const Vec3d forward = normalized(minus(center, eye));
    const Vec3d side = normalized(cross_product(forward, up));
    const Vec3d top = cross_product(side, forward);
    return {side[0],
            top[0],
            -forward[0],
            0,
            side[1],
            top[1],
            -forward[1],
            0,
            side[2],
            top[2],
            -forward[2],
            0,
            -dot_product(side, eye),
            -dot_product(top, eye),
            dot_product(forward, eye),
            1};
}

// The two entries of a perspective matrix's third row; zfar 0: at infinity.
void set_depth_row(pipeline::Matrix& m, double znear, double zfar) noexcept {
    m[2][2] = zfar == 0 ? -1 : -(zfar + znear) / (zfar - znear);
    m[3][2] = zfar == 0 ? -2 * znear : -2 * znear * zfar / (zfar - znear);
    m[2][3] = -1;
}

// Right-handed eye space to clip space, GLU 1.3 section 4.2. `half_angle` is half the vertical angle in radians, whose
// cotangent scales y; x is scaled by the cotangent over `aspect`, which is width / height.
pipeline::Matrix perspective(double half_angle, double aspect, double znear, double zfar) noexcept {
    const double cotangent = cos(half_angle) / sin(half_angle);
    pipeline::Matrix m(0.0);
    m[0][0] = cotangent / aspect;
    m[1][1] = cotangent;
    set_depth_row(m, znear, zfar);
    return m;
}

// glTF 2.0 section 3.10.3: xmag and ymag are half the width and the height of the view. The image's aspect is not used.
pipeline::Matrix orthographic(const SceneCamera& camera) noexcept {
    pipeline::Matrix m(0.0);
    const double depth = camera.znear - camera.zfar;
    m[0][0] = 1 / camera.xmag;
    m[1][1] = 1 / camera.ymag;
    m[2][2] = 2 / depth;
    m[3][2] = (camera.zfar + camera.znear) / depth;
    m[3][3] = 1;
    return m;
}

// A NaN fails both comparisons and is rejected like an angle out of range.
void check_angle(const char* name, double angle, double limit, const char* expected) {
    if (angle >= -limit && angle <= limit) return;
    throw InputError("--orbit", name, expected, fmt::format("{}", angle));
}

struct Sphere {
    Vec3d center{0, 0, 0};
    double radius = 1;
};

// The sphere through the corners of the box. A box that is one point or empty gets radius 1, so that near and far of
// the orbit camera differ.
Sphere bounding_sphere(const Bounds& bounds) noexcept {
    if (bounds.is_empty()) return {};
    Sphere sphere;
    sphere.center = times(plus(bounds.lo, bounds.hi), 0.5);
    const Vec3d half = minus(bounds.hi, sphere.center);
    sphere.radius = std::sqrt(dot_product(half, half));
    if (sphere.radius == 0) sphere.radius = 1;
    return sphere;
}

}  // namespace

pipeline::View look_at(const LookAt& camera, double aspect) noexcept {
    const FloatEnvironment environment;
    return {look_at_matrix(camera.eye, camera.center, camera.up),
            perspective(radians(camera.fovy_degrees) / 2, aspect, camera.near, camera.far)};
}

LookAt orbit_camera(const Bounds& bounds, double azimuth_degrees, double elevation_degrees) {
    const FloatEnvironment environment;
    check_angle("azimuth", azimuth_degrees, 1e6, "degrees from -1000000 to 1000000");
    check_angle("elevation", elevation_degrees, 90, "degrees from -90 to 90");
    const double azimuth = radians(azimuth_degrees), elevation = radians(elevation_degrees);
    const Vec3d outward{cos(elevation) * sin(azimuth), sin(elevation), cos(elevation) * cos(azimuth)};
    const auto [center, radius] = bounding_sphere(bounds);

    LookAt camera{
        .eye = plus(center, times(outward, 2.5 * radius)), .center = center, .near = 1.4 * radius, .far = 3.6 * radius};
    if (std::abs(outward[1]) > 0x1.ffffffffffp-1) {  // within 10^-6 radians of a pole: the line of sight is along y
        const double sign = outward[1] > 0 ? -1 : 1;
        camera.up = {sign * sin(azimuth), 0, sign * cos(azimuth)};
    }
    return camera;
}

pipeline::View orbit_view(const Bounds& bounds, double azimuth_degrees, double elevation_degrees, double aspect) {
    return look_at(orbit_camera(bounds, azimuth_degrees, elevation_degrees), aspect);
}

ClipConvention view_convention(const rasterizer::RasterState& state) noexcept {
    using rasterizer::DepthOrder;
    return {state.clip_depth, state.depth_near > state.depth_far ? DepthOrder::less : state.depth_order};
}

pipeline::View with_clip_convention(const pipeline::View& view, const ClipConvention& from, const ClipConvention& to) {
    using rasterizer::ClipDepth;
    const FloatEnvironment environment;
    pipeline::View seen = view;
    for (int column = 0; column < 4; ++column) {
        const double w = view.projection[column][3];
        double& z = seen.projection[column][2];
        const bool is_zero_to_one = to.clip_depth == ClipDepth::zero_to_one;
        if (from.clip_depth != to.clip_depth) z = is_zero_to_one ? (z + w) / 2 : z * 2 - w;
        if (from.depth_order != to.depth_order) z = is_zero_to_one ? w - z : -z;
    }
    return seen;
}

pipeline::View camera_view(const SceneCamera& camera, double image_aspect) {
    const FloatEnvironment environment;
    // A camera of the file with its own aspect keeps it: an image of another shape is then stretched.
    if (!camera.perspective) return {camera.view, orthographic(camera)};
    const double aspect = camera.aspect > 0 ? camera.aspect : image_aspect;
    return {camera.view, perspective(camera.yfov / 2, aspect, camera.znear, camera.zfar)};
}

}  // namespace strata::scenes
