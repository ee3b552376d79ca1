// Checks the matrices that the test suite's host (the Xbox CPU) computes against exact rational arithmetic, and the
// un-projected points against the hardware captures.
#include "tools/lab/hardware_check/drawing/host_matrices.h"

#include <boost/multiprecision/cpp_int.hpp>
#include <catch2/catch.hpp>
#include <cmath>
#include <string>

#include "tools/lab/hardware_check/drawing/fixed_pipeline.h"

using namespace strata::hardware_check;
using Rational = boost::multiprecision::cpp_rational;

namespace {

[[nodiscard]] Rational entry_of_product(const HostMatrix& a, const HostMatrix& b, std::size_t r, std::size_t c) {
    Rational sum{0};
    for (std::size_t i = 0; i < 4; ++i) sum += Rational{a[r][i]} * Rational{b[i][c]};
    return sum;
}

// Largest absolute value in column c, as a scale for differences.
[[nodiscard]] double size_of_column(const HostMatrix& m, std::size_t c) {
    double size = 0;
    for (const HostVector& row : m) size = std::max(size, std::fabs(double{row[c]}));
    return size;
}

}  // namespace

TEST_CASE("a host matrix times its inverse is the identity within rounding error") {
    for (const HostCamera& camera : {default_camera(65535.0f), default_camera(16777215.0f),
                                     camera_of(look_at({0, 50, -7}, {0, 47, 0}), perspective_to_window(16777215.0f)),
                                     camera_of(look_at({0, 0, -7}, {0, 0, 0}), orthographic_to_window(10, 100))}) {
        std::string wrong;
        for (std::size_t r = 0; r < 4; ++r)
            for (std::size_t c = 0; c < 4; ++c) {
                // The tolerance is relative to the largest product in the sum.
                double terms = 0;
                for (std::size_t i = 0; i < 4; ++i)
                    terms = std::max(terms, std::fabs(double{camera.composite[r][i]} * double{camera.inverse[i][c]}));
                const Rational off = entry_of_product(camera.composite, camera.inverse, r, c) - (r == c ? 1 : 0);
                if (std::fabs(off.convert_to<double>()) > std::max(terms, 1.0) * 0x1p-20)
                    wrong += std::to_string(r) + "," + std::to_string(c) + " ";
            }
        CHECK(wrong.empty());
        CHECK(size_of_column(camera.composite, 0) > 0);
    }
}

TEST_CASE("the axes of a view are orthonormal and its eye becomes the origin") {
    const std::array<float, 3> eye{0, 50, -7};
    const HostMatrix view = look_at(eye, {0, 47, 0});
    for (std::size_t a = 0; a < 3; ++a)
        for (std::size_t b = 0; b < 3; ++b) {
            double dot = 0;
            for (std::size_t i = 0; i < 3; ++i) dot += double{view[i][a]} * double{view[i][b]};
            CHECK(dot == Approx(a == b ? 1 : 0).margin(1e-6));
        }
    const HostVector origin = product(HostVector{eye[0], eye[1], eye[2], 1}, view);
    for (std::size_t i = 0; i < 3; ++i) CHECK(origin[i] == Approx(0).margin(1e-5));
    CHECK(view[2][2] > 0);  // the point ahead has positive z
}

