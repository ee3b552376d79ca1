// tools/oracle/fragments/setting.h - data of a scene that is the same for all pixels: the orders in which a port may
// draw its instances and triangles.
//
// Rule     Engines sort instances by the depth of some point of each, far first, and draw back faces before front
//          faces, per instance or in the whole scene, or front faces first by mistake. A drawing order is a number: 4
//          times InstanceOrder plus FaceOrder.
// Tests    tests/tools/oracle/fragments/setting_test.cpp
#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "rasterizer/base/vector.h"
#include "tools/oracle/fragments/work.h"

namespace strata::pipeline {
struct DrawList;
struct View;
}  // namespace strata::pipeline

namespace strata::oracle::verdict {

enum class InstanceOrder : std::uint8_t {
    listed,
    listed_backwards,
    origin,           // by depth of its origin
    box,              // by depth of its bounding box's centre
    mean,             // by depth of the mean of its vertices
    box_by_distance,  // by distance of the box's centre from the eye
    box_near_first
};
inline constexpr std::uint32_t instance_order_count = 7;
enum class FaceOrder : std::uint8_t { listed, back_first_in_instance, back_first, front_first };
inline constexpr std::uint32_t face_order_count = 4;

struct DrawingOrder {
    InstanceOrder instances = InstanceOrder::listed;
    FaceOrder faces = FaceOrder::listed;
};
[[nodiscard]] constexpr DrawingOrder drawing_order(std::uint32_t number) noexcept {
    return {static_cast<InstanceOrder>(number / face_order_count), static_cast<FaceOrder>(number % face_order_count)};
}
[[nodiscard]] std::string describe(const DrawingOrder& order);

// The depth by which a triangle may be sorted.
enum class TrianglePoint : std::uint8_t { mean, window_mean, nearest, farthest };
inline constexpr std::uint32_t triangle_point_count = 4;

// What the numbers of a picture are: values of the frame; those of a linear frame, encoded for sRGB when it was saved;
// codes of an sRGB target, which decodes and encodes at every blend.
enum class ColorStorage : std::uint8_t { as_they_are, encoded, srgb_target };

struct Setting {
    ColorStorage stored = ColorStorage::as_they_are;
    Rgba cleared{0, 0, 0, 1};               // the colour where nothing is drawn
    std::optional<Rgba> seen_background{};  // the candidate's colour there, if it is a single other colour
    // By InstanceOrder, then by instance: its rank in drawing order. Empty: as listed.
    std::array<std::vector<std::uint32_t>, instance_order_count> rank{};
    // By TrianglePoint, then by submission index: a number that is larger for nearer triangles. Empty: not known.
    std::array<std::vector<float>, triangle_point_count> nearness{};
    std::shared_ptr<WorkCounter> work = std::make_shared<WorkCounter>();  // the steps of the search on this scene
};

// Sets `nearness` for the drawn triangles; `instance_of`: the instance of each triangle in submission order.
void find_nearness(const pipeline::DrawList& list, const pipeline::View& view,
                   std::span<const std::uint32_t> instance_of, Setting& setting);
[[nodiscard]] Setting setting_of(const pipeline::DrawList& list, const pipeline::View& view, const Rgba& cleared);

}  // namespace strata::oracle::verdict
