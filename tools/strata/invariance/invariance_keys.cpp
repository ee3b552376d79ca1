// tools/strata/invariance/invariance_keys.cpp - the keys of a plan: what each value means, and what is expected of it.
#include <fmt/format.h>

#include "peeling/registry.h"
#include "tools/strata/invariance/invariance_plan.h"
#include "tools/strata/options/choices.h"

namespace strata::tools {

namespace {

bool set_name(std::string& target, const std::string& text) {
    target = text;
    return !text.empty();
}

template <class T>
bool set_choice(T& target, const std::vector<Choice<T>>& choices, const std::string& text) {
    const auto found = std::find_if(choices.begin(), choices.end(), [&](const auto& c) { return c.name == text; });
    if (found == choices.end()) return false;
    target = found->value;
    return true;
}

template <class T>
bool set_number(T& target, std::string_view text, T low, T high) {
    const auto value = to_number<T>(text);
    if (!value || *value < low || *value > high) return false;
    target = *value;
    return true;
}

bool set_whole(int& target, std::string_view text, int low, int high) {
    const auto value = to_int(text);
    if (!value || *value < low || *value > high) return false;
    target = *value;
    return true;
}

bool set_size(Cell& cell, const std::string& text) {
    const auto parts = split(text, 'x');
    constexpr int side = 16384;
    return parts.size() == 2 && set_whole(cell.width, parts[0], 1, side) && set_whole(cell.height, parts[1], 1, side);
}

bool set_orbit(Cell& cell, const std::string& text) {
    const auto parts = split(text, ',');
    return parts.size() == 2 && set_number(cell.azimuth, parts[0], -1e6, 1e6) &&
           set_number(cell.elevation, parts[1], -90.0, 90.0);
}

bool set_algorithm(Cell& cell, const std::string& text) {
    cell.algorithm = peeling::find_algorithm(text);
    return cell.algorithm != nullptr && !cell.algorithm->is_oracle &&
           (cell.algorithm->exact || cell.algorithm->makes_layers);
}

bool set_pair(Cell& cell, const std::string& text) {
    const auto parts = split(text, ':');
    return parts.size() == 2 && set_choice(cell.write, depth_paths(), parts[0]) &&
           set_choice(cell.compare, depth_paths(), parts[1]);
}

bool set_subpixel_bits(Cell& cell, const std::string& text) {
    if (text == "profile") return cell.subpixel_bits = 0, true;
    return set_whole(cell.subpixel_bits, text, 4, 12) && cell.subpixel_bits % 4 == 0;
}

bool set_range(Cell& cell, const std::string& text) {
    cell.range = {};
    if (text == "orbit") return true;
    if (text.starts_with("ratio:")) return set_number(cell.range.ratio, std::string_view(text).substr(6), 2.6, 1e12);
    const auto parts = split(text, ':');
    return parts.size() == 2 && set_number(cell.range.near, parts[0], 1e-12, 1e12) &&
           set_number(cell.range.far, parts[1], cell.range.near, 1e12) && cell.range.far > cell.range.near;
}

bool set_epsilon(Remedy& remedy, const std::string& text) {
    remedy.epsilon_text = text;
    const std::string_view view = text;
    if (view.ends_with("ulp")) return set_whole(remedy.epsilon.ulps, view.substr(0, view.size() - 3), 0, 1 << 24);
    return set_number(remedy.epsilon.absolute, view, 0.0, 1.0);
}

bool add_remedy(Remedy& remedy, const std::string& part) {
    const std::string value = part.find(':') == std::string::npos ? "" : part.substr(part.find(':') + 1);
    if (part == "none") return true;
    if (part == "unquantized") return remedy.quantize_reference = false, true;
    if (part == "depth_replace") return remedy.depth_replace = true;
    if (part.starts_with("bias:")) return set_number(remedy.bias_constant, value, -0x1p24f, 0x1p24f);
    if (part.starts_with("slope:")) return set_number(remedy.bias_slope, value, -1024.0f, 1024.0f);
    if (part.starts_with("epsilon:")) return set_epsilon(remedy, value);
    return false;
}

bool set_remedy(Cell& cell, const std::string& text) {
    cell.remedy = {};
    for (const std::string& part : split(text, '+'))
        if (!add_remedy(cell.remedy, part)) return false;
    return true;
}

// "A", or "A+B": the first pass and further ones.
bool set_vertex_path(Cell& cell, const std::string& text) {
    const auto parts = split(text, '+');
    const auto choices = vertex_paths();
    pipeline::VertexPath first{}, second{};
    if (parts.size() > 2 || !set_choice(first, choices, parts[0]) || !set_choice(second, choices, parts.back()))
        return false;
    cell.vertex_paths = {first, parts.size() == 2 ? std::optional(second) : std::nullopt};
    cell.vertex_path = text;
    return true;
}

const std::vector<Choice<Split>> splits{{"none", Split::none},
                                        {"rotated", Split::rotated},
                                        {"diagonal", Split::diagonal},
                                        {"moved", Split::moved},
                                        {"clamped", Split::clamped}};

std::vector<PlanKey> make_keys() {
    return {
        {"scene", "what is drawn", "a scene's name or file", "",
         [](Cell& c, const std::string& t) { return set_name(c.scene, t); }, false},
        {"profile", "devices, built-in or JSON files", "a profile's name or file", "geforce3",
         [](Cell& c, const std::string& t) { return set_name(c.profile, t); }},
        {"size", "pixels", "WIDTHxHEIGHT, each from 1 to 16384", "256x192", set_size},
        {"orbit", "degrees from which the scene is seen", "azimuth and elevation in degrees such as 30,20", "30,20",
         set_orbit, false},
        {"alpha", "everything is drawn with its own alpha times this", "a number from 0 to 1", "0.5",
         [](Cell& c, const std::string& t) { return set_number(c.alpha, t, 0.0f, 1.0f); }},
        {"algorithm", "peels", "an algorithm that peels in order (strata algorithms)", "shadow_map", set_algorithm},
        {"split",
         "what further passes draw of the surface: the same, vertices rotated, the other diagonal, the viewport moved "
         "by a pixel, "
         "or clamped at the near plane",
         "none, rotated, diagonal, moved or clamped", "none",
         [](Cell& c, const std::string& t) { return set_choice(c.split, splits, t); }},
        {"hypothesis", "constants of the device that are not known (--hypotheses lists them)",
         "profile, all, or a constant's name and value", "profile",
         [](Cell& c, const std::string& t) { return set_name(c.hypothesis, t); }},
        {"vertex_path", "FIRST or FIRST+FURTHER, how positions are computed", "one or two vertex paths with + between",
         "separate", set_vertex_path},
        {"pair", "WRITE:COMPARE, the path that writes depth and the one that compares",
         "two depth paths with a colon between, such as window_z:perspective_rq", "window_z:perspective_rq", set_pair},
        {"depth_format", "depth buffers", "d16, d24 or d32f", "d16,d24",
         [](Cell& c, const std::string& t) { return set_choice(c.format, depth_formats, t); }},
        {"subpixel_bits", "grids of window positions", "profile, 4, 8 or 12", "profile", set_subpixel_bits},
        {"near_far", "depth ranges: orbit, ratio:FAR/NEAR, or NEAR:FAR",
         "orbit, ratio:R with R from 2.6, or NEAR:FAR with 0 < NEAR < FAR", "orbit", set_range},
        {"remedy",
         "none, or bias:UNITS, slope:FACTOR, epsilon:ABS, epsilon:Nulp, unquantized, depth_replace, with + between",
         "none, bias:UNITS, slope:FACTOR, epsilon:ABS, epsilon:Nulp, unquantized or depth_replace, or some with + "
         "between",
         "none", set_remedy},
        {"max_passes", "geometry passes at most; 0: twice what the true layers need", "a whole number from 0", "0",
         [](Cell& c, const std::string& t) { return set_whole(c.max_passes, t, 0, 1000000); }},
    };
}

}  // namespace

std::string name_of(Split split) { return name_of(splits, split); }

const std::vector<PlanKey>& plan_keys() {
    static const std::vector<PlanKey> keys = make_keys();
    return keys;
}

std::string name_of(const Remedy& remedy) {
    std::string name;
    const auto add = [&name](const std::string& part) { name += (name.empty() ? "" : "+") + part; };
    if (remedy.bias_constant != 0) add(fmt::format("bias:{}", remedy.bias_constant));
    if (remedy.bias_slope != 0) add(fmt::format("slope:{}", remedy.bias_slope));
    if (remedy.epsilon_text != "0") add("epsilon:" + remedy.epsilon_text);
    if (!remedy.quantize_reference) add("unquantized");
    if (remedy.depth_replace) add("depth_replace");
    return name.empty() ? "none" : name;
}

}  // namespace strata::tools