// Capture ProjAdjacentGeometry_0.5625: corners are requested at 9/16 pixel, on a step of the 1/16-pixel grid. After
// un-projection and re-projection they are just above or below that step. The expected sides of columns and rows are
// read from the capture, at world z 10 and 0 (rasterizer/reference/chip-geometry.md 1.3).
TEST_CASE("points that the host un-projects are re-projected to the same side of a 1/16-pixel step as in the capture") {
    const HostCamera camera = default_camera(65535.0f);
    const CompositeMatrix view = columns_of(look_at({0, 0, -7}, {0, 0, 0})),
                          to_window = columns_of(perspective_to_window(65535.0f));
    const auto by_program = [&](float x, float y, float z) {
        return chip_quotient(chip_product(to_window, chip_product(view, unprojected(camera, x, y, z))));
    };
    constexpr float past = 0.5625f;
    struct Seen {
        float place;
        bool is_below_at_10, is_below_at_0;
    };
    for (const Seen& column :
         {Seen{120, false, false}, Seen{220, false, false}, Seen{420, true, true}, Seen{520, true, true}}) {
        CHECK((by_program(column.place + past, 140 + past, 10)[0] < column.place + past) == column.is_below_at_10);
        CHECK((by_program(column.place + past, 240 + past, 0)[0] < column.place + past) == column.is_below_at_0);
    }
    CHECK(by_program(320 + past, 140 + past, 10)[0] < 320 + past);
    CHECK(by_program(120 + past, 140 + past, 10)[1] < 140 + past);
    CHECK(by_program(120 + past, 240 + past, 0)[1] < 240 + past);
    CHECK(by_program(420 + past, 240 + past, 10)[1] < 240 + past);
    CHECK(by_program(220 + past, 340 + past, 0)[1] < 340 + past);
}

// Un-projection interpolates between the points at depths 0 and 64000. With a 24-bit buffer both are next to the near
// plane, so the line is short and the rounding error is amplified.
TEST_CASE("un-projecting a window point and projecting it again returns the same point within a tolerance") {
    const HostCamera camera = default_camera(16777215.0f);
    for (const float z : {-6.0f, -5.0f, 0.0f, 96.5f, 193.0f})
        for (const float x : {0.5f, 128.0f, 511.9f})
            for (const float y : {10.25f, 240.0f, 479.0f}) {
                const HostVector world = unprojected(camera, x, y, z);
                CHECK(world[2] == z);
                const double w = double{z} + 7;
                CHECK(320 + 240 * 2.414213562373095 * double{world[0]} / w == Approx(double{x}).margin(2e-2));
                CHECK(240 - 240 * 2.414213562373095 * double{world[1]} / w == Approx(double{y}).margin(2e-2));
            }
    const HostCamera flat = camera_of(look_at({0, 0, -3}, {0, 0, 0}), orthographic_to_window(10, 100));
    const HostVector back = unprojected_point(flat, {90, 60, 45, 1});
    const HostVector again = product(back, flat.composite);
    CHECK(again[0] == Approx(90).margin(1e-3));
    CHECK(again[1] == Approx(60).margin(1e-3));
    CHECK(again[2] == Approx(45).margin(0.1));  // on a scale of 65535
}

// The test suite switches the depth buffer to a float format without rebuilding its matrices, so depths keep the scale
// of the fixed-point buffer. With 16-bit floats every depth of the floor is then the greatest code, as in the captures.
TEST_CASE(
    "with the fixed-function pipeline a float depth buffer stores depths in the scale of the fixed-point buffer") {
    const auto picture = [](const char* name) {
        return *find_suite("W_buffering")->draw(name, *strata::pipeline::find_profile("geforce3")).picture;
    };
    const SuitePicture small = picture("ZBuf16F_FloorQuad_V0_ZB0_ZS0_ZB");
    CHECK(std::all_of(small.image.codes.begin(), small.image.codes.end(), [](std::uint32_t c) { return c == 0xffff; }));
    // w is not affected by the depth scale, so both formats store the same w.
    const SuitePicture fixed = picture("WBuf24D_FloorQuad_V0_ZB0_ZS0_ZB"),
                       large = picture("WBuf24F_FloorQuad_V0_ZB0_ZS0_ZB");
    std::size_t wrong = 0, drawn = 0;
    for (std::size_t i = 0; i < fixed.image.codes.size(); ++i) {
        if (fixed.image.codes[i] == 0xffffff) continue;
        ++drawn;
        const double w = double{std::bit_cast<float>(large.image.codes[i] << 7)};
        wrong += std::floor(w) != double(fixed.image.codes[i]) && std::fabs(w - fixed.image.codes[i]) > 1 ? 1 : 0;
    }
    CHECK(wrong == 0);
    CHECK(drawn > 100000);
}
