// tools/request/light_words.cpp - reads and writes lights and the lighting model (light_words.h).
#include "tools/request/light_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <span>

#include "rasterizer/base/enum_values.h"
#include "tools/request/parse.h"

namespace strata::tools {

namespace {

using pipeline::Light;
using pipeline::LightModel;
using pipeline::LightType;

std::optional<Vec3> to_channels(std::string_view text) {
    Vec3 color{};
    const auto parts = split(text, ':');
    if (parts.size() != 3) return std::nullopt;
    for (std::size_t c = 0; c < 3; ++c) {
        const auto value = to_number<float>(parts[c]);
        if (!value) return std::nullopt;
        color[c] = *value;
    }
    return color;
}

std::string joined(const Vec3& v, const char* between) { return fmt::format("{}", fmt::join(components(v), between)); }

// "name=value" in its two parts; the value of a word without = is empty.
struct NamedPart {
    std::string_view name, value;
};
NamedPart parts_of(std::string_view text) {
    const std::size_t is = text.find('=');
    if (is == std::string_view::npos) return {text, {}};
    return {text.substr(0, is), text.substr(is + 1)};
}

// Reads a colour into each of these; false if it is none.
bool set_color(std::string_view text, std::initializer_list<Vec3*> into) {
    const auto color = to_channels(text);
    for (Vec3* each : into)
        if (color) *each = *color;
    return color.has_value();
}

bool set_part(Light& light, std::string_view text) {
    const auto [name, value] = parts_of(text);
    if (name == "color") return set_color(value, {&light.diffuse, &light.specular});
    if (name == "diffuse") return set_color(value, {&light.diffuse});
    if (name == "specular") return set_color(value, {&light.specular});
    if (name == "ambient") return set_color(value, {&light.ambient});
    const auto range = to_number<float>(value);
    if (name != "range" || !range || light.type == LightType::directional) return false;
    light.range = *range;
    return true;
}

Vec3 three_from(std::span<const float> values) { return {values[0], values[1], values[2]}; }

bool set_numbers(Light& light, std::span<const float> n) {
    switch (light.type) {
        case LightType::directional:
            if (n.size() != 3) return false;
            light.direction = three_from(n);
            return true;
        case LightType::point:
            if (n.size() != 3 && n.size() != 6) return false;
            light.position = three_from(n);
            if (n.size() == 6) light.attenuation = three_from(n.subspan(3));
            return true;
        case LightType::spot: break;
    }
    if (n.size() != 7 && n.size() != 8 && n.size() != 11) return false;
    light.position = three_from(n);
    light.direction = three_from(n.subspan(3));
    light.cutoff = n[6];
    if (n.size() > 7) light.exponent = n[7];
    if (n.size() > 8) light.attenuation = three_from(n.subspan(8));
    return true;
}

std::optional<Light> to_light(std::string_view text) {
    const std::vector<std::string> parts = split(text, ',');
    const auto type = enum_named<LightType>(parts[0]);
    if (!type) return std::nullopt;
    Light light{.type = *type};
    const auto is_named = [](const std::string& part) { return part.find('=') != std::string::npos; };
    const auto named = std::find_if(parts.begin() + 1, parts.end(), is_named);
    std::vector<float> numbers;
    for (auto part = parts.begin() + 1; part != named; ++part) {
        const auto number = to_number<float>(*part);
        if (!number) return std::nullopt;
        numbers.push_back(*number);
    }
    if (!set_numbers(light, numbers)) return std::nullopt;
    const bool is_read =
        std::all_of(named, parts.end(), [&](const std::string& part) { return set_part(light, part); });
    return is_read ? std::optional{light} : std::nullopt;
}

std::string light_text(const Light& light) {
    const Light plain;
    std::string text{enum_name(light.type)};
    if (light.type != LightType::directional) text += fmt::format(",{}", joined(light.position, ","));
    if (light.type != LightType::point) text += fmt::format(",{}", joined(light.direction, ","));
    const bool has_attenuation = light.type != LightType::directional && light.attenuation != plain.attenuation;
    if (light.type == LightType::spot) {
        text += fmt::format(",{}", light.cutoff);
        if (light.exponent != 0 || has_attenuation) text += fmt::format(",{}", light.exponent);
    }
    if (has_attenuation) text += fmt::format(",{}", joined(light.attenuation, ","));
    const auto add = [&](const char* name, const Vec3& color, const Vec3& otherwise) {
        if (color != otherwise) text += fmt::format(",{}={}", name, joined(color, ":"));
    };
    if (light.diffuse == light.specular) {
        add("color", light.diffuse, plain.diffuse);
    } else {
        add("diffuse", light.diffuse, plain.diffuse);
        add("specular", light.specular, plain.specular);
    }
    add("ambient", light.ambient, plain.ambient);
    if (light.type != LightType::directional && light.range != plain.range)
        text += fmt::format(",range={}", light.range);
    return text;
}

bool set_model_part(LightModel& model, std::string_view text) {
    const auto [name, value] = parts_of(text);
    if (name == "ambient") return set_color(value, {&model.ambient});
    if (name == "specular") return set_color(value, {&model.specular});
    if (name == "emission") return set_color(value, {&model.emission});
    if (text == "local-viewer") return model.has_local_viewer = true;
    if (text == "two-sided") return model.is_two_sided = true;
    if (text == "separate-specular") return model.separates_specular = true;
    const auto shininess = to_number<float>(value);
    if (name != "shininess" || !shininess) return false;
    model.shininess = *shininess;
    return true;
}

}  // namespace

std::optional<std::vector<Light>> to_lights(std::string_view text) {
    std::vector<Light> lights;
    if (text == "none") return lights;
    for (const std::string& part : split(text, '/')) {
        const auto light = to_light(part);
        if (!light) return std::nullopt;
        lights.push_back(*light);
    }
    return lights;
}

std::string lights_text(const std::vector<Light>& lights) {
    if (lights.empty()) return "none";
    std::vector<std::string> texts;
    for (const Light& light : lights) texts.push_back(light_text(light));
    return fmt::format("{}", fmt::join(texts, "/"));
}

std::optional<LightModel> to_light_model(std::string_view text) {
    LightModel model;
    for (const std::string& part : split(text, ','))
        if (!set_model_part(model, part)) return std::nullopt;
    return model;
}

std::string light_model_text(const LightModel& model) {
    const LightModel plain;
    std::vector<std::string> parts;
    const auto add = [&](const char* name, const Vec3& color, const Vec3& otherwise) {
        if (color != otherwise) parts.push_back(fmt::format("{}={}", name, joined(color, ":")));
    };
    add("ambient", model.ambient, plain.ambient);
    add("specular", model.specular, plain.specular);
    if (model.shininess != 0) parts.push_back(fmt::format("shininess={}", model.shininess));
    add("emission", model.emission, plain.emission);
    if (model.has_local_viewer) parts.emplace_back("local-viewer");
    if (model.is_two_sided) parts.emplace_back("two-sided");
    if (model.separates_specular) parts.emplace_back("separate-specular");
    if (parts.empty()) parts.push_back(fmt::format("ambient={}", joined(plain.ambient, ":")));
    return fmt::format("{}", fmt::join(parts, ","));
}

}  // namespace strata::tools
