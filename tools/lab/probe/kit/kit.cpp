// tools/lab/probe/kit/kit.cpp - the kit as JSON, with its digest (kit.h): `strata probe` writes it for a device to
// draw. Any change of an item changes the digest, and answers to an earlier kit are then refused.
#include "tools/lab/probe/kit/kit.h"

#include <fmt/format.h>

#include <bit>
#include <nlohmann/json.hpp>

#include "rasterizer/base/enum_values.h"
#include "scenes/packs/pack_files.h"

namespace strata::probe {

namespace {

using nlohmann::ordered_json;

void append(std::string& text, float value) { text += fmt::format("{:08x}", std::bit_cast<std::uint32_t>(value)); }

// Position, then colour: 64 digits per corner.
std::string corners_text(const std::vector<ClipVertex>& corners) {
    std::string text;
    text.reserve(corners.size() * 64);
    for (const ClipVertex& v : corners) {
        for (const float f : {v.x, v.y, v.z, v.w}) append(text, f);
        for (const float f : v.front) append(text, f);
    }
    return text;
}

ordered_json bits(std::initializer_list<float> values) {
    std::string text;
    for (const float value : values) append(text, value);
    return text;
}

ordered_json draw_json(const Draw& draw) {
    ordered_json json;
    json["blend"] = nullptr;
    if (draw.blend)
        json["blend"] = {enum_name(draw.blend->equation), enum_name(draw.blend->src), enum_name(draw.blend->dst)};
    json["polygon_offset"] = nullptr;
    if (draw.offset.enabled) json["polygon_offset"] = bits({draw.offset.factor, draw.offset.units});
    json["alpha_above"] = nullptr;
    if (draw.alpha_above) json["alpha_above"] = bits({*draw.alpha_above});
    json["corners"] = corners_text(draw.corners);
    return json;
}

ordered_json item_json(const Item& item) {
    ordered_json json;
    json["name"] = item.name;
    json["decides"] = item.decides;
    json["size"] = {item.width, item.height};
    json["color"] = pipeline::info(item.color).name;
    json["depth"] = nullptr;
    if (item.depth) json["depth"] = pipeline::info(pipeline::target_format(*item.depth)).name;
    json["depth_range"] = bits({item.depth_near, item.depth_far});
    json["clear"] = bits({item.clear[0], item.clear[1], item.clear[2], item.clear[3]});
    for (const Draw& draw : item.draws) json["draws"].push_back(draw_json(draw));
    return json;
}

ordered_json items_json(const std::vector<Item>& items) {
    ordered_json json = ordered_json::array();
    for (const Item& item : items) json.push_back(item_json(item));
    return json;
}

}  // namespace

const std::vector<Item>& kit() {
    static const std::vector<Item> items = [] {
        std::vector<Item> all;
        add_coverage(all);
        add_orientation(all);
        add_positions(all);
        add_depth(all);
        add_clip(all);
        add_colors(all);
        add_blending(all);
        return all;
    }();
    return items;
}

std::string to_json(const std::vector<Item>& items) {
    const ordered_json document{
        {"format", "strata-kit"}, {"version", 1}, {"digest", digest(items)}, {"items", items_json(items)}};
    return document.dump(1) + "\n";
}

std::string digest(const std::vector<Item>& items) { return scenes::digest_of_bytes(items_json(items).dump()); }

}  // namespace strata::probe
