#include "tools/oracle/fragments/setting.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "pipeline/vertices/draw_list.h"
#include "tools/oracle/fragments/eye_point.h"

namespace strata::oracle::verdict {

std::string describe(const DrawingOrder& order) {
    std::string text;
    switch (order.instances) {
        case InstanceOrder::listed: text = "as submitted"; break;
        case InstanceOrder::listed_backwards: text = "as submitted, the last instance first"; break;
        case InstanceOrder::origin: text = "instances far first, by their origin"; break;
        case InstanceOrder::box: text = "instances far first, by the centre of their box"; break;
        case InstanceOrder::mean: text = "instances far first, by the mean of their vertices"; break;
        case InstanceOrder::box_by_distance: text = "instances far first, by the distance of their box's centre"; break;
        case InstanceOrder::box_near_first: text = "instances near first, by the centre of their box"; break;
    }
    if (order.faces == FaceOrder::back_first_in_instance) text += ", back faces of each instance first";
    if (order.faces == FaceOrder::back_first) text += ", all back faces first";
    if (order.faces == FaceOrder::front_first) text += ", all front faces first";
    return text;
}

namespace {

using Point = EyePoint;

struct Points {
    Point box{}, mean{};
};

Points points_of(const pipeline::Mesh& mesh) {
    Points points;
    if (mesh.positions.empty()) return points;
    for (int axis = 0; axis < 3; ++axis) {
        const auto a = static_cast<std::size_t>(axis);
        double low = mesh.positions[0][axis], high = low, sum = 0;
        for (const auto& p : mesh.positions) {
            low = std::min<double>(low, p[axis]);
            high = std::max<double>(high, p[axis]);
            sum += p[axis];
        }
        points.box[a] = (low + high) / 2;
        points.mean[a] = sum / static_cast<double>(mesh.positions.size());
    }
    return points;
}

// The rank of each key in ascending order; equal keys in the order of the list.
std::vector<std::uint32_t> ranks(const std::vector<double>& keys) {
    std::vector<std::uint32_t> order(keys.size()), rank(keys.size());
    std::iota(order.begin(), order.end(), 0u);
    std::ranges::stable_sort(order, {}, [&](std::uint32_t i) { return keys[i]; });
    for (std::uint32_t i = 0; i < order.size(); ++i) rank[order[i]] = i;
    return rank;
}

}  // namespace

Setting setting_of(const pipeline::DrawList& list, const pipeline::View& view, const Rgba& cleared) {
    Setting setting{.cleared = cleared};
    std::array<std::vector<double>, instance_order_count> keys;
    for (const pipeline::Instance& instance : list.instances) {
        const Points points = points_of(list.meshes[instance.mesh]);
        // The eye looks along -z, so the smallest z is the farthest.
        const auto eye = [&](const Point& p) { return transformed(view.view, transformed(instance.model, p)); };
        const Point origin = eye({}), box = eye(points.box), mean = eye(points.mean);
        const auto listed = static_cast<double>(keys[0].size());
        const double key_of[instance_order_count] = {
            listed, -listed, origin[2], box[2], mean[2], -std::hypot(box[0], box[1], box[2]), -box[2]};
        for (std::size_t i = 0; i < instance_order_count; ++i) keys[i].push_back(key_of[i]);
    }
    for (std::size_t i = 0; i < instance_order_count; ++i) setting.rank[i] = ranks(keys[i]);
    return setting;
}

void find_nearness(const pipeline::DrawList& list, const pipeline::View& view,
                   std::span<const std::uint32_t> instance_of, Setting& setting) {
    std::size_t first = 0;  // index of the instance's first triangle
    for (std::size_t t = 0; t < instance_of.size(); ++t) {
        if (t == 0 || instance_of[t] != instance_of[t - 1]) first = t;
        const pipeline::Instance& instance = list.instances[instance_of[t]];
        const pipeline::Mesh& mesh = list.meshes[instance.mesh];
        double sum = 0, window = 0, nearest = -HUGE_VAL, farthest = HUGE_VAL;
        for (std::size_t corner = 0; corner < 3; ++corner) {
            const auto& p = mesh.positions[mesh.indices[3 * (t - first) + corner]];
            const Point eye = transformed(view.view, transformed(instance.model, {p[0], p[1], p[2]}));
            const auto& m = view.projection;
            const double z = m[0][2] * eye[0] + m[1][2] * eye[1] + m[2][2] * eye[2] + m[3][2];
            const double w = m[0][3] * eye[0] + m[1][3] * eye[1] + m[2][3] * eye[2] + m[3][3];
            sum += eye[2];
            window -= z / w;
            nearest = std::max(nearest, eye[2]);
            farthest = std::min(farthest, eye[2]);
        }
        const double of_point[triangle_point_count] = {sum / 3, window / 3, nearest, farthest};
        for (std::size_t i = 0; i < triangle_point_count; ++i)
            setting.nearness[i].push_back(static_cast<float>(of_point[i]));
    }
}

}  // namespace strata::oracle::verdict
