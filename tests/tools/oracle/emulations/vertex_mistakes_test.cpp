// Tests the mistakes of vertices. The expected colours of one triangle are computed in binary64, linear over its window
// positions, or are the bits of its last corner; the expected positions are those of another viewport.
#include <bit>
#include <catch2/catch.hpp>
#include <cmath>

#include "peeling/registry.h"
#include "peeling/render.h"
#include "tools/oracle/emulations/catalogue.h"
#include "tools/oracle/emulations/mistake_renderer.h"

using namespace strata;
using namespace strata::oracle;

namespace {

constexpr int side_px = 32;

// One triangle with a transparent material and alpha 1, with corners at w = 1, 2 and 4, drawn without a background.
struct OneTriangle {
    pipeline::DrawList list;
    pipeline::View view;
    pipeline::DeviceProfile profile;
    peeling::RenderOptions options;
    std::array<std::array<double, 2>, 3> window{};  // pixels, y down

    explicit OneTriangle(const char* profile_name) : profile{*pipeline::find_profile(profile_name)} {
        const std::array<float, 3> w{1, 2, 4};
        const std::array<std::array<float, 2>, 3> ndc{{{-0.75f, -0.625f}, {0.875f, -0.5f}, {-0.125f, 0.8125f}}};
        pipeline::Mesh mesh;
        for (std::size_t i = 0; i < 3; ++i) {
            mesh.positions.push_back({ndc[i][0] * w[i], ndc[i][1] * w[i], -w[i]});  // the products are exact
            window[i] = {(ndc[i][0] + 1) * side_px / 2, (1 - ndc[i][1]) * side_px / 2};
        }
        mesh.colors = {{0.1f, 0.7f, 0.2f, 1}, {0.6f, 0.1f, 0.9f, 1}, {0.3f, 0.5f, 0.45f, 1}};
        mesh.indices = {0, 1, 2};
        list.meshes = {mesh};
        list.materials.resize(1);
        list.materials[0].alpha_mode = pipeline::AlphaMode::blend;
        list.materials[0].double_sided = list.materials[0].unlit = true;
        list.instances.resize(1);
        view.projection = {};  // clip w is -z of the eye, clip z half of that
        view.projection[0][0] = view.projection[1][1] = 1;
        view.projection[2][2] = -0.5;
        view.projection[2][3] = -1;
        view.projection[3][3] = 0;
        options.width = options.height = side_px;
        options.threads = 1;
        options.color_format = pipeline::Format::rgba32f;
    }
    [[nodiscard]] Picture with(const char* mistake) const {
        const MistakeRenderer mistake_renderer{{list, view, profile, options},
                                               *peeling::find_algorithm("front_to_back")};
        return mistake == nullptr ? mistake_renderer.right() : mistake_renderer.with(*find_mistake(mistake)).value();
    }
    // Expected colour at a pixel's centre, linear over the window.
    [[nodiscard]] double linear(std::size_t channel, int x, int y) const {
        const auto& [a, b, c] = window;
        const double px = x + 0.5, py = y + 0.5;
        const auto twice = [](const auto& p, const auto& q, double rx, double ry) {
            return (q[0] - p[0]) * (ry - p[1]) - (q[1] - p[1]) * (rx - p[0]);
        };
        const double area = twice(a, b, c[0], c[1]);
        const double at_c = twice(a, b, px, py) / area, at_a = twice(b, c, px, py) / area;
        const auto& colors = list.meshes[0].colors;
        return at_a * colors[0][channel] + at_c * colors[2][channel] + (1 - at_a - at_c) * colors[1][channel];
    }
};

float channel_of(const Picture& picture, int x, int y, std::size_t channel) {
    return std::bit_cast<float>(picture.targets[0].at(static_cast<std::size_t>(y * side_px + x), int(channel)).word);
}

// Calls body for each pixel that the triangle covers, which is not black; returns their number.
template <class Body>
int for_covered(const Picture& picture, Body body) {
    int covered = 0;
    for (int y = 0; y < side_px; ++y)
        for (int x = 0; x < side_px; ++x) {
            const bool is_black = channel_of(picture, x, y, 0) == 0 && channel_of(picture, x, y, 1) == 0;
            if (is_black) continue;
            ++covered;
            body(x, y);
        }
    return covered;
}

}  // namespace

TEST_CASE("a flat colour has the exact bits of the last corner in perspective as well") {
    for (const char* profile : {"geforce8", "llvmpipe", "ideal"}) {
        const OneTriangle scene{profile};
        const Picture flat = scene.with("colors_flat");
        int wrong = 0;
        const int covered = for_covered(flat, [&](int x, int y) {
            for (std::size_t c = 0; c < 3; ++c)
                wrong += channel_of(flat, x, y, c) != scene.list.meshes[0].colors[2][c] ? 1 : 0;
        });
        INFO(profile);
        CHECK(covered > 200);
        CHECK(wrong == 0);
    }
}

TEST_CASE("colours without perspective are linear over the window and depths are unchanged") {
    for (const char* profile : {"geforce8", "llvmpipe", "ideal"}) {
        const OneTriangle scene{profile};
        const Picture affine = scene.with("colors_affine"), right = scene.with(nullptr);
        double worst = 0, right_worst = 0;
        const int covered = for_covered(affine, [&](int x, int y) {
            for (std::size_t c = 0; c < 3; ++c) {
                worst = std::max(worst, std::abs(channel_of(affine, x, y, c) - scene.linear(c, x, y)));
                right_worst = std::max(right_worst, std::abs(channel_of(right, x, y, c) - scene.linear(c, x, y)));
            }
        });
        INFO(profile);
        CHECK(covered == for_covered(right, [](int, int) {}));
        CHECK(worst < 0x1p-18);  // corners are exact on the grid of every profile, so only binary32 rounds
        CHECK(right_worst > 0.05);
    }
}

TEST_CASE("two half-pixel offsets move the picture by one pixel") {
    const OneTriangle scene{"geforce8"};
    const MistakeRenderer mistake_renderer{{scene.list, scene.view, scene.profile, scene.options},
                                           *peeling::find_algorithm("front_to_back")};
    const Mistake* const half = find_mistake("half_pixel_right");
    const Mistake* const twice[] = {half, half};
    const Picture moved = mistake_renderer.with(twice).value(), right = mistake_renderer.right();
    int coverage = 0;
    for (int y = 1; y < side_px; ++y)
        for (int x = 1; x < side_px; ++x)
            coverage += (channel_of(moved, x, y, 0) != 0) != (channel_of(right, x - 1, y - 1, 0) != 0) ? 1 : 0;
    CHECK(coverage == 0);
}
