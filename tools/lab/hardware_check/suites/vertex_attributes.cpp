// Suites Attrib_float: <upper value>_<lower value>, Attrib_carryover: <L|T>-<attribute><value>-<command>, and
// SetVertexData: SET_VERTEX_DATA<format>: what a vertex program and the lighting unit read of a vertex.
// pipeline/reference/vertices.md 3.4.
#include <algorithm>
#include <array>
#include <bit>
#include <vector>

#include "tools/lab/hardware_check/drawing/lit.h"
#include "tools/lab/hardware_check/drawing/names.h"
#include "tools/lab/hardware_check/drawing/splits.h"
#include "tools/lab/hardware_check/drawing/suite.h"

namespace strata::hardware_check {
namespace {

using Color = std::array<float, 4>;

// The value of a colour's register: a NaN is 0 or 1 by its sign.
float saturated(float v) {
    if ((std::bit_cast<std::uint32_t>(v) & 0x80000000u) != 0) return 0.0f;
    return v <= 1.0f ? v : 1.0f;
}

// The values of names, by their bits; NaNs are quiet, or signalling.
std::optional<float> attribute_value(std::string_view word) {
    const std::uint32_t sign = take(word, "-") ? 0x80000000u : 0u;
    constexpr std::pair<std::string_view, std::uint32_t> all[] = {{"0", 0},
                                                                  {"1", 0x3f800000},
                                                                  {"8", 0x41000000},
                                                                  {"NaNq", 0x7fc00000},
                                                                  {"NaNs", 0x7f800001},
                                                                  {"INF", 0x7f800000},
                                                                  {"Max", 0x7f7fffff},
                                                                  {"MinN", 0x00800000},
                                                                  {"MaxSN", 0x007fffff},
                                                                  {"Min", 0x00000001}};
    for (const auto& [text, bits] : all)
        if (word == text) return std::bit_cast<float>(bits | sign);
    return std::nullopt;
}

Color grey(float v) { return {v, v, v, 1}; }

}  // namespace

// Seven bars from one grey to another: as they are, and times 1, 0, both infinities and both NaNs.
Drawing draw_attrib_float(std::string_view name, const pipeline::DeviceProfile& profile) {
    const auto upper = attribute_value(take_until(name, "_")), lower = attribute_value(name);
    if (!upper || !lower) return unknown_name;
    pipeline::Surface surface{profile, {}};
    surface.clear_color(unpack(0xff6495ed));
    constexpr std::array<std::uint32_t, 7> factors{0,          0x3f800000, 0x00000000, 0xff800000,
                                                   0x7f800000, 0xffc00000, 0x7fc00000};
    constexpr float inset = 0.2f, column = (1.0f - 2 * inset) / 6.0f;
    for (std::size_t k = 0; k < factors.size(); ++k) {
        const auto shown = [&](float v) {
            return grey(saturated(k == 0 ? v : rasterizer::nv20::multiply(v, std::bit_cast<float>(factors[k]))));
        };
        const float left = (inset + static_cast<float>(k) * column) * 640, right = left + column * 0.8f * 640;
        const float top = (inset + 0.1f) * 480, bottom = top + (1 - 2 * inset) * 480;
        TriangleSoup bar;
        add_quad(bar, {at(left, top, 1, shown(*upper)), at(right, top, 1, shown(*upper)),
                       at(right, bottom, 1, shown(*lower)), at(left, bottom, 1, shown(*lower))});
        surface.draw({}, bar);
    }
    return {SuitePicture{.image = surface.color()}, {}};
}

namespace {

// How many components an attribute has, and what a program sees in the others.
enum class AttributeKind : std::uint8_t {
    one_value,  // shown as v, v, 1, 1
    normal,     // shown as x, y, z, 1
    color,
    two_values  // s, t, 0, 1
};
std::optional<AttributeKind> attribute_kind(std::string_view word) {
    if (word == "w" || word == "fc" || word == "ps") return AttributeKind::one_value;
    if (word == "n") return AttributeKind::normal;
    if (word == "d" || word == "s" || word == "bd" || word == "bs") return AttributeKind::color;
    if (word == "t0" || word == "t1" || word == "t2" || word == "t3") return AttributeKind::two_values;
    return std::nullopt;
}

// The four commands and the value of the last vertex that each test sets.
struct CarryoverTest {
    std::string_view ending;
    Color value;
    bool is_indexed;
};
constexpr CarryoverTest carryover_tests[] = {{"0.1_0.0_1.0_1.0-da", {0.05f, 0, 1, 1}, false},
                                             {"0.8_0.0_0.0_1.0-ib", {0.75f, 0, 0, 1}, false},
                                             {"0.5_0.0_0.0_1.0-ia", {0.5f, 0, 0, 1}, false},
                                             {"0.2_0.0_0.6_1.0-ie", {0.25f, 0, 0.6f, 1}, true}};

// What the second draw shows of the attribute's value in the last vertex before; `flag` is the one component that
// vertex 1 has, whose other attributes are green.
Color carried_over(AttributeKind kind, const CarryoverTest& test, float flag) {
    if (kind == AttributeKind::one_value) {
        const float v = test.is_indexed ? flag : test.value[0];
        return {v, v, 1, 1};
    }
    const Color last = test.is_indexed ? Color{0, 1, 0, 1} : test.value;
    return kind == AttributeKind::two_values ? Color{last[0], last[1], 0, 1} : last;
}

// With indices the last vertex is drawn first.
void draw_in_order(pipeline::Surface& surface, const CarryoverTest& test, std::vector<ClipVertex> vertices) {
    if (test.is_indexed) std::rotate(vertices.begin(), vertices.end() - 1, vertices.end());
    const Topology topology = vertices.size() == 2 ? Topology::lines : Topology::triangles;
    SplitDraw draw = split_draw(topology, vertices, PolygonMode::fill);
    surface.draw({}, std::move(draw.soup), draw.primitive);
}

SuitePicture carryover_picture(const pipeline::DeviceProfile& profile, const CarryoverTest& test, bool is_line,
                               const Color& last, const Color& after) {
    constexpr float left = 128, right = 512, top = 80, bottom = 400, middle = 320, z = 3;
    const Color white{1, 1, 1, 1}, green{0, 1, 0, 1};
    pipeline::Surface surface{profile, {}};
    surface.clear_color(unpack(0xff444444));
    if (is_line) {
        draw_in_order(surface, test, {at(left, top, z, green), at(right, top, z, last)});
        draw_in_order(surface, test, {at(left, bottom, z, after), at(right, bottom, z, after)});
    } else {
        draw_in_order(surface, test,
                      {at(left, top, z, white), at(middle, top, z, green), at((left + middle) / 2, bottom, z, last)});
        draw_in_order(
            surface, test,
            {at(middle, top, z, after), at(right, top, z, after), at((right + middle) / 2, bottom, z, after)});
    }
    return {.image = surface.color()};
}

}  // namespace

// A triangle or a line with the attribute, then one that has only positions: it keeps what the last vertex had. With
// indices that is the last vertex that was fetched.
Drawing draw_attrib_carryover(std::string_view name, const pipeline::DeviceProfile& profile) {
    const bool is_line = take(name, "L-");
    if (!is_line && !take(name, "T-")) return unknown_name;
    for (const CarryoverTest& test : carryover_tests) {
        std::string_view word = name;
        if (!take_last(word, test.ending)) continue;
        const auto kind = attribute_kind(word);
        if (!kind) return unknown_name;
        const Color after = carried_over(*kind, test, word == "w" ? 0.66f : word == "fc" ? 0.5f : 0.7f);
        return {carryover_picture(profile, test, is_line, word == "d" ? test.value : Color{1, 0, 1, 1}, after), {}};
    }
    return unknown_name;
}

namespace {

// What the test writes: the diffuse colour, and x of the normals of the two lit triangles.
struct VertexData {
    std::string_view name;
    Color diffuse;
    float positive, negative;
};
// Shorts become the numbers that they are.
constexpr VertexData vertex_data[] = {
    {"2F_M", {0.5f, 1, 0, 1}, 1, -1},   {"4F_M", {0.5f, 1, 0.25f, 0.75f}, 1, -1},
    {"2S-0001", {1, 1, 0, 1}, 1, -1},   {"2S-7FFF", {32767, 32767, 0, 1}, 32767, -32768},
    {"4S_M-0001", {1, 1, 1, 1}, 1, -1}, {"4S_M-7FFF", {32767, 32767, 32767, 32767}, 32767, -32768}};

}  // namespace

// A triangle without lighting, and two that two infinite lights light from the left and the right.
Drawing draw_set_vertex_data(std::string_view name, const pipeline::DeviceProfile& profile) {
    if (!take(name, "SET_VERTEX_DATA")) return unknown_name;
    if (name == "4UB") return {std::nullopt, "how the test's host converts a negative number to a byte is not known"};
    for (const VertexData& data : vertex_data) {
        if (name != data.name) continue;
        LightingRegisters r;
        r.has_specular = r.separates_specular = r.has_local_eye = true;
        r.light[0].kind = r.light[1].kind = pipeline::LightKind::infinite;
        r.light[0].direction = {1, 0, 0};
        r.light[0].diffuse = {0, 0.25f, 0.8f};
        r.light[1].direction = {-1, 0, 0};
        r.light[1].diffuse = {0.8f, 0.25f, 0.33f};
        constexpr float right = 2.75f, top = 1.75f, z = 1;
        Color diffuse = data.diffuse;
        for (float& v : diffuse) v = saturated(v);
        const LitCamera camera;
        pipeline::Surface surface = cleared_to(profile, 0xff303030);
        const auto draw = [&](const std::array<HostVector, 3>& corner, const Color& color, float normal) {
            std::vector<WorldVertex> vertices;
            for (const HostVector& point : corner) vertices.push_back({point, {normal, 0, 0}, color});
            draw_lit(surface, show_lit(Shown::primary), camera.lit(r, vertices));
        };
        draw({{{-right, top, z, 1}, {0, top, z, 1}, {-right / 2, -top, z, 1}}}, diffuse, 0);
        r.is_enabled = true;
        draw({{{right / 2, top, z, 1}, {right, 0, z, 1}, {0, 0, z, 1}}}, {1, 1, 1, 1}, data.positive);
        draw({{{0, 0, z, 1}, {right, 0, z, 1}, {right / 2, -top, z, 1}}}, {1, 1, 1, 1}, data.negative);
        return {SuitePicture{.image = surface.color()}, {}};
    }
    return unknown_name;
}

}  // namespace strata::hardware_check
