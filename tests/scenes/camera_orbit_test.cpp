// Tests the orbit camera by projecting points that the picture must contain, and by angles on both sides of the limits.
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "rasterizer/base/input_error.h"
#include "scenes/camera.h"

namespace {

using namespace strata::scenes;
using strata::pipeline::View;

std::array<double, 4> to_clip(const View& view, const std::array<double, 3>& p) {
    std::array<double, 4> eye{}, clip{};
    for (std::size_t r = 0; r < 4; ++r)
        eye[r] = view.view[0][r] * p[0] + view.view[1][r] * p[1] + view.view[2][r] * p[2] + view.view[3][r];
    for (std::size_t r = 0; r < 4; ++r)
        for (std::size_t c = 0; c < 4; ++c) clip[r] += view.projection[c][r] * eye[c];
    return clip;
}

std::string said_by_orbit(double azimuth, double elevation) {
    try {
        static_cast<void>(orbit_camera({}, azimuth, elevation));
    } catch (const strata::InputError& error) {
        return error.what();
    }
    return "accepted";
}

}  // namespace

TEST_CASE("an orbit shows the centre of the box in the middle and all of its bounding sphere between its planes") {
    std::mt19937_64 random{11};
    std::uniform_real_distribution<double> unit{-1, 1};
    std::string wrong;
    for (int i = 0; i < 300; ++i) {
        Bounds box;
        const double scale = std::exp2(20 * unit(random));
        std::array<double, 3> center{};
        double radius = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            const double a = scale * unit(random), b = scale * unit(random);
            box.lo[k] = std::min(a, b);
            box.hi[k] = std::max(a, b);
            center[k] = (a + b) / 2;
            radius += (a - b) * (a - b) / 4;
        }
        radius = std::sqrt(radius);
        const double azimuth = 1000 * unit(random), elevation = 89 * unit(random);
        const View view = orbit_view(box, azimuth, elevation, 1.25);
        const auto middle = to_clip(view, center);
        bool right = std::fabs(middle[0]) < 1e-9 * middle[3] && std::fabs(middle[1]) < 1e-9 * middle[3] &&
                     std::fabs(middle[3] - 2.5 * radius) < 1e-9 * radius;
        for (int corner = 0; corner < 8; ++corner) {
            const auto clip = to_clip(view, {corner & 1 ? box.hi[0] : box.lo[0], corner & 2 ? box.hi[1] : box.lo[1],
                                             corner & 4 ? box.hi[2] : box.lo[2]});
            right = right && std::fabs(clip[2]) < clip[3] && clip[3] > 1.4 * radius && clip[3] < 3.6 * radius;
        }
        const LookAt camera = orbit_camera(box, azimuth, elevation);
        right = right && std::fabs(camera.near - 1.4 * radius) < 1e-12 * radius &&
                std::fabs(camera.far - 3.6 * radius) < 1e-12 * radius && camera.fovy_degrees == 45;
        if (!right && wrong.empty()) wrong = std::to_string(azimuth) + ", " + std::to_string(elevation);
    }
    CHECK(wrong == "");
}

TEST_CASE("angles of an orbit are accepted up to their limits and rejected beyond with separate messages") {
    for (const double sign : {1.0, -1.0}) {
        CHECK(said_by_orbit(0, sign * 90) == "accepted");
        CHECK(said_by_orbit(sign * 1e6, 0) == "accepted");
        CHECK_THAT(said_by_orbit(0, sign * std::nextafter(90, 91)),
                   Catch::StartsWith("--orbit: elevation: expected degrees from -90 to 90, found "));
        CHECK_THAT(said_by_orbit(sign * std::nextafter(1e6, 2e6), 0),
                   Catch::StartsWith("--orbit: azimuth: expected degrees from -1000000 to 1000000, found "));
    }
    CHECK_THAT(said_by_orbit(2e6, 91), Catch::Contains("azimuth"));  // the first of two faults
    for (const double bad : {std::nan(""), HUGE_VAL, -HUGE_VAL}) {
        CHECK_THAT(said_by_orbit(bad, 0), Catch::Contains("azimuth"));
        CHECK_THAT(said_by_orbit(0, bad), Catch::Contains("elevation"));
    }
}

TEST_CASE("up is +y until the line of sight is within a millionth of it and from there perpendicular to that line") {
    for (const double sign : {1.0, -1.0})
        for (const double azimuth : {0.0, 25.0, -170.0}) {
            const double turn = azimuth * std::acos(-1.0) / 180;
            for (const double short_of : {1.0, 1e-3, 6e-5}) {  // degrees
                const LookAt camera = orbit_camera({}, azimuth, sign * (90 - short_of));
                CHECK((camera.up[0] == 0 && camera.up[1] == 1 && camera.up[2] == 0));
            }
            for (const double short_of : {0.0, 1e-6, 5e-5}) {
                const LookAt camera = orbit_camera({}, azimuth, sign * (90 - short_of));
                CHECK(camera.up[0] == Approx(-sign * std::sin(turn)).margin(1e-12));
                CHECK(camera.up[1] == 0);
                CHECK(camera.up[2] == Approx(-sign * std::cos(turn)).margin(1e-12));
            }
        }
}

TEST_CASE("a box without extent is seen like one of radius 1 and an empty one from around the origin") {
    const LookAt empty = orbit_camera({}, 0, 0), point = orbit_camera({{3, 4, 5}, {3, 4, 5}}, 90, 0);
    CHECK((empty.eye[0] == 0 && empty.eye[1] == 0 && empty.eye[2] == 2.5));
    CHECK((empty.center[0] == 0 && empty.center[1] == 0 && empty.center[2] == 0));
    CHECK((empty.near == 1.4 && empty.far == 3.6));
    CHECK((point.center[0] == 3 && point.center[1] == 4 && point.center[2] == 5));
    CHECK(point.eye[0] == Approx(5.5));
    CHECK(point.eye[2] == Approx(5));
    CHECK((point.near == 1.4 && point.far == 3.6));
}

TEST_CASE("a scene's camera keeps its own aspect ratio and uses the image's only if it has none") {
    for (const double own : {0.0, 0.5, 2.0})
        for (const double image : {0.75, 1.0, 3.0}) {
            const SceneCamera camera{.yfov = 1, .aspect = own, .znear = 1, .zfar = 9};
            const auto m = camera_view(camera, image).projection;
            CHECK(m[1][1] / m[0][0] == Approx(own > 0 ? own : image));
        }
    SceneCamera flat{.perspective = false, .aspect = 7, .xmag = -2, .ymag = 5, .znear = 0, .zfar = 4};
    flat.view[3][0] = 42;
    const View view = camera_view(flat, 3);
    CHECK(view.view == flat.view);
    CHECK((view.projection[0][0] == -0.5 && view.projection[1][1] == 0.2 && view.projection[3][3] == 1));
    CHECK((view.projection[2][2] == -0.5 && view.projection[3][2] == -1 && view.projection[2][3] == 0));
}
