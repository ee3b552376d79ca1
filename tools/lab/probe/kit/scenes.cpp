// tools/lab/probe/kit/scenes.cpp - scenes that are not designed for any field: random triangles and models through a
// camera, clipped at every plane of the view volume, in frames of many sizes and formats.
#include <fmt/format.h>

#include "pipeline/vertices/prepare.h"
#include "scenes/camera.h"
#include "scenes/scene.h"
#include "tools/lab/probe/kit/kit.h"
#include "tools/lab/probe/kit/random_generator.h"

namespace strata::probe {

namespace {

using pipeline::Format;

// Two of three are random triangles.
std::string scene_name(int number) {
    if (number % 3 != 2) return fmt::format("random:seed={},triangles={}", 1000 + number, 80 + number % 7 * 40);
    return number % 2 == 0 ? "teapot" : "planes:count=5";
}

// From inside and outside the bounds, so that all planes clip.
pipeline::View view_of(const scenes::Scene& scene, RandomGenerator& random, double aspect) {
    const auto azimuth = double{random.between(0, 360)};
    const auto elevation = double{random.between(-80, 80)};
    scenes::LookAt camera = scenes::orbit_camera(scene.bounds, azimuth, elevation);
    const auto nearer = double{random.between(0.3f, 1.1f)};
    for (std::size_t i = 0; i < 3; ++i) camera.eye[i] = camera.center[i] + (camera.eye[i] - camera.center[i]) * nearer;
    return scenes::look_at(camera, aspect);
}

}  // namespace

Item unseen_scene(int number) {
    RandomGenerator random{static_cast<std::uint64_t>(number) + 9000};
    constexpr Format colors[]{Format::rgba8, Format::rgba32f, Format::rgba16f};
    constexpr DepthFormat depths[]{DepthFormat::d24, DepthFormat::d32f, DepthFormat::d16};
    Item item{.name = fmt::format("unseen.{:03}", number), .color = colors[number % 3]};
    item.depth = depths[number / 3 % 3];
    item.width = 40 + random.below(60);
    item.height = 40 + random.below(60);
    const scenes::Scene scene = scenes::make_procedural(scene_name(number), {});
    const pipeline::View view = view_of(scene, random, static_cast<double>(item.width) / item.height);
    const rasterizer::TriangleSoup soup = pipeline::transform(scene.list, view, {.alpha_scale = 0.625f, .threads = 1});
    Draw draw;
    draw.blend = pipeline::blend_mode::over.color;
    for (const std::uint32_t index : soup.indices) {
        draw.corners.push_back(soup.vertices[index]);
        draw.corners.back().back = draw.corners.back().front;
    }
    item.draws = {draw};
    return item;
}

std::vector<Item> unseen_scenes(int first, int count) {
    std::vector<Item> items;
    for (int i = 0; i < count; ++i) items.push_back(unseen_scene(first + i));
    return items;
}

}  // namespace strata::probe
