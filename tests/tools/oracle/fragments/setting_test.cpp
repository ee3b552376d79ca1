// Tests the drawing orders on two instances whose centres are worked out by hand.
#include "tools/oracle/fragments/setting.h"

#include <catch2/catch.hpp>

#include "pipeline/vertices/draw_list.h"

using namespace strata;
using namespace strata::oracle::verdict;

namespace {

// A long triangle along x and -z, whose origin, box centre and mean of vertices have different depths.
pipeline::Mesh triangle(float first_z, float second_z, float third_z) {
    pipeline::Mesh mesh;
    mesh.positions = {{0, 0, first_z}, {1, 0, second_z}, {0, 1, third_z}};
    mesh.indices = {0, 1, 2};
    return mesh;
}

using Ranks = std::vector<std::uint32_t>;

const Ranks& rank(const Setting& setting, InstanceOrder order) { return setting.rank[static_cast<std::size_t>(order)]; }

}  // namespace

TEST_CASE("the number of a drawing order determines how instances and faces are ordered") {
    for (std::uint32_t i = 0; i < instance_order_count; ++i)
        for (std::uint32_t f = 0; f < face_order_count; ++f) {
            const DrawingOrder order = drawing_order(i * face_order_count + f);
            CHECK(order.instances == static_cast<InstanceOrder>(i));
            CHECK(order.faces == static_cast<FaceOrder>(f));
        }
    CHECK(describe(drawing_order(0)) != describe(drawing_order(1)));
}

TEST_CASE("instances are ranked by the depth of their origin or of their box centre or of the mean of their vertices") {
    pipeline::DrawList list;
    // Box centres are at -5 and -4.5, means at -11/3 and -17/3, all origins at 0.
    list.meshes = {triangle(-1, -1, -9), triangle(-1, -8, -8)};
    list.materials.resize(1);
    list.instances = {{.mesh = 0, .material = 0}, {.mesh = 1, .material = 0}};
    const Setting setting = setting_of(list, {}, {0, 0, 0, 1});
    CHECK(rank(setting, InstanceOrder::listed) == Ranks{0, 1});
    CHECK(rank(setting, InstanceOrder::listed_backwards) == Ranks{1, 0});
    CHECK(rank(setting, InstanceOrder::origin) == Ranks{0, 1});  // equal depths: in list order
    CHECK(rank(setting, InstanceOrder::box) == Ranks{0, 1});     // the first is farther and is drawn first
    CHECK(rank(setting, InstanceOrder::mean) == Ranks{1, 0});
    CHECK(rank(setting, InstanceOrder::box_near_first) == Ranks{1, 0});
}

TEST_CASE("the depth of an instance depends on its model matrix and on the camera") {
    pipeline::DrawList list;
    list.meshes = {triangle(0, 0, 0)};
    list.materials.resize(1);
    list.instances = {{.mesh = 0, .material = 0}, {.mesh = 0, .material = 0}};
    list.instances[0].model[3][2] = -2;
    list.instances[1].model[3][2] = -3;
    CHECK(rank(setting_of(list, {}, {}), InstanceOrder::origin) == Ranks{1, 0});
    pipeline::View behind;  // rotated, so the far instance is near
    behind.view[2][2] = behind.view[0][0] = -1;
    behind.view[3][2] = -10;
    CHECK(rank(setting_of(list, behind, {}), InstanceOrder::origin) == Ranks{0, 1});
}
