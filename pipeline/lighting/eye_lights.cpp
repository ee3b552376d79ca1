// pipeline/lighting/eye_lights.cpp - moves lights into eye space (eye_lights.h).
#include "pipeline/lighting/eye_lights.h"

#include <cmath>

#include "rasterizer/base/numerics.h"
#include "rasterizer/base/vector_arithmetic.h"

namespace strata::pipeline {

namespace {

// Row r of the upper 3 x 3 times a vector.
double row_times(const Matrix& m, std::size_t r, const Vec3& v) noexcept {
    return (m[0][r] * double{v.x} + m[1][r] * double{v.y}) + m[2][r] * double{v.z};
}

Three rounded_once(const Vec3d& v) noexcept {
    return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

Vec3d unit_direction(const Matrix& view, const Vec3& v) noexcept {
    const Vec3d eye{row_times(view, 0, v), row_times(view, 1, v), row_times(view, 2, v)};
    const double length = std::sqrt(dot_product(eye, eye));
    return length > 0.0 ? divided(eye, length) : Vec3d{};
}

// By its series to the 28th power, whose next term is below 2^-70 up to 90 degrees.
double cosine_of_degrees(double degrees) noexcept {
    constexpr double pi = 0x1.921fb54442d18p+1;
    const double angle = degrees * pi / 180.0, square = angle * angle;
    double series = 1.0;
    for (int k = 28; k > 0; k -= 2) series = 1.0 - series * (square / (k * (k - 1)));
    return series;
}

}  // namespace

EyeLighting in_eye_space(const Lighting& lighting, const Matrix& view) {
    EyeLighting eye{{}, lighting.model};
    for (const Light& light : lighting.lights) {
        const Vec3d shines = unit_direction(view, light.direction);
        const Vec3& p = light.position;
        eye.lights.push_back(
            {.light = light,
             .toward = rounded_once(times(shines, -1.0)),
             .position = rounded_once({row_times(view, 0, p) + view[3][0], row_times(view, 1, p) + view[3][1],
                                       row_times(view, 2, p) + view[3][2]}),
             .axis = rounded_once(shines),
             .cosine = static_cast<float>(cosine_of_degrees(double{light.cutoff}))});
    }
    return eye;
}

}  // namespace strata::pipeline
