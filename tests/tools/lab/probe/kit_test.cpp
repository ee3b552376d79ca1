// Tests the scenes of the kit: bits written as hexadecimal digits, and requirements on every scene.
#include "tools/lab/probe/kit/kit.h"

#include <algorithm>
#include <bit>
#include <catch2/catch.hpp>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "tools/lab/probe/kit/draw_item.h"
#include "tools/lab/probe/kit/shapes.h"
#include "tools/lab/probe/kit/split_depths.h"
#include "tools/lab/probe/kit/split_weights.h"
#include "tools/lab/probe/search/comparison.h"
#include "tools/lab/probe/search/fields.h"

using namespace strata;
using namespace strata::probe;

TEST_CASE("every probed field is decided by a scene of the kit and every decided key is a field") {
    std::set<std::string> decided;
    for (const Item& item : kit())
        for (const std::string& key : item.decides) {
            CHECK(field(key).key == key);
            decided.insert(key);
        }
    for (const ProfileField* f : probed_fields()) {
        INFO(f->key);
        CHECK(decided.contains(std::string{f->key}));
    }
}

TEST_CASE("every probed field belongs to a group except the guard band which has its own search") {
    std::set<std::string_view> grouped{"raster.guard_band_px"};
    for (const FieldGroup& group : field_groups()) {
        grouped.insert(group.joint.begin(), group.joint.end());
        grouped.insert(group.refined.begin(), group.refined.end());
    }
    for (const ProfileField* f : probed_fields()) {
        INFO(f->key);
        CHECK(grouped.contains(f->key));
    }
}

TEST_CASE("scenes of the kit have unique names and whole triangles and sides of 8 to 512 pixels") {
    std::set<std::string> names;
    for (const Item& item : kit()) {
        INFO(item.name);
        CHECK(names.insert(item.name).second);
        CHECK(std::min(item.width, item.height) >= 8);
        CHECK(std::max(item.width, item.height) <= 512);
        for (const Draw& draw : item.draws) {
            CHECK(!draw.corners.empty());
            CHECK(draw.corners.size() % 3 == 0);
        }
    }
}

TEST_CASE("the digest of a kit changes with a name or a side or a corner of a scene and with a scene less") {
    const std::vector<Item> all = kit();
    const std::string before = digest(all);
    CHECK(before == digest(kit()));
    std::set<std::string> digests{before};
    const auto change = [&](auto&& alter) {
        std::vector<Item> items = all;
        alter(items);
        CHECK(digests.insert(digest(items)).second);
    };
    change([](auto& items) { items.back().name += "2"; });
    change([](auto& items) { ++items.back().width; });
    change([](auto& items) { items.pop_back(); });
    change([](auto& items) { std::swap(items[0], items[1]); });
    change([](auto& items) { items[0].draws[0].corners.pop_back(); });
}

TEST_CASE("the JSON of a kit has the bits of every corner in the order of the vertex attributes") {
    const nlohmann::json document = nlohmann::json::parse(to_json(kit()));
    REQUIRE(document["items"].size() == kit().size());
    int wrong = 0;
    for (std::size_t i = 0; i < kit().size(); ++i)
        for (std::size_t d = 0; d < kit()[i].draws.size(); ++d) {
            const std::string digits = document["items"][i]["draws"][d]["corners"];
            const std::vector<ClipVertex>& corners = kit()[i].draws[d].corners;
            REQUIRE(digits.size() == corners.size() * 64);
            for (std::size_t c = 0; c < corners.size(); ++c) {
                const ClipVertex& v = corners[c];
                const float values[]{v.x, v.y, v.z, v.w, v.front[0], v.front[1], v.front[2], v.front[3]};
                for (std::size_t k = 0; k < 8; ++k) {
                    const auto bits = std::stoul(digits.substr((c * 8 + k) * 8, 8), nullptr, 16);
                    if (bits != std::bit_cast<std::uint32_t>(values[k])) ++wrong;
                }
            }
        }
    CHECK(wrong == 0);
}

TEST_CASE("a scene that is turned upside down has the same rows in reverse order except for ties") {
    const DeviceProfile& device = *pipeline::find_profile("ideal");
    Item item{.name = "box", .width = 16, .height = 8};
    Draw draw;
    add_box(item, draw, 2.25f, 1.25f, 9.75f, 5.75f, white);
    item.draws = {draw};
    const pipeline::Image down = draw_item(device, item, YDirection::down).answer->color;
    const pipeline::Image up = draw_item(device, item, YDirection::up).answer->color;
    for (int y = 0; y < item.height; ++y)
        for (int x = 0; x < item.width; ++x) {
            // The centres of rows 1 to 5 and columns 2 to 9 are inside.
            const bool inside = x >= 2 && x <= 9 && y >= 1 && y <= 5;
            CHECK((down.codes[down.index(x, y)] == 255) == inside);
            CHECK(up.codes[up.index(x, item.height - 1 - y)] == down.codes[down.index(x, y)]);
        }
}

