// tools/oracle/search/edits_report.cpp - the mistakes at one pixel (edits.h) as text and as JSON.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "pipeline/vertices/draw_list.h"
#include "tools/oracle/search/edits.h"

namespace strata::oracle::verdict {

namespace {

using nlohmann::ordered_json;

// A value in units of 1/255, as image viewers show it.
std::string parts(double v) { return fmt::format("{:.2f}", v * 255); }

std::string reach_text(const Interval& channel) {
    const std::string low = parts(channel.low), high = parts(channel.high);
    return low == high ? low : low + " to " + high;
}

std::string reach_text(const ReachableColor& reach) {
    return reach_text(reach[0]) + ", " + reach_text(reach[1]) + ", " + reach_text(reach[2]);
}

std::string fragment_text(const Fragment& f, const pipeline::DrawList& list) {
    const pipeline::Material& material = list.materials[f.material];
    return fmt::format("instance {}{}, triangle {}, {}, depth {:.9g}; {}, {}, {} of 255, alpha {:.4g}", f.instance,
                       material.name.empty() ? "" : " (" + material.name + ")", f.primitive,
                       f.is_front_facing ? "front-facing" : "back-facing", f.shader_z, parts(f.color[0]),
                       parts(f.color[1]), parts(f.color[2]), f.color[3]);
}

// "1, 3": numbers of layers as used in the text.
std::string numbers(const std::vector<std::size_t>& chosen) {
    if (chosen.empty()) return "none";
    std::string text;
    for (const std::size_t i : chosen) text += (text.empty() ? "" : ", ") + std::to_string(i + 1);
    return text;
}

std::string description_of(const PixelEdit& edit, const Verdict& v, const pipeline::DrawList& list) {
    if (!edit.rules.empty()) return description(edit.rules, v.facts, list);
    return "of its layers these alone are composited, near to far: " + numbers(edit.chosen);
}

}  // namespace

std::string to_text(const PixelEdits& p, const Verdict& v, const pipeline::DrawList& list) {
    const PixelList& pixel = p.pixel.list;
    const auto& value = p.pixel.value;
    std::string text = fmt::format("pixel {},{}: {}; the candidate has {}, {}, {} of 255\n", pixel.x, pixel.y,
                                   p.is_right ? "right" : "wrong", parts(value[0]), parts(value[1]), parts(value[2]));
    const auto add = [&](const std::string& line) { text += "  " + line + '\n'; };
    add("a right port has " + reach_text(p.right) + " with " + describe(p.hypothesis));
    if (p.alpha)
        add(fmt::format("alpha: a right port has {}; the candidate {}", reach_text(p.right[3]), parts(*p.alpha)));
    std::size_t number = 0;
    for (const Fragment& f : pixel.visible) add(fmt::format("layer {}: {}", ++number, fragment_text(f, list)));
    for (const Fragment& f : pixel.hidden) add("hidden: " + fragment_text(f, list));
    add(fmt::format("behind: {}, {}, {}, {}", parts(pixel.behind[0]), parts(pixel.behind[1]), parts(pixel.behind[2]),
                    pixel.has_opaque ? "an opaque surface" : "the background"));
    if (pixel.edge != nullptr) add("at an edge: another rasterizer may cover it otherwise");
    for (const PixelEdit& edit : p.edits)
        add(fmt::format("it comes out so if {} ({})", description_of(edit, v, list), reach_text(edit.reach)));
    if (!p.is_right && !p.has_wrong_alpha && p.edits.empty())
        add(p.surface.empty() ? "no mistake that is known here gives its value" : p.surface);
    return text;
}

std::string to_json(const PixelEdits& p, const Verdict& v, const pipeline::DrawList& list) {
    const auto reach_json = [](const ReachableColor& reach) {
        ordered_json all = ordered_json::array();
        for (std::size_t c = 0; c < 3; ++c) all.push_back({reach[c].low, reach[c].high});
        return all;
    };
    const auto fragment_json = [](const Fragment& f) {
        return ordered_json{{"instance", f.instance},  {"material", f.material},
                            {"triangle", f.primitive}, {"front_facing", f.is_front_facing},
                            {"depth", f.shader_z},     {"color", {f.color[0], f.color[1], f.color[2], f.color[3]}}};
    };
    const PixelList& pixel = p.pixel.list;
    ordered_json document{{"pixel", {pixel.x, pixel.y}},
                          {"verdict", p.is_right ? "right" : "wrong"},
                          {"candidate", {p.pixel.value[0], p.pixel.value[1], p.pixel.value[2]}},
                          {"right", reach_json(p.right)},
                          {"hypothesis", describe(p.hypothesis)},
                          {"layers", ordered_json::array()},
                          {"hidden", ordered_json::array()},
                          {"behind", {pixel.behind[0], pixel.behind[1], pixel.behind[2]}},
                          {"has_opaque", pixel.has_opaque},
                          {"at_edge", pixel.edge != nullptr},
                          {"edits", ordered_json::array()}};
    if (!p.surface.empty()) document["opaque_surface"] = p.surface;
    if (p.alpha) document["alpha"] = {{"candidate", *p.alpha}, {"right", {p.right[3].low, p.right[3].high}}};
    for (const Fragment& f : pixel.visible) document["layers"].push_back(fragment_json(f));
    for (const Fragment& f : pixel.hidden) document["hidden"].push_back(fragment_json(f));
    for (const PixelEdit& edit : p.edits) {
        ordered_json one{{"sentence", description_of(edit, v, list)},
                         {"kinds", ordered_json::array()},
                         {"value", reach_json(edit.reach)}};
        for (const Rule& rule : edit.rules) one["kinds"].push_back(name(rule.kind));
        if (edit.rules.empty()) one["layers"] = edit.chosen;
        document["edits"].push_back(std::move(one));
    }
    return document.dump(2) + '\n';
}

}  // namespace strata::oracle::verdict
