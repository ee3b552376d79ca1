// tools/lab/invariance/invariance_keys.cpp - the keys of a plan, with the parser of their values.
#include <fmt/format.h>

#include "peeling/registry.h"
#include "tools/lab/invariance/invariance_plan.h"
#include "tools/request/choices.h"
#include "tools/request/parse.h"
#include "tools/request/values.h"

namespace strata::tools {

namespace {

// Whether a file or a name exists is checked later, by CellRunner::check().
bool set_name(std::string& target, const std::string& text) {
    target = text;
    return !text.empty() && text.find('\0') == std::string::npos;  // no file name has a zero byte
}

// Stores the value of an option if it is present; returns whether it is.
template <class Target, class T>
bool assign(Target& target, const std::optional<T>& value) {
    if (value) target = *value;
    return value.has_value();
}

// Parses a number from `low` to `high`, inclusive. `target` keeps its value if the text is not such a number.
bool set_number(auto& target, std::string_view text, double low, double high) {
    using Number = std::remove_reference_t<decltype(target)>;
    const auto value = to_number<Number>(text);
    return value && *value >= low && *value <= high && assign(target, value);
}

bool set_size(Cell& cell, const std::string& text) {
    const auto size = to_size(text);
    if (size) cell.width = size->width, cell.height = size->height;
    return size.has_value();
}

bool set_orbit(Cell& cell, const std::string& text) {
    const auto orbit = to_orbit(text);
    if (orbit) cell.azimuth = orbit->azimuth, cell.elevation = orbit->elevation, cell.takes_own_view = false;
    return orbit.has_value();
}

bool set_camera(Cell& cell, const std::string& text) {
    if (text == "none") return cell.camera.clear(), true;
    return set_name(cell.camera, text);
}

// An invariance test needs ordered layers: an exact peel or one that makes layers, except the oracle.
bool set_algorithm(Cell& cell, const std::string& text) {
    cell.algorithm = peeling::find_algorithm(text);
    return cell.algorithm != nullptr && !cell.algorithm->is_oracle &&
           (cell.algorithm->exact || cell.algorithm->makes_layers);
}

// WRITE:COMPARE.
bool set_pair(Cell& cell, const std::string& text) {
    const auto parts = split(text, ':');
    return parts.size() == 2 && assign(cell.write, to_choice(depth_paths(), parts[0])) &&
           assign(cell.compare, to_choice(depth_paths(), parts[1]));
}

// 0 is the profile's own number.
bool set_subpixel_bits(Cell& cell, const std::string& text) {
    if (text == "profile") return cell.subpixel_bits = 0, true;
    const auto bits = to_int(text);
    return bits && *bits >= 1 && *bits <= 12 && assign(cell.subpixel_bits, bits);
}

// orbit, ratio:R or NEAR:FAR. The orbit's far plane is at 3.6 radii and its sphere begins at 1.5: for a ratio of at
// least 2.6 the near plane is in front of the sphere.
bool set_range(Cell& cell, const std::string& text) {
    cell.range = {};
    if (text == "orbit") return true;
    if (text.starts_with("ratio:")) return set_number(cell.range.ratio, std::string_view(text).substr(6), 2.6, 1e12);
    const auto parts = split(text, ':');
    return parts.size() == 2 && set_number(cell.range.near, parts[0], 1e-12, 1e12) &&
           set_number(cell.range.far, parts[1], cell.range.near, 1e12) && cell.range.far > cell.range.near;
}

// Adds one part of a remedy. A repeated part replaces the first; `none` adds nothing.
bool add_remedy(Remedy& remedy, const std::string& part) {
    const std::string value = part.find(':') == std::string::npos ? "" : part.substr(part.find(':') + 1);
    if (part == "none") return true;
    if (part == "unquantized") return remedy.quantize_reference = false, true;
    if (part == "depth_replace") return remedy.depth_replace = true;
    if (part.starts_with("bias:")) return set_number(remedy.bias_constant, value, -0x1p100, 0x1p100);
    if (part.starts_with("slope:")) return set_number(remedy.bias_slope, value, -1024, 1024);
    if (part.starts_with("epsilon:")) {
        remedy.epsilon_text = value;
        return assign(remedy.epsilon, to_epsilon(value));
    }
    return false;
}

bool set_remedy(Cell& cell, const std::string& text) {
    cell.remedy = {};
    for (const std::string& part : split(text, '+'))
        if (!add_remedy(cell.remedy, part)) return false;
    return true;
}

// "A", or "A+B": the paths of the first pass and of later ones.
bool set_vertex_path(Cell& cell, const std::string& text) {
    cell.vertex_path = text;
    return assign(cell.vertex_paths, to_vertex_paths(text, '+'));
}

const std::vector<Choice<Split>> splits{{"none", Split::none},
                                        {"rotated", Split::rotated},
                                        {"diagonal", Split::diagonal},
                                        {"moved", Split::moved},
                                        {"clamped", Split::clamped}};

// In the order of nesting, which numbers the cells (scenes/reference/reports.md 5.1): moving a key changes every
// number.
std::vector<PlanKey> make_keys() {
    return {
        {"scene", "what is drawn", "a scene's name or file", "",
         [](Cell& c, const std::string& t) { return set_name(c.scene, t); }, false},
        {"profile", "devices, built-in or JSON files", "a profile's name or file", "geforce3",
         [](Cell& c, const std::string& t) { return set_name(c.profile, t); }},
        {"size", "pixels", "WIDTHxHEIGHT, each from 1 to 16384", "256x192", set_size},
        {"orbit", "degrees from which the scene is seen", "azimuth and elevation in degrees such as 30,20",
         "the scene's own view if it has one, else 30,20", set_orbit, false},
        {"camera", "a camera of the scene, or a JSON file with one, instead of an orbit", "a camera's name or file",
         "none", set_camera, false},
        {"alpha", "everything is drawn with its own alpha times this", "a number from 0 to 1", "0.5",
         [](Cell& c, const std::string& t) { return assign(c.alpha, to_share(t)); }},
        {"algorithm", "peels", "an algorithm that peels in order (strata list algorithms)", "shadow_map",
         set_algorithm},
        {"split",
         "what further passes draw of the surface: the same, vertices rotated, the other diagonal, the viewport moved "
         "by a pixel, "
         "or clamped at the near plane",
         "none, rotated, diagonal, moved or clamped", "none",
         [](Cell& c, const std::string& t) { return assign(c.split, to_choice(splits, t)); }},
        {"hypothesis", "constants of the device that are not known (--hypotheses lists them)",
         "profile, all, or a constant's name and value", "profile",
         [](Cell& c, const std::string& t) { return set_name(c.hypothesis, t); }},
        {"vertex_path", "FIRST or FIRST+FURTHER, how positions are computed", "one or two vertex paths with + between",
         "separate", set_vertex_path},
        {"pair", "WRITE:COMPARE, the path that writes depth and the one that compares",
         "two depth paths with a colon between, such as window_z:perspective_rq", "window_z:perspective_rq", set_pair},
        {"depth_format", "depth buffers", "d16, d24, d32f, d16f or d24f", "d16,d24",
         [](Cell& c, const std::string& t) { return assign(c.format, to_choice(depth_formats, t)); }},
        {"subpixel_bits", "grids of window positions", "profile, or 1 to 12", "profile", set_subpixel_bits},
        {"near_far", "near and far planes: orbit (those of the orbiting view), ratio:R (far / near), or NEAR:FAR",
         "orbit, ratio:R with R from 2.6, or NEAR:FAR with 0 < NEAR < FAR", "orbit", set_range},
        {"remedy",
         "none, or bias:UNITS, slope:FACTOR, epsilon:ABS, epsilon:Nulp, unquantized, depth_replace, with + between",
         "none, bias:UNITS, slope:FACTOR, epsilon:ABS, epsilon:Nulp, unquantized or depth_replace, or some with + "
         "between",
         "none", set_remedy},
        {"max_passes", "geometry passes at most; 0: twice what the true layers need", "a whole number from 0", "0",
         [](Cell& c, const std::string& t) { return assign(c.max_passes, to_count(t)); }},
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
