// Tests the depth kernel on a batch that ends within a vector: lanes after its count must not matter.
#include "rasterizer/values/lane_kernels.h"

#include <catch2/catch.hpp>
#include <vector>

#include "rasterizer/base/simd.h"
#include "tests/rasterizer/support.h"

using namespace strata::rasterizer;

// Of the last vector of 65 to 80 pixels all are in row 5 except the last pixel, in row 6; the lanes after them still
// have row 5. The expected weights are computed by the kernel `weights` pixel by pixel.
TEST_CASE("a partly filled vector is not taken for one row because of its unused lanes") {
    const Geometry geometry =
        window_geometry({window_triangle({{{3, 7}, {30000, 900}, {500, 28000}}}, 8, {0.125, 0.5, 0.75})}, 128, 128, {});
    const PixelWeights weights{geometry, geometry.triangles[0]};
    const RationalPlane plane{geometry.depths(0), 1.0, 1.0};
    for (const strata::Simd simd : strata::available_simd()) {
        const strata::SimdScope kernels{simd};
        const LaneKernels& lanes = lane_kernels();
        if (lanes.depth == nullptr) continue;
        for (int count = 65; count <= 80; ++count) {
            std::vector<std::uint16_t> x(128), y(128, 5);
            for (std::size_t i = 0; i < x.size(); ++i) x[i] = static_cast<std::uint16_t>(i);
            const auto last = static_cast<std::size_t>(count - 1);
            x[last] = 2;
            y[last] = 6;
            std::vector<double> b1(128), b2(128), expected1(128), expected2(128);
            lanes.weights(weights, x.data(), y.data(), count, expected1.data(), expected2.data());
            static_cast<void>(
                lanes.depth(weights, {plane, true}, x.data(), y.data(), count,
                            {.to_code = {}, .shader_z = nullptr, .code = nullptr, .b1 = b1.data(), .b2 = b2.data()}));
            INFO("instruction set " << static_cast<int>(simd) << ", " << count << " pixels");
            CHECK(std::equal(b1.begin(), b1.begin() + count, expected1.begin()));
            CHECK(std::equal(b2.begin(), b2.begin() + count, expected2.begin()));
        }
    }
}
