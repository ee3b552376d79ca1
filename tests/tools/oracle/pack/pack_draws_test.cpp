// Tests the vertices of a pack: clip coordinates against matrix products in long double, window positions against the
// viewport's formula, facing against areas in integers.
#include <bit>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>

#include "scenes/camera.h"
#include "scenes/scene.h"
#include "tools/oracle/pack/draw_json.h"

using namespace strata;
using namespace strata::oracle;

namespace {

std::map<std::string, scenes::NumberArray> arrays_of(const peeling::FrameRequest& input,
                                                     nlohmann::ordered_json& draws) {
    std::map<std::string, scenes::NumberArray> arrays;
    scenes::PackFiles files{
        [&](const std::string& name, const std::string& bytes) { arrays[name] = scenes::parse_npy(bytes, name); }};
    draws = draws_json(input, files);
    return arrays;
}

float real_at(const scenes::NumberArray& array, std::size_t i) { return std::bit_cast<float>(array.word(i)); }
std::int32_t signed_at(const scenes::NumberArray& array, std::size_t i) {
    return std::bit_cast<std::int32_t>(array.word(i));
}

}  // namespace

TEST_CASE(
    "the vertices of a pack are the scene's in clip space and its corners those in the window within half a step") {
    for (const char* name : {"teapot:tessellation=2", "shadow-demo", "volume-beam:slices=2"}) {
        INFO(name);
        const scenes::Scene scene = scenes::load_scene(name, {});
        peeling::RenderOptions options;
        options.width = 48;
        options.height = 32;
        options.threads = 1;
        const pipeline::View view = scenes::orbit_view(scene.bounds, 40, 15, 1.5);
        nlohmann::ordered_json draws;
        const auto arrays = arrays_of({scene.list, view, *pipeline::find_profile("geforce8"), options}, draws);
        std::size_t far_off = 0, unlike = 0, turned = 0, triangles_of_all = 0;
        for (const auto& draw : draws) {
            const auto array = [&](const char* key) -> const scenes::NumberArray& {
                return arrays.at(draw[key].get<std::string>());
            };
            const auto& clip = array("clip");
            const auto& corners = array("corners");
            const auto& triangles = array("triangles");
            // Every corner of every triangle is from the instance's own mesh, in order.
            std::size_t triangle = 0;
            for (std::size_t o = 0; o < scene.list.instances.size(); ++o) {
                const pipeline::Instance& instance = scene.list.instances[o];
                const bool is_blend = scene.list.materials[instance.material].alpha_mode == pipeline::AlphaMode::blend;
                if (is_blend != (draw["list"] == "transparent")) continue;
                const pipeline::Mesh& mesh = scene.list.meshes[instance.mesh];
                for (std::size_t i = 0; i < mesh.indices.size(); ++i, triangle += i % 3 == 0 ? 1 : 0) {
                    const Vec3& p = mesh.positions[mesh.indices[i]];
                    long double point[4] = {p[0], p[1], p[2], 1};
                    for (const pipeline::Matrix* m : {&instance.model, &view.view, &view.projection}) {
                        long double next[4] = {};
                        for (int row = 0; row < 4; ++row)
                            for (int column = 0; column < 4; ++column)
                                next[row] += static_cast<long double>((*m)[column][row]) * point[column];
                        std::copy_n(next, 4, point);
                    }
                    const std::size_t vertex = triangles.word(i + 3 * (triangle - i / 3));
                    for (std::size_t c = 0; c < 4; ++c)
                        far_off += std::fabs(real_at(clip, 4 * vertex + c) - point[c]) > 1e-5L * 20 ? 1 : 0;
                    unlike +=
                        array("objects").word(triangle) != o || array("materials").word(triangle) != instance.material;
                }
            }
            triangles_of_all += triangle;
            CHECK(triangle == triangles.shape[0]);
            // The viewport: x = (x / w + 1) / 2 * width, y down.
            for (std::size_t v = 0; v < clip.shape[0]; ++v) {
                const double w = real_at(clip, 4 * v + 3);
                const double x = (real_at(clip, 4 * v) / w + 1) / 2 * 48 * 256,
                             y = (1 - real_at(clip, 4 * v + 1) / w) / 2 * 32 * 256;
                far_off += std::fabs(signed_at(corners, 2 * v) - x) > 0.51 ? 1 : 0;
                far_off += std::fabs(signed_at(corners, 2 * v + 1) - y) > 0.51 ? 1 : 0;
            }
            const auto& window = array("window_triangles");
            for (std::size_t t = 0; t < window.shape[0]; ++t) {
                std::int64_t x[3], y[3];
                for (std::size_t k = 0; k < 3; ++k) {
                    x[k] = signed_at(corners, 2 * window.word(3 * t + k));
                    y[k] = signed_at(corners, 2 * window.word(3 * t + k) + 1);
                }
                // Counter-clockwise with y up is a negative area with y down.
                const std::int64_t area = (x[1] - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (y[1] - y[0]);
                const std::size_t source = array("window_sources").word(t);
                const bool is_mirrored = (array("flags").word(source) & 2u) != 0;
                turned += ((area < 0) != is_mirrored) != (array("window_facing").word(t) == 1) ? 1 : 0;
            }
        }
        CHECK(triangles_of_all > 0);
        CHECK(far_off == 0);
        CHECK(unlike == 0);
        CHECK(turned == 0);
    }
}

TEST_CASE("an order lists every triangle once where an algorithm sorts") {
    const scenes::Scene scene = scenes::load_scene("planes:count=4,cells=1", {});
    peeling::RenderOptions options;
    const pipeline::View view = scenes::orbit_view(scene.bounds, 0, 0, 1);
    const peeling::FrameRequest input{scene.list, view, *pipeline::find_profile("ideal"), options};
    CHECK(submission_of(input, peeling::ListOrder::given).empty());
    auto order = submission_of(input, peeling::ListOrder::back_to_front);
    std::size_t triangles = 0;
    for (const pipeline::Instance& instance : scene.list.instances)
        triangles += scene.list.meshes[instance.mesh].indices.size() / 3;
    REQUIRE(order.size() == triangles);
    std::ranges::sort(order);
    for (std::uint32_t i = 0; i < order.size(); ++i) CHECK(order[i] == i);
}
