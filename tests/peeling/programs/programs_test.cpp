// Tests the lane loops of fragment programs on every instruction set against the scalar loops that define them, bit by
// bit, and the scalar loops against the papers' definitions.
#include "peeling/programs/programs.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>
#include <limits>
#include <memory>

#include "peeling/programs/average.h"
#include "peeling/programs/depth_float.h"
#include "peeling/programs/min_max.h"
#include "rasterizer/base/simd.h"
#include "tests/support/random_numbers.h"

using namespace strata;
using namespace strata::pipeline;
using namespace strata::peeling;

namespace {

constexpr std::array<int, 12> counts{0, 1, 3, 4, 8, 15, 16, 17, 33, 64, 253, 256};
constexpr std::array<float, 12> depths{0.0f,
                                       -0.0f,
                                       0.25f,
                                       0.5f,
                                       0.75f,
                                       1.0f,
                                       -1.0f,
                                       -0.5f,
                                       2.0f,
                                       0x1p-130f,
                                       std::numeric_limits<float>::infinity(),
                                       std::numeric_limits<float>::quiet_NaN()};

// Inputs and outputs of a peel; all lanes are random, depths are often equal.
struct Peel {
    FragmentBatch in{};
    ColorLanes min_max{}, front{};
    Lanes<std::uint32_t> opaque{}, alive{};
    PeelLanes place{};
    std::array<ColorLanes, 4> out{};

    explicit Peel(testing::Random& random) {
        const auto depth = [&] { return depths[static_cast<std::size_t>(testing::random_int(random, 0, 11))]; };
        const auto color = [&] { return static_cast<float>(testing::random_int(random, 0, 255)) / 255.0f; };
        in.count = counts[static_cast<std::size_t>(testing::random_int(random, 0, 11))];
        for (std::size_t i = 0; i < 256; ++i) {
            in.shader_z[i] = depth();
            in.code[i] = std::bit_cast<std::uint32_t>(depth());
            opaque[i] = std::bit_cast<std::uint32_t>(depth());
            alive[i] = testing::random_int(random, 0, 1) != 0 ? ~0u : 0u;
            for (std::size_t c = 0; c < 4; ++c)
                in.color[c][i] = color(), front[c][i] = color(), min_max[c][i] = depth();
        }
    }
};

void run_scalar(Peel& p) {
    const auto n = lanes(p.in);
    peeling::scalar::premultiply(p.in.color, p.out[0], n);
    peeling::scalar::discard_peeled(p.in.code, p.opaque, p.alive, n);
    peeling::scalar::classify(p.in.shader_z, p.min_max, p.opaque, p.place, n);
    peeling::scalar::write_min_max(p.in.shader_z, p.place.is_between, p.out[1], n);
    peeling::scalar::write_layers(p.in.color, p.front, p.place, p.out[2], p.out[3], n);
}

void run_chosen(Peel& p) {
    auto out = std::make_unique<Outputs>();
    out->alive = p.alive;
    premultiply(p.in.color, p.out[0], lanes(p.in));
    discard_peeled(p.in, p.opaque, *out);
    classify(p.in, p.min_max, p.opaque, p.place);
    write_min_max(p.in, p.place.is_between, p.out[1]);
    write_layers(p.in, p.front, p.place, p.out[2], p.out[3]);
    p.alive = out->alive;
}

template <class T>
bool same(const Lanes<T>& a, const Lanes<T>& b, std::size_t count) {
    return std::memcmp(a.data(), b.data(), count * sizeof(T)) == 0;
}

bool same(const Peel& a, const Peel& b) {
    const auto n = lanes(a.in);
    bool equal = same(a.alive, b.alive, n) && same(a.place.is_near, b.place.is_near, n) &&
                 same(a.place.is_far, b.place.is_far, n) && same(a.place.is_between, b.place.is_between, n);
    for (std::size_t k = 0; k < 4; ++k)
        for (std::size_t c = 0; c < (k == 1 ? 2u : 4u); ++c) equal = equal && same(a.out[k][c], b.out[k][c], n);
    return equal;
}

// A named function, because a lambda would be constexpr and compilers would evaluate it for seconds.
std::size_t wrong_codes(strata::rasterizer::DepthFormat format, std::uint32_t step) {
    std::size_t count = 0;
    float before = -1.0f;
    for (std::uint32_t code = 0; code <= strata::rasterizer::max_code(format); code += step) {
        const float value = depth_as_float(code, format);
        count += depth_as_code(value, format) != code || !(value > before) ? 1 : 0;
        before = value;
    }
    return count;
}

}  // namespace