TEST_CASE("a device rejects what it lacks with an error message") {
    const DeviceProfile& device = *pipeline::find_profile("geforce3");
    Item item{.name = "float", .color = pipeline::Format::rgba32f};
    CHECK(draw_item(device, item, YDirection::up).refusal.starts_with("profile geforce3 has no float render targets"));
    item.color = pipeline::Format::rgba8;
    item.depth = DepthFormat::d32f;
    CHECK(draw_item(device, item, YDirection::up).refusal.starts_with("profile geforce3 has no float depth buffers"));
}

TEST_CASE("a triangle that distinguishes two reciprocals has a weight within a relative 2^-22 of a multiple of 1/256") {
    RandomGenerator random{1};
    int found = 0, wrong = 0;
    for (int i = 0; i < 200; ++i) {
        const std::optional<SplitTriangle> t = split_triangle(random);
        if (!t) continue;
        ++found;
        // Twice the areas of the three triangles with the centre of pixel (3, 3), divided by w, in binary64: the
        // relative error is at most 2^-50.
        double part[3], sum = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t a = (k + 1) % 3, b = (k + 2) % 3;
            const double ax = t->x[a] - 56, ay = t->y[a] - 56, bx = t->x[b] - 56, by = t->y[b] - 56;
            part[k] = std::abs(ax * by - ay * bx) / double{t->w[k]};
            sum += part[k];
        }
        const bool is_near = std::ranges::any_of(part, [&](double each) {
            const double share = 256 * each / sum;
            return std::abs(share - std::round(share)) < share * 0x1p-22;
        });
        wrong += is_near ? 0 : 1;
    }
    CHECK(found > 50);
    CHECK(wrong == 0);
}

TEST_CASE("the kit distinguishes a reciprocal of 24 to 27 bits from one with a bit more") {
    const Item& item = *std::ranges::find(kit(), "color.split-weights", &Item::name);
    for (const YDirection y : {YDirection::up, YDirection::down})
        for (int bits = 24; bits < 28; ++bits) {
            DeviceProfile fewer = *pipeline::find_profile("geforce3"), more = fewer;
            fewer.raster.hypothesis.reciprocal_bits = bits;
            more.raster.hypothesis.reciprocal_bits = bits + 1;
            INFO(bits);
            CHECK(difference(*draw_item(fewer, item, y).answer, *draw_item(more, item, y).answer).color > 0);
        }
}

TEST_CASE("the kit distinguishes a reciprocal of 24 to 30 bits from one with a deficit greater by 2^-32 by depths") {
    const Item& item = *std::ranges::find(kit(), "depth.split-reciprocals", &Item::name);
    for (const YDirection y : {YDirection::up, YDirection::down})
        for (const TwoReciprocals& two : neighbouring_reciprocals()) {
            DeviceProfile one = *pipeline::find_profile("geforce3"), other = one;
            one.raster.hypothesis = two.first;
            other.raster.hypothesis = two.second;
            INFO(two.first.reciprocal_bits << " bits, deficit " << two.first.reciprocal_deficit);
            CHECK(difference(*draw_item(one, item, y).answer, *draw_item(other, item, y).answer).depth > 0);
        }
}

// Vertex colours of 8 bits hide the rounding to codes and halves, and no plane reaches beyond the depth range if
// polygons are clipped at its ends.
TEST_CASE("clear values and polygon offset show roundings and depth limits that vertices cannot") {
    DeviceProfile device = *pipeline::find_profile("direct3d11");
    device.raster.plane_rule = rasterizer::PlaneRule::exact;
    device.raster.color = rasterizer::ColorInterpolation::weights_8bit;
    device.raster.interpolation.vertex_color_bits = 8;
    const auto names_of_same = [&](std::string_view key, const std::vector<std::string>& names) {
        std::vector<std::string> same;
        const ProfileField& f = field(key);
        for (const std::string& name : names) {
            const Item& item = *std::ranges::find(kit(), name, &Item::name);
            for (int value = f.lowest; value <= f.highest; value += f.step) {
                DeviceProfile other = device;
                f.set(other, value);
                if (f.value(other) == f.value(device) || !is_valid(other)) continue;
                const Reply a = draw_item(device, item, YDirection::up), b = draw_item(other, item, YDirection::up);
                if (a.answer == b.answer) same.push_back(name + ' ' + pipeline::text_of(f, other));
            }
        }
        return same;
    };
    const std::vector<std::string> none;
    CHECK(names_of_same("unorm_rounding", {"color.clear", "color.clear-again"}) == none);
    CHECK(names_of_same("half_rounding", {"color.clear-halves"}) == none);
    CHECK(names_of_same("raster.depth_limits", {"offset.beyond-range-d24", "offset.beyond-range-d32f"}) == none);
    CHECK(names_of_same("raster.depth_rounding", {"depth.range-d24"}) == none);
}