TEST_CASE("fragment programs compute the same bits on every instruction set") {
    for (const Simd simd : available_simd()) {
        const SimdScope kernels{simd};
        testing::Random random{77};
        int wrong = 0;
        for (int round = 0; round < 400; ++round) {
            const auto wanted = std::make_unique<Peel>(random);
            const auto found = std::make_unique<Peel>(*wanted);
            run_scalar(*wanted);
            run_chosen(*found);
            wrong += same(*wanted, *found) ? 0 : 1;
        }
        INFO("instruction set " << static_cast<int>(simd));
        CHECK(wrong == 0);
    }
}

TEST_CASE("the average of n fragments has the coverage of the n fragments on every instruction set") {
    testing::Random random{79};
    auto sums = std::make_unique<ColorLanes>(), background = std::make_unique<ColorLanes>();
    auto found = std::make_unique<ColorLanes>();
    Lanes<float> n{};
    for (std::size_t i = 0; i < 256; ++i) {
        n[i] = static_cast<float>(i < 40 ? i : testing::random_int(random, 0, 300));
        for (std::size_t c = 0; c < 4; ++c) {
            (*sums)[c][i] = n[i] * testing::random_float(random, 0.0f, 1.0f);
            (*background)[c][i] = testing::random_channel(random);
        }
    }
    for (const Simd simd : available_simd()) {
        const SimdScope kernels{simd};
        resolve_average(*sums, n, *background, *found, 256);
        double worst = 0;
        for (std::size_t i = 0; i < 256; ++i)
            for (std::size_t c = 0; c < 3; ++c) {
                const double alpha = double{(*sums)[3][i]};
                const double through = n[i] > 0 ? std::pow(1.0 - alpha / double{n[i]}, double{n[i]}) : 1.0;
                const double own = alpha > 0 ? double{(*sums)[c][i]} / alpha * (1.0 - through) : 0.0;
                const double expected = own + double{(*background)[c][i]} * (alpha > 0 ? through : 1.0);
                worst = std::max(worst, std::fabs(double{(*found)[c][i]} - expected) / std::max(1.0, expected));
            }
        INFO("instruction set " << static_cast<int>(simd));
        CHECK(worst < 1e-4);  // rounding of binary32 in up to 300 factors
    }
}

TEST_CASE("a visible fragment between the peeled depths is near or far or between and one outside is none of them") {
    testing::Random random{78};
    int wrong = 0;
    for (int round = 0; round < 100; ++round) {
        const auto p = std::make_unique<Peel>(random);
        classify(p->in, p->min_max, p->opaque, p->place);
        for (std::size_t i = 0; i < lanes(p->in); ++i) {
            const double z = p->in.shader_z[i], near = -p->min_max[0][i], far = p->min_max[1][i];
            const bool is_in = z < std::bit_cast<float>(p->opaque[i]) && z >= near && z <= far;
            const char* const expected = !is_in ? "none" : z == near ? "near" : z == far ? "far" : "between";
            const std::string found = p->place.is_near[i] != 0      ? "near"
                                      : p->place.is_far[i] != 0     ? "far"
                                      : p->place.is_between[i] != 0 ? "between"
                                                                    : "none";
            wrong += found == expected ? 0 : 1;
        }
    }
    CHECK(wrong == 0);
}

TEST_CASE("every stored depth is read back from a float colour and greater codes have greater values", "[slow]") {
    using strata::rasterizer::DepthFormat;
    CHECK(wrong_codes(DepthFormat::d16, 1) == 0);
    CHECK(wrong_codes(DepthFormat::d24, 1) == 0);
    CHECK(wrong_codes(DepthFormat::d32f, 4099) == 0);
    CHECK(depth_as_float(0xffffffu, DepthFormat::d24) == 1.0f);
}

TEST_CASE("E8: a pixel whose fragments all have alpha 0 and one without any keep the background under the average") {
    ColorLanes sums{}, background{}, out{};
    Lanes<float> n{};
    n[0] = 3;  // three fragments without alpha; lane 1 has none
    for (std::size_t c = 0; c < 4; ++c) background[c][0] = background[c][1] = 0.25f;
    resolve_average(sums, n, background, out, 2);
    for (std::size_t c = 0; c < 3; ++c) CHECK((out[c][0] == 0.25f && out[c][1] == 0.25f));
}
